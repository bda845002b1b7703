//! What is wrong with a goal, and what may have been meant.

use thiserror::Error;

use crate::{ArgumentTypes, GroundAtom, Hierarchy, OtherNotation, State, Symbol, nearest};

/// Why a goal is not one for this model and state.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("in the goal {}: {}", .atom.as_goal(*.positive), .kind.said_of(.atom))]
pub struct GoalError {
    /// The goal atom.
    pub atom: GroundAtom,
    /// Whether it must hold; else it must not.
    pub positive: bool,
    /// What is wrong with it.
    pub kind: GoalErrorKind,
}

/// What is wrong with a goal atom.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GoalErrorKind {
    /// The model does not know its predicate.
    UnknownPredicate {
        /// The predicates that may have been meant.
        near: Vec<Symbol>,
        /// The atom that may have been meant, if its last argument is a value.
        meant: Option<Box<GroundAtom>>,
    },
    /// Its predicate has another number of arguments.
    Arity {
        /// The predicate's number of arguments.
        expected: usize,
    },
    /// The state does not have one of its objects.
    UnknownObject {
        /// The object.
        object: Symbol,
        /// The object that may have been meant.
        near: Option<Symbol>,
        /// The atom that may have been meant, if the object is a value.
        meant: Option<Box<GroundAtom>>,
    },
    /// A type stands in it in place of an object.
    TypeForObject {
        /// The type.
        ty: Symbol,
        /// The objects of this type in the state.
        objects: Vec<Symbol>,
    },
}

impl GoalErrorKind {
    /// What is wrong with an atom, if something is.
    pub(crate) fn of(
        atom: &GroundAtom,
        state: &State,
        predicates: &ArgumentTypes,
        hierarchy: &Hierarchy,
    ) -> Option<Self> {
        Self::of_predicate(atom, predicates).or_else(|| {
            let unknown = atom.args.iter().find(|arg| !state.objects.contains_key(*arg))?;
            let meant = valued(atom, predicates).filter(|_| atom.args.last() == Some(unknown));
            Some(no_object(unknown, meant.map(Box::new), state, hierarchy))
        })
    }

    /// What is wrong with an atom's predicate and the number of its arguments, if something is.
    pub fn of_predicate(atom: &GroundAtom, predicates: &ArgumentTypes) -> Option<Self> {
        match predicates.get(&atom.predicate) {
            None => Some(Self::UnknownPredicate {
                near: near_predicates(atom, predicates),
                meant: valued(atom, predicates).map(Box::new),
            }),
            Some(types) if types.len() != atom.arity() => Some(Self::Arity { expected: types.len() }),
            Some(_) => None,
        }
    }

    /// What is said of an atom with which this is wrong.
    pub fn said_of(&self, atom: &GroundAtom) -> String {
        match self {
            Self::UnknownPredicate { .. } => format!("the model has no predicate `{}`", atom.predicate),
            Self::Arity { expected } => {
                let plural = if *expected == 1 { "" } else { "s" };
                format!("`{}` takes {expected} argument{plural}, not {}", atom.predicate, atom.arity())
            }
            Self::UnknownObject { object, .. } => format!("there is no `{object}` in the state"),
            Self::TypeForObject { ty, .. } => format!("`{ty}` is a type, and no entity of the state"),
        }
    }
}

impl GoalErrorKind {
    /// What to do about an atom that must hold, or must not, with which this is wrong; if that is known.
    pub fn hint(&self, atom: &GroundAtom, positive: bool) -> Option<String> {
        match self {
            Self::UnknownPredicate { meant: Some(meant), .. } | Self::UnknownObject { meant: Some(meant), .. } => {
                Some(format!("Write `{}`.", meant.as_goal(positive)))
            }
            Self::UnknownPredicate { near, .. } => {
                let other = OtherNotation::of(&atom.as_goal(positive)).filter(|other| match other {
                    OtherNotation::Literals(literals) => *literals != [(atom.clone(), positive)],
                    OtherNotation::BeyondLiterals(_) => true,
                });
                let near = || (!near.is_empty()).then(|| format!("Did you mean {}?", listed(near)));
                other.map(|other| other.hint()).or_else(near)
            }
            Self::Arity { expected } => {
                let args: Vec<String> = (1..=*expected).map(|i| format!("x{i}")).collect();
                Some(format!("Write `{}({})`, with the names of entities.", atom.predicate, args.join(",")))
            }
            Self::UnknownObject { object, .. } if object.as_str() == "*" => Some(
                "A goal names each entity: `*` stands for none. Alternatives can stand in a PDDL problem.".to_owned(),
            ),
            Self::UnknownObject { near, .. } => near.as_ref().map(|name| format!("Did you mean `{name}`?")),
            Self::TypeForObject { ty, objects } => Some(match objects.as_slice() {
                [] => format!("The state has no entity of type `{ty}`."),
                objects => format!("Name an entity of this type: {}.", listed(objects)),
            }),
        }
    }
}

