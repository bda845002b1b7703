//! Goals that go beyond the types of which a model has its predicates.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{ActionModel, Goal, GroundAtom, State, Symbol, nearest};

/// A goal atom about an object of a type that has nothing in common with the one that the model has in this place of the
/// predicate. It is no error, since an imagined action may reach further than what was observed; but where no plan is
/// found, it may well be why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GoalTypeMismatch {
    /// The goal atom.
    pub atom: GroundAtom,
    /// Whether it must hold; else it must not, and never does.
    #[serde(default = "holds", skip_serializing_if = "Clone::clone")]
    pub positive: bool,
    /// The place among its arguments, from 1.
    pub place: usize,
    /// The type of the object in that place.
    pub found: Symbol,
    /// The type that the model has there.
    pub expected: Symbol,
    /// The atom that may have been meant.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near: Option<GroundAtom>,
}

fn holds() -> bool {
    true
}

impl fmt::Display for GoalTypeMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { atom, positive, place, found, expected, near } = self;
        let object = atom.args.get(place.wrapping_sub(1)).map_or("it", Symbol::as_str);
        write!(
            f,
            "in the goal {}: in this model, argument {place} of `{}` is of type {expected}; {object} is of type {found}",
            atom.as_goal(*positive),
            atom.predicate
        )?;
        match near {
            Some(near) => write!(f, ". Did you mean `{}`?", near.as_goal(*positive)),
            None => Ok(()),
        }
    }
}

impl Goal {
    /// The atoms that go beyond the types of which the model has its predicates, in order, each with the first
    /// argument that does.
    ///
    /// ```
    /// use typelift_model::{ActionModel, Goal, GroundAtom, Hierarchy, State};
    ///
    /// let hierarchy = Hierarchy::from_edges([("rod", "piece"), ("saw", "machine")])?;
    /// let [piece, rod, saw] = ["piece", "rod", "saw"].map(|name| hierarchy.id(name).expect("declared"));
    /// let predicates = [("cut".into(), vec![piece])].into();
    /// let model = ActionModel { hierarchy, predicates, ..ActionModel::default() };
    /// let state = State { objects: [("rod_1".into(), rod), ("saw_1".into(), saw)].into(), ..State::default() };
    /// let goal = Goal::from(vec![GroundAtom::parse("cut(rod_1)")?, GroundAtom::parse("cut(saw_1)")?]);
    ///
    /// let mismatches: Vec<String> = goal.type_mismatches(&state, &model).iter().map(ToString::to_string).collect();
    /// assert_eq!(
    ///     mismatches,
    ///     ["in the goal cut(saw_1): in this model, argument 1 of `cut` is of type piece; saw_1 is of type saw"]
    /// );
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn type_mismatches(&self, state: &State, model: &ActionModel) -> Vec<GoalTypeMismatch> {
        self.literals().filter_map(|(atom, positive)| mismatch(atom, positive, state, model)).collect()
    }
}

fn mismatch(atom: &GroundAtom, positive: bool, state: &State, model: &ActionModel) -> Option<GoalTypeMismatch> {
    let hierarchy = &model.hierarchy;
    let expected = model.predicates.get(&atom.predicate)?;
    let first_mismatch = |args: &[Symbol]| {
        let types = args.iter().map(|object| state.objects.get(object)).zip(expected);
        let mut places = types.enumerate();
        places.find_map(|(place, (found, expected))| {
            let found = found.filter(|found| hierarchy.disjoint(**found, *expected))?;
            Some((place, *found, *expected))
        })
    };
    let (place, found, expected) = first_mismatch(&atom.args)?;
    let with = |change: &dyn Fn(&mut Vec<Symbol>)| {
        let mut args = atom.args.clone();
        change(&mut args);
        first_mismatch(&args).is_none().then(|| GroundAtom { args, ..atom.clone() })
    };
    let exchanged = (0..atom.args.len()).find_map(|other| with(&|args| args.swap(place, other)));
    let fitting = state.objects.iter().filter(|(_, ty)| hierarchy.is_a(**ty, expected)).map(|(name, _)| name);
    let near = exchanged.or_else(|| {
        nearest(atom.args[place].as_str(), fitting).and_then(|name| with(&|args| args[place] = name.clone()))
    });
    let [found, expected] = [found, expected].map(|ty| hierarchy.name(ty).clone());
    Some(GoalTypeMismatch { atom: atom.clone(), positive, place: place + 1, found, expected, near })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Hierarchy;

    /// What is said of a goal atom where `in` is of a thing and a box.
    fn said(atom: &str) -> Option<String> {
        let hierarchy =
            Hierarchy::from_edges([("thing", "object"), ("cup", "thing"), ("box", "object")]).expect("a tree");
        let id = |name: &str| hierarchy.id(name).expect("declared");
        let objects = [("cup_1".into(), id("cup")), ("box_1".into(), id("box")), ("box_2".into(), id("box"))].into();
        let predicates = [("in".into(), vec![id("thing"), id("box")]), ("any".into(), vec![hierarchy.root()])].into();
        let model = ActionModel { hierarchy, predicates, ..ActionModel::default() };
        let (atom, positive) = atom.strip_prefix("not ").map_or((atom, true), |atom| (atom, false));
        let mut goal = Goal::default();
        let atoms = if positive { &mut goal.required } else { &mut goal.forbidden };
        atoms.push(GroundAtom::parse(atom).expect("an atom"));
        let state = State { objects, ..State::default() };
        goal.type_mismatches(&state, &model).first().map(ToString::to_string)
    }

    #[test]
    fn what_may_have_been_meant() {
        assert_eq!(said("in(cup_1,box_1)"), None);
        assert_eq!(said("any(box_1)"), None, "everything has something in common with the root");
        let place =
            |place: u8, expected: &str| format!("in this model, argument {place} of `in` is of type {expected};");
        assert_eq!(
            said("in(box_1,cup_1)"),
            Some(format!(
                "in the goal in(box_1,cup_1): {} box_1 is of type box. Did you mean `in(cup_1,box_1)`?",
                place(1, "thing")
            ))
        );
        assert_eq!(
            said("not in(box_1,cup_1)"),
            Some(format!(
                "in the goal not in(box_1,cup_1): {} box_1 is of type box. Did you mean `not in(cup_1,box_1)`?",
                place(1, "thing")
            ))
        );
        assert_eq!(
            said("in(cup_1,cup_1)"),
            Some(format!("in the goal in(cup_1,cup_1): {} cup_1 is of type cup", place(2, "box")))
        );
        assert_eq!(
            said("in(box_1,box_2)"),
            Some(format!("in the goal in(box_1,box_2): {} box_1 is of type box", place(1, "thing")))
        );
    }
}
