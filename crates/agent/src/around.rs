//! That something must hold around who takes part in a call, or must not: of something that the call does not name. It becomes
//! a precondition on a derived atom, which follows from what it speaks of.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_belief::{Link, Surrounding};
use typelift_model::{ActionModel, ActionSchema, Axiom, LiftedAtom, Literal, Parameter, Symbol, Term, Wording};

/// What must hold around who takes part where a call is used, or must not.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ConditionAround {
    /// In actions of this call name,
    pub call: Symbol,
    /// of those the ones that add atoms of all these predicates.
    pub adds: BTreeSet<Symbol>,
    /// What it is about.
    pub surrounding: Surrounding,
    /// Whether it must hold; else it must not.
    pub holds: bool,
    /// The participants of which it speaks: the place of each in the call, from 0, and who stood there.
    pub args: BTreeMap<u32, (usize, Symbol)>,
}

impl fmt::Display for ConditionAround {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |participant| self.args.get(&participant).map_or_else(String::new, |(_, object)| object.to_string());
        let word = if self.holds { "without" } else { "while" };
        write!(f, "{} {word} {}", self.call, self.surrounding.in_words(name))
    }
}

impl ConditionAround {
    /// The derived atom, over its participants in their order, with the axiom that it follows by; none if the hierarchy does
    /// not know its type.
    fn axiom(&self, model: &ActionModel) -> Option<Axiom> {
        let place = |link: &Link| self.args.keys().position(|participant| *participant == link.of);
        let own = |link: &Link| place(link).map(|place| Term::Param(place as u32));
        let mut other = model.hierarchy.root();
        let something = Term::Param(self.args.len() as u32);
        let property = |predicate: &Symbol| LiftedAtom { predicate: predicate.clone(), args: vec![something.clone()] };
        let linked = |link: &Link| Some(link.atom(own(link)?, something.clone()));
        let body = match &self.surrounding {
            Surrounding::Something { property: predicate, ty } => {
                other = model.hierarchy.id(ty.as_str())?;
                vec![property(predicate)]
            }
            Surrounding::Linked { link, property: predicate } => vec![linked(link)?, property(predicate)],
            Surrounding::Joined(one, two) => vec![linked(one)?, linked(two)?],
        };
        let args = (0..self.args.len() as u32).map(Term::Param).collect();
        let types = self.args.keys().map(|_| model.hierarchy.root()).chain([other]);
        let parameters = (1..).zip(types).map(|(number, ty)| Parameter { name: format!("p{number}").into(), ty });
        Some(Axiom {
            stratum: model.axioms.iter().map(|axiom| axiom.stratum + 1).max().unwrap_or_default(),
            head: LiftedAtom { predicate: format!("around: {}", self.surrounding).into(), args },
            parameters: parameters.collect(),
            body: body.into_iter().map(|atom| Literal { atom, positive: true }).collect(),
        })
    }
}

/// Whether an action has a call of this name, and adds atoms of all these predicates.
pub(crate) fn is_about(schema: &ActionSchema, call: &Symbol, adds: &BTreeSet<Symbol>) -> bool {
    let is_added = |predicate: &Symbol| schema.adds().any(|atom| atom.predicate == *predicate);
    *call == schema.call.name && adds.iter().all(is_added)
}

/// The model with conditions on what is around written into the preconditions of the actions that they are about.
pub(crate) fn with_surroundings<'a>(
    mut model: Cow<'a, ActionModel>,
    conditions: &[ConditionAround],
) -> Cow<'a, ActionModel> {
    for condition in conditions {
        let Some(axiom) = condition.axiom(&model) else { continue };
        let places: Vec<usize> = condition.args.values().map(|(place, _)| *place).collect();
        let model = model.to_mut();
        for schema in model.actions.iter_mut().filter(|schema| is_about(schema, &condition.call, &condition.adds)) {
            let args = places.iter().map(|place| schema.call.args.get(*place).cloned()).collect::<Option<Vec<Term>>>();
            let Some(args) = args else { continue };
            let atom = LiftedAtom { predicate: axiom.head.predicate.clone(), args };
            schema.preconditions.push(Literal { atom, positive: condition.holds });
            schema.preconditions.sort_unstable();
            schema.preconditions.dedup();
        }
        if model.axioms.iter().any(|known| known.head == axiom.head) {
            continue;
        }
        let participants = axiom.parameters.iter().zip(&axiom.head.args);
        let variables = participants.map(|(parameter, term)| (parameter.name.clone(), term.clone())).collect();
        let name = |participant| {
            let place = condition.args.keys().position(|known| *known == participant).unwrap_or_default();
            format!("?p{}", place + 1)
        };
        let formula = condition.surrounding.in_words(name).into();
        model.wordings.insert(axiom.head.predicate.clone(), Wording { formula, positive: true, variables });
        let types = axiom.parameters.iter().take(axiom.head.args.len()).map(|parameter| parameter.ty);
        model.predicates.insert(axiom.head.predicate.clone(), types.collect());
        model.axioms.push(axiom);
    }
    model
}