impl GoalError {
    /// What to do about it, if that is known.
    pub fn hint(&self) -> Option<String> {
        self.kind.hint(&self.atom, self.positive)
    }
}

/// Names that are listed before it is said how many more there are.
const LISTED: usize = 5;

/// `` `a` ``, `` `a` or `b` ``, `` `a`, `b` or `c` ``; of many names only some.
fn listed(names: &[Symbol]) -> String {
    let more = names.len().saturating_sub(LISTED);
    let mut names: Vec<String> = names.iter().take(LISTED).map(|name| format!("`{name}`")).collect();
    if more > 0 {
        names.push(format!("one of {more} more"));
    }
    match names.pop() {
        Some(last) if !names.is_empty() => format!("{} or {last}", names.join(", ")),
        last => last.unwrap_or_default(),
    }
}

/// What is wrong with a name that is no object's.
fn no_object(name: &Symbol, meant: Option<Box<GroundAtom>>, state: &State, hierarchy: &Hierarchy) -> GoalErrorKind {
    match hierarchy.id(name.as_str()) {
        Some(ty) => {
            let of_type = state.objects.iter().filter(|(_, of)| hierarchy.is_a(**of, ty));
            GoalErrorKind::TypeForObject { ty: name.clone(), objects: of_type.map(|(name, _)| name.clone()).collect() }
        }
        None => {
            let near = nearest(name.as_str(), state.objects.keys()).cloned();
            GoalErrorKind::UnknownObject { object: name.clone(), near, meant }
        }
    }
}

/// The atom that is meant by one whose last argument is a value, or says that a relation is to nothing: `soil(bed_1,Loose)`,
/// `in(rose_1,null)` and `in_holds(rose_1,null)` are `soil_Loose(bed_1)` and `in_None(rose_1)`, if there are such predicates.
fn valued(atom: &GroundAtom, predicates: &ArgumentTypes) -> Option<GroundAtom> {
    let (value, args) = atom.args.split_last()?;
    let is_nothing = ["null", "none", "nil"].iter().any(|word| value.as_str().eq_ignore_ascii_case(word));
    let (name, value) = (atom.predicate.as_str(), if is_nothing { "None" } else { value.as_str() });
    let name = name.strip_suffix("_holds").filter(|_| is_nothing).unwrap_or(name);
    let wanted = format!("{name}_{value}");
    let mut alike = predicates.iter().filter(|(predicate, _)| predicate.as_str().eq_ignore_ascii_case(&wanted));
    let (predicate, _) = alike.find(|(_, types)| types.len() == args.len())?;
    Some(GroundAtom { predicate: predicate.clone(), args: args.to_vec() })
}

/// The predicates that may have been meant: where the attribute is known, that of nearly the same value, or of every value;
/// else the one of nearly that name, or one that is made from what a snapshot calls so.
fn near_predicates(atom: &GroundAtom, predicates: &ArgumentTypes) -> Vec<Symbol> {
    let of_values = of_other_values(atom, predicates);
    if !of_values.is_empty() {
        return of_values;
    }
    match nearest(atom.predicate.as_str(), predicates.keys()).or_else(|| made_from(atom, predicates)) {
        Some(near) => vec![near.clone()],
        None => of_value(atom, predicates),
    }
}

/// A predicate that is made from what a snapshot calls so: the relation `holding` gives `holding_holds`, the attribute
/// `cut` gives `cut_Fresh`; or that is told apart from others of its name, as `at/2`. One with as many arguments, if there is one.
fn made_from<'a>(atom: &GroundAtom, predicates: &'a ArgumentTypes) -> Option<&'a Symbol> {
    let is_made_from = |name: &Symbol| {
        let rest = name.as_str().strip_prefix(atom.predicate.as_str());
        rest.is_some_and(|rest| rest.starts_with(['_', '/']))
    };
    let made = predicates.iter().filter(|(name, _)| is_made_from(name));
    made.min_by_key(|(_, types)| types.len() != atom.arity()).map(|(name, _)| name)
}

/// The predicates of this value, of whatever attribute, with as many arguments: `battery_Full` for `full`.
fn of_value(atom: &GroundAtom, predicates: &ArgumentTypes) -> Vec<Symbol> {
    let is_of_value = |name: &Symbol| {
        let value = name.as_str().rsplit_once('_').map(|(_, value)| value);
        value.is_some_and(|value| value.eq_ignore_ascii_case(atom.predicate.as_str()))
    };
    let alike = predicates.iter().filter(|(name, types)| types.len() == atom.arity() && is_of_value(name));
    alike.map(|(name, _)| name.clone()).collect()
}

