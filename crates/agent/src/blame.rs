//! What is to blame for a failure: a function of the failure and of everything else that was tried.
//!
//! An object of the call that has never worked there in this instance of the world comes first; where all have, the
//! types that have never worked in that place; then the pairs of types that have never worked together, or, where the
//! call does not name both, the object of such a pair. Who acts is never to blame, and who the goal speaks of only
//! together with another. A precondition is to blame only where a person names it. Since what worked later counts as
//! well, a thing that works again is no longer to blame.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::{ActionModel, GroundAtom, Literal, Symbol, Term};
use typelift_plan::{Exclusion, TypeExclusion};

use crate::deed::{Deed, Failed, Participant, Success};
use crate::objection::Objection;

/// What may be to blame for a failure, and is avoided therefore.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "suspect", rename_all = "snake_case")]
pub enum Suspect {
    /// An object, in its instance of the world.
    Object(Exclusion),
    /// A type at a place of a call, or several together: the action was generalized too far.
    Types(TypeExclusion),
    /// Something that must not hold: a precondition is missing.
    Condition(Condition),
}

impl Suspect {
    /// Whether it is about a thing, which only one instance of the world has.
    pub fn belongs_to_instance(&self) -> bool {
        matches!(self, Self::Object(_))
    }
}

impl fmt::Display for Suspect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Object(exclusion) => exclusion.fmt(f),
            Self::Types(exclusion) => exclusion.fmt(f),
            Self::Condition(condition) => condition.fmt(f),
        }
    }
}

/// What must not hold where a call is used.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Condition {
    /// In actions of this call name,
    pub call: Symbol,
    /// of those the ones that add atoms of all these predicates.
    pub adds: BTreeSet<Symbol>,
    /// The atom, as it was said of the call with `args`.
    pub atom: GroundAtom,
    /// The objects at the call's places, from 0: where the atom mentions one of them, it speaks of that place.
    #[serde(deserialize_with = "typelift_model::numbered_keys")]
    pub args: BTreeMap<usize, Symbol>,
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} while {}", self.call, self.atom)
    }
}

/// The model with conditions written into the preconditions of the actions that they are about.
pub(crate) fn with_conditions<'a>(model: &'a ActionModel, conditions: &[Condition]) -> Cow<'a, ActionModel> {
    if conditions.is_empty() {
        return Cow::Borrowed(model);
    }
    let mut model = model.clone();
    for schema in &mut model.actions {
        for condition in conditions {
            let adds = |predicate: &Symbol| schema.adds().any(|atom| atom.predicate == *predicate);
            if condition.call != schema.call.name || !condition.adds.iter().all(adds) {
                continue;
            }
            let term = |object: &Symbol| {
                let place = condition.args.iter().find(|(_, at)| *at == object).map(|(place, _)| *place);
                place
                    .and_then(|place| schema.call.args.get(place).cloned())
                    .unwrap_or_else(|| Term::Const(object.clone()))
            };
            schema.preconditions.push(Literal::negative(condition.atom.map(term)));
        }
        schema.preconditions.sort_unstable();
        schema.preconditions.dedup();
    }
    Cow::Owned(model)
}

/// What is to blame for a failure. Nothing may be: then only the very same action is not tried again.
pub fn suspects(failed: &Failed, worked: &[Success]) -> Vec<Suspect> {
    let deed = &failed.deed;
    let named = |objects: &[Symbol]| -> Vec<&Participant> {
        deed.participants.iter().filter(|participant| objects.contains(&participant.object)).collect()
    };
    match &failed.objection {
        None => by_elimination(failed, worked),
        Some(Objection::Broken { objects }) if objects.is_empty() => broken(failed, suspected(failed)),
        Some(Objection::Broken { objects }) => broken(failed, named(objects)),
        Some(Objection::WrongKind { objects }) if objects.is_empty() => {
            let placed = suspected(failed).into_iter().filter(|one| one.place.is_some());
            types(deed, placed.collect()).into_iter().collect()
        }
        Some(Objection::WrongKind { objects }) => types(deed, named(objects)).into_iter().collect(),
        Some(Objection::While { atom }) => {
            let placed = deed.participants.iter().filter_map(|one| Some((one.place?, one.object.clone())));
            let (call, adds, atom) = (deed.call.clone(), deed.adds.clone(), atom.clone());
            vec![Suspect::Condition(Condition { call, adds, atom, args: placed.collect() })]
        }
        Some(Objection::NotNow) => Vec::new(),
    }
}