#[cfg(test)]
mod tests {
    use typelift_model::{Budget, Cost, Effect, GroundAtom, Hierarchy, LiftedCall, Provenance, State, Task};
    use typelift_plan::{Outcome, Restrictions};

    use super::*;
    use crate::Options;
    use crate::propose::attempt;

    /// `empty(BOX)` empties, `open(BOX)` opens, `grab(CUP)` gets hold of it.
    fn model() -> ActionModel {
        let hierarchy = Hierarchy::from_edges([("box", "object"), ("cup", "object")]).expect("a tree");
        let action = |name: &str, ty: &str, adds: &str, deletes: Option<&str>| {
            let literal = |predicate: &str, positive: bool| Literal {
                atom: LiftedAtom::new(predicate, vec![Term::Param(0)]),
                positive,
            };
            let effects = [Some(literal(adds, true)), deletes.map(|predicate| literal(predicate, false))];
            ActionSchema {
                name: name.into(),
                call: LiftedCall { name: name.into(), args: vec![Term::Param(0)] },
                parameters: vec![Parameter { name: "x".into(), ty: hierarchy.id(ty).expect("a type") }],
                preconditions: Vec::new(),
                distinct: Vec::new(),
                effects: effects.into_iter().flatten().map(Effect::always).collect(),
                cost: Cost::UNIT,
                strict: true,
                named_by_call: false,
                provenance: Provenance::Given,
            }
        };
        let actions = vec![
            action("empty", "box", "emptied", Some("full")),
            action("grab", "cup", "held", None),
            action("open", "box", "opened", Some("closed")),
        ];
        ActionModel { actions, hierarchy, ..ActionModel::default() }
    }

    /// The plan that gets hold of the cup in the chest, where the crate is full and the chest closed, on some condition.
    fn plan(surrounding: Surrounding, holds: bool) -> Option<Vec<String>> {
        let things = [("cup", "cup"), ("chest", "box"), ("crate", "box")];
        let model = model();
        let objects = things.map(|(name, ty)| (name.into(), model.hierarchy.id(ty).expect("a type")));
        let atoms = ["full(crate)", "closed(chest)", "in(cup, chest)"];
        let atoms = atoms.map(|atom| GroundAtom::parse(atom).expect("an atom"));
        let init = State { objects: objects.into(), atoms: atoms.into(), ..State::default() };
        let task = Task::new(init, vec![GroundAtom::parse("held(cup)").expect("an atom")]);
        let args = surrounding.participants().into_iter().map(|participant| (participant, (0, "cup".into())));
        let condition = ConditionAround {
            call: "grab".into(),
            adds: ["held".into()].into(),
            args: args.collect(),
            surrounding,
            holds,
        };
        let model = with_surroundings(Cow::Borrowed(&model), &[condition]);
        let (none, options) = (Restrictions::default(), Options::default());
        let proposal = attempt(&model, &task, &none, &options, &[], &[], &Budget::unlimited()).expect("an answer");
        let Outcome::Solved(plan) = proposal.outcome else { return None };
        Some(plan.steps.iter().map(|step| step.call.to_string()).collect())
    }

    #[test]
    fn what_must_not_hold_around_is_changed_first() {
        let some = |property: &str| Surrounding::Something { property: property.into(), ty: "box".into() };
        let link = || Link { predicate: "in".into(), of: 0, first: true };
        let linked = |property: &str| Surrounding::Linked { link: link(), property: property.into() };
        let said = |steps: &[&str]| Some(steps.iter().map(ToString::to_string).collect::<Vec<_>>());
        assert_eq!(plan(some("full"), false), said(&["empty(crate)", "grab(cup)"]));
        assert_eq!(plan(some("opened"), false), said(&["grab(cup)"]), "nothing is");
        assert_eq!(plan(linked("closed"), false), said(&["open(chest)", "grab(cup)"]));
        assert_eq!(plan(linked("full"), false), said(&["grab(cup)"]), "it is not in the crate");
        assert_eq!(plan(linked("opened"), true), said(&["open(chest)", "grab(cup)"]));
        assert_eq!(plan(linked("broken"), true), None, "nothing ever is");
    }
}