/// The predicates that begin as this one does up to its last `_`, and have as many arguments: `battery_Full` beside
/// `battery_Empty`. If what follows is nearly the same in one of them, that one alone.
fn of_other_values(atom: &GroundAtom, predicates: &ArgumentTypes) -> Vec<Symbol> {
    let Some((attribute, value)) = atom.predicate.as_str().rsplit_once('_') else { return Vec::new() };
    let alike = predicates.iter().filter(|(_, types)| types.len() == atom.arity()).filter_map(|(name, _)| {
        let value = name.as_str().strip_prefix(attribute)?.strip_prefix('_')?;
        Some((Symbol::new(value), name))
    });
    let alike: Vec<(Symbol, &Symbol)> = alike.collect();
    match nearest(value, alike.iter().map(|(value, _)| value)) {
        Some(near) => alike.iter().filter(|(value, _)| value == near).map(|(_, name)| (*name).clone()).collect(),
        None => alike.into_iter().map(|(_, name)| name.clone()).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Goal;

    /// What is said of a goal where drums stand on docks and a truck has a battery, and the hint.
    fn said(atom: &str, positive: bool) -> (String, String) {
        let types =
            [("drum", "object"), ("oil_drum", "drum"), ("dock", "object"), ("truck", "object"), ("hook", "object")];
        let hierarchy = Hierarchy::from_edges(types).expect("a tree");
        let id = |name: &str| hierarchy.id(name).expect("declared");
        let objects = [("drum_1", "oil_drum"), ("drum_2", "drum"), ("dock_1", "dock"), ("truck_1", "truck")];
        let state = State { objects: objects.map(|(name, ty)| (Symbol::new(name), id(ty))).into(), ..State::default() };
        let predicates =
            [("on_holds", vec!["drum", "dock"]), ("battery_Full", vec!["truck"]), ("battery_Low", vec!["truck"])];
        let predicates =
            predicates.map(|(name, types)| (Symbol::new(name), types.into_iter().map(id).collect())).into();
        let atom = GroundAtom::parse(atom).expect(atom);
        let goal = match positive {
            true => Goal { required: vec![atom], forbidden: Vec::new() },
            false => Goal { required: Vec::new(), forbidden: vec![atom] },
        };
        let error = goal.check(&state, &predicates, &hierarchy).expect_err("it is wrong");
        (error.to_string(), error.hint().unwrap_or_default())
    }

    #[test]
    fn what_may_have_been_meant() {
        for (atom, what, hint) in [
            ("on_hold(drum_1,dock_1)", "the model has no predicate `on_hold`", "Did you mean `on_holds`?"),
            ("Battery_full(truck_1)", "the model has no predicate `Battery_full`", "Did you mean `battery_Full`?"),
            ("on(drum_1,dock_1)", "the model has no predicate `on`", "Did you mean `on_holds`?"),
            ("battery_Pull(truck_1)", "the model has no predicate `battery_Pull`", "Did you mean `battery_Full`?"),
            (
                "battery_Empty(truck_1)",
                "the model has no predicate `battery_Empty`",
                "Did you mean `battery_Full` or `battery_Low`?",
            ),
            ("full(truck_1)", "the model has no predicate `full`", "Did you mean `battery_Full`?"),
            (
                "on_holds(drum_1,*)",
                "there is no `*` in the state",
                "A goal names each entity: `*` stands for none. Alternatives can stand in a PDDL problem.",
            ),
            ("broken(truck_1)", "the model has no predicate `broken`", ""),
            (
                "!on_holds(drum_1,dock_1)",
                "the model has no predicate `!on_holds`",
                "Write `not on_holds(drum_1,dock_1)`.",
            ),
            ("not(moving)", "the model has no predicate `not`", "Write `not moving()`."),
            (
                "on_holds(drum,dock_1)",
                "`drum` is a type, and no entity of the state",
                "Name an entity of this type: `drum_1` or `drum_2`.",
            ),
            (
                "on_holds(oil_drum,dock_1)",
                "`oil_drum` is a type, and no entity of the state",
                "Name an entity of this type: `drum_1`.",
            ),
            (
                "battery_Low(hook)",
                "`hook` is a type, and no entity of the state",
                "The state has no entity of type `hook`.",
            ),
            ("on_holds(drum_1,dok_1)", "there is no `dok_1` in the state", "Did you mean `dock_1`?"),
            (
                "on_holds(drum_1)",
                "`on_holds` takes 2 arguments, not 1",
                "Write `on_holds(x1,x2)`, with the names of entities.",
            ),
        ] {
            assert_eq!(said(atom, true), (format!("in the goal {}: {what}", written(atom)), hint.to_owned()), "{atom}");
        }
        assert_eq!(
            said("on_hold(drum_1,dock_1)", false).0,
            "in the goal not on_hold(drum_1,dock_1): the model has no predicate `on_hold`"
        );
    }

    fn written(atom: &str) -> String {
        GroundAtom::parse(atom).expect(atom).to_string()
    }

    #[test]
    fn of_many_names_some_are_listed() {
        let names = |n: usize| (1..=n).map(|i| Symbol::from(format!("a{i}"))).collect::<Vec<_>>();
        assert_eq!(listed(&names(3)), "`a1`, `a2` or `a3`");
        assert_eq!(listed(&names(9)), "`a1`, `a2`, `a3`, `a4`, `a5` or one of 4 more");
    }
}
