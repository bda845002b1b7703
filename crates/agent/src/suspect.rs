//! What may be to blame for a failure, and is avoided therefore: restrictions for a planner, and conditions that are written
//! into the model.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::{ActionModel, GroundAtom, Literal, Symbol, Term};
use typelift_plan::{Exclusion, TypeExclusion};

use crate::around::{ConditionAround, is_about, with_surroundings};

/// What may be to blame for a failure, and is avoided therefore.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "suspect", rename_all = "snake_case")]
pub enum Suspect {
    /// An object, in its instance of the world.
    Object(Exclusion),
    /// A type at a place of a call, or several together: the action was generalized too far.
    Types(TypeExclusion),
    /// Something that must hold, or must not: a precondition is missing.
    Condition(Condition),
    /// The same of something that the call does not name.
    Around(ConditionAround),
}

impl Suspect {
    /// Whether it speaks of what holds, which may be otherwise the next time.
    pub(crate) fn is_conditional(&self) -> bool {
        matches!(self, Self::Condition(_) | Self::Around(_))
    }

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
            Self::Around(condition) => condition.fmt(f),
        }
    }
}

/// What must hold, or must not, where a call is used.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Condition {
    /// In actions of this call name,
    pub call: Symbol,
    /// of those the ones that add atoms of all these predicates.
    pub adds: BTreeSet<Symbol>,
    /// The atom, as it was said of the call with `args`.
    pub atom: GroundAtom,
    /// Whether it must hold; else it must not.
    #[serde(default)]
    pub holds: bool,
    /// The objects at the call's places, from 0: where the atom mentions one of them, it speaks of that place.
    #[serde(deserialize_with = "typelift_model::numbered_keys")]
    pub args: BTreeMap<usize, Symbol>,
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.call, if self.holds { "without" } else { "while" }, self.atom)
    }
}

/// What keeps actions from being used.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Conditions {
    /// Over the objects of a call.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub named: Vec<Condition>,
    /// Over something that a call does not name.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub around: Vec<ConditionAround>,
}

impl Conditions {
    /// The model with them.
    pub(crate) fn in_model<'a>(&self, model: &'a ActionModel) -> Cow<'a, ActionModel> {
        with_surroundings(with_conditions(model, &self.named), &self.around)
    }
}

/// The model with conditions written into the preconditions of the actions that they are about.
fn with_conditions<'a>(model: &'a ActionModel, conditions: &[Condition]) -> Cow<'a, ActionModel> {
    if conditions.is_empty() {
        return Cow::Borrowed(model);
    }
    let mut model = model.clone();
    for schema in &mut model.actions {
        for condition in conditions {
            if !is_about(schema, &condition.call, &condition.adds) {
                continue;
            }
            let term = |object: &Symbol| {
                let place = condition.args.iter().find(|(_, at)| *at == object).map(|(place, _)| *place);
                place
                    .and_then(|place| schema.call.args.get(place).cloned())
                    .unwrap_or_else(|| Term::Const(object.clone()))
            };
            let atom = condition.atom.map(term);
            schema.preconditions.push(Literal { atom, positive: condition.holds });
        }
        schema.preconditions.sort_unstable();
        schema.preconditions.dedup();
    }
    Cow::Owned(model)
}

/// How sure it is that something is to blame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Certainty {
    /// Something of the call is likelier at fault than not, and nothing more than this.
    Guessed,
    /// It is likelier at fault than not, or somebody said so.
    Likely,
}

/// What may be to blame, and how sure that is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Suspected {
    /// What.
    pub suspect: Suspect,
    /// How sure.
    pub certainty: Certainty,
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
        let condition = |holds| Condition {
            call: call(),
            adds: BTreeSet::new(),
            atom: GroundAtom::parse("wet(log_1)").expect("an atom"),
            holds,
            args: BTreeMap::from([(1, "log_1".into())]),
        };
        let conditions = [true, false].map(|holds| Suspect::Condition(condition(holds)));
        for suspect in [Suspect::Object(object), Suspect::Types(types)].into_iter().chain(conditions) {
            let text = serde_json::to_string(&suspect).expect("JSON");
            assert_eq!(serde_json::from_str::<Suspect>(&text).map_err(|e| e.to_string()), Ok(suspect), "{text}");
        }
    }
}