/// The first of objects, types and pairs of types that leaves something which has never worked.
fn by_elimination(failed: &Failed, worked: &[Success]) -> Vec<Suspect> {
    let deed = &failed.deed;
    let known = Known { deed, worked };
    let suspected = suspected(failed);
    let objects: Vec<&Participant> = suspected.iter().copied().filter(|one| !known.object_worked(one)).collect();
    if !objects.is_empty() {
        return broken(failed, objects);
    }
    let alone = suspected.iter().copied().filter(|one| !known.types_worked(&[one]));
    let alone: Vec<Suspect> = alone.filter_map(|one| types(deed, vec![one])).collect();
    if !alone.is_empty() {
        return alone;
    }
    let others = || deed.participants.iter().filter(|other| !failed.actors.contains(&other.object));
    let pairs = suspected.iter().flat_map(|&one| others().map(move |other| [one, other]));
    let apart = pairs.filter(|[one, other]| one.object != other.object && !known.types_worked(&[one, other]));
    let (mut together, mut unnamed) = (BTreeSet::new(), Vec::new());
    for [one, other] in apart {
        match types(deed, vec![one, other]) {
            Some(types) => _ = together.insert(types),
            None => unnamed.push(one),
        }
    }
    // Types are avoided at places of a call. Of a pair that the call does not name, the object is all that can be avoided.
    if together.is_empty() { broken(failed, unnamed) } else { together.into_iter().collect() }
}

/// Who takes part and neither acts nor is in the goal.
fn suspected(failed: &Failed) -> Vec<&Participant> {
    let spared = |object: &Symbol| failed.actors.contains(object) || failed.in_goal.contains(object);
    failed.deed.participants.iter().filter(|participant| !spared(&participant.object)).collect()
}

fn broken(failed: &Failed, participants: Vec<&Participant>) -> Vec<Suspect> {
    let call = (!failed.useless).then(|| failed.deed.call.clone());
    let objects: BTreeSet<&Symbol> = participants.into_iter().map(|participant| &participant.object).collect();
    let exclusion = |object: &Symbol| Suspect::Object(Exclusion { object: object.clone(), call: call.clone() });
    objects.into_iter().map(exclusion).collect()
}

/// The types of these, together at their places; none if one of them has no place.
fn types(deed: &Deed, participants: Vec<&Participant>) -> Option<Suspect> {
    let place = |participant: &Participant| Some((participant.place?, participant.ty.clone()));
    let types: BTreeMap<usize, Symbol> = participants.into_iter().map(place).collect::<Option<_>>()?;
    let (call, adds) = (deed.call.clone(), deed.adds.clone());
    (!types.is_empty()).then_some(Suspect::Types(TypeExclusion { call, adds, types }))
}

/// What is known of the parts of a deed.
struct Known<'a> {
    deed: &'a Deed,
    worked: &'a [Success],
}

impl Known<'_> {
    /// Whether the object has worked in the same place of the same call in the same instance.
    fn object_worked(&self, participant: &Participant) -> bool {
        let worked = self.worked.iter().map(|success| &success.deed);
        let mut here = worked.filter(|deed| deed.instance == self.deed.instance && deed.call == self.deed.call);
        here.any(|deed| {
            let same = |other: &Participant| other.object == participant.object && other.place == participant.place;
            deed.participants.iter().any(same)
        })
    }

    /// Whether things of these types have worked together, in the same places of a call that was to do the same.
    fn types_worked(&self, participants: &[&Participant]) -> bool {
        let worked = self.worked.iter().map(|success| &success.deed);
        let mut alike = worked.filter(|deed| deed.call == self.deed.call && deed.adds == self.deed.adds);
        alike.any(|deed| {
            participants.iter().all(|participant| {
                let same = |other: &Participant| other.ty == participant.ty && other.place == participant.place;
                deed.participants.iter().any(same)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suspects_are_read_as_they_were_written() {
        let call = || Symbol::new("cut");
        let object = Exclusion { object: "saw_1".into(), call: Some(call()) };
        let types = TypeExclusion {
            call: call(),
            adds: BTreeSet::new(),
            types: BTreeMap::from([(0, "saw".into()), (1, "log".into())]),
        };
        let atom = GroundAtom::parse("wet(log_1)").expect("an atom");
        let condition =
            Condition { call: call(), adds: BTreeSet::new(), atom, args: BTreeMap::from([(1, "log_1".into())]) };
        for suspect in [Suspect::Object(object), Suspect::Types(types), Suspect::Condition(condition)] {
            let text = serde_json::to_string(&suspect).expect("JSON");
            assert_eq!(serde_json::from_str::<Suspect>(&text).map_err(|e| e.to_string()), Ok(suspect), "{text}");
        }
    }
}
