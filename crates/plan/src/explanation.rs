//! What is said where there is no plan, and how.

use std::fmt::{self, Display};

use serde::{Deserialize, Serialize};
use typelift_model::{ActionModel, GroundAtom, Symbol};

use crate::conflict::Conflict;
use crate::obstacle::Nearest;

/// Why a goal atom cannot be reached.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Unreached {
    /// No action can add it.
    NoAction,
    /// No action can add it: this one, which adds atoms of its predicate, can never be used.
    NeverUsed(Symbol),
    /// This action comes nearest to adding it.
    Nearest(Nearest),
    /// It is derived, and follows from nothing that can be reached. For each rule, something that the rule needs and that
    /// cannot be reached; nothing at all if there is a rule of which everything can be reached, but not together.
    Derived(Vec<String>),
    /// It is what the text puts as a part of the goal, and contradicts itself or what never changes.
    Impossible,
}

/// A goal atom that cannot be reached even if nothing is ever deleted.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnreachableGoal<A = GroundAtom> {
    /// The atom.
    pub atom: A,
    /// Why not.
    pub why: Unreached,
}

/// An atom that must not hold in the end, but does from the start, and that nothing deletes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UndeletedGoal<A = GroundAtom> {
    /// The atom.
    pub atom: A,
    /// The action that comes nearest to deleting it; none if no action deletes such atoms.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nearest: Option<Nearest>,
}

/// Goals of which it is said why they cannot be brought about; of more only how many there are.
const MOST_GOALS: usize = 8;

/// Why there is no plan. The planner says it of the model's atoms; [`in_words`](Explanation::in_words) of what these stand
/// for in the text that the model was made from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Explanation<A = GroundAtom> {
    /// Some goal atoms cannot be reached at all.
    Unreachable(Vec<UnreachableGoal<A>>),
    /// No state that can be reached holds both of two goal atoms.
    Exclusive {
        /// The one.
        one: A,
        /// The other.
        other: A,
    },
    /// Another planner says so, and no more.
    ToldByPlanner,
    /// These atoms must not hold in the end, but do from the start, and no action can delete them.
    NeverDeleted(Vec<UndeletedGoal<A>>),
    /// No state that can be reached satisfies the whole goal; where the search came closest, these were missing.
    NotTogether {
        /// The missing goal atoms, and whether each must hold. None where the search did not look at any state.
        missing: Vec<(A, bool)>,
        /// Two of the goal atoms that undo each other, if that is known.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        conflict: Option<Conflict<A>>,
    },
}

impl Explanation {
    /// The same in the words of the text that this model was made from.
    pub fn in_words(&self, model: &ActionModel) -> Explanation<String> {
        let words = |atom: &GroundAtom| model.in_words(atom, true);
        match self {
            Self::Unreachable(goals) => {
                let goal = |goal: &UnreachableGoal| UnreachableGoal { atom: words(&goal.atom), why: goal.why.clone() };
                Explanation::Unreachable(goals.iter().map(goal).collect())
            }
            Self::Exclusive { one, other } => Explanation::Exclusive { one: words(one), other: words(other) },
            Self::ToldByPlanner => Explanation::ToldByPlanner,
            Self::NeverDeleted(goals) => {
                let goal =
                    |goal: &UndeletedGoal| UndeletedGoal { atom: words(&goal.atom), nearest: goal.nearest.clone() };
                Explanation::NeverDeleted(goals.iter().map(goal).collect())
            }
            Self::NotTogether { missing, conflict } => {
                // A formula is negated in its own words.
                let literal = |(atom, positive): &(GroundAtom, bool)| match model.wordings.get(&atom.predicate) {
                    Some(_) => (model.in_words(atom, *positive), true),
                    None => (words(atom), *positive),
                };
                let conflict = conflict.as_ref().map(|conflict| conflict.map(words));
                Explanation::NotTogether { missing: missing.iter().map(literal).collect(), conflict }
            }
        }
    }
}

impl<A: Display + PartialEq> Display for Explanation<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreachable(goals) => write_some(f, goals, "cannot be reached"),
            Self::Exclusive { one, other } => {
                write!(f, "{one} and {other} cannot hold together: no state that can be reached holds both")
            }
            Self::ToldByPlanner => f.write_str("the planner says that there is none"),
            Self::NeverDeleted(goals) => write_some(f, goals, "cannot be deleted"),
            Self::NotTogether { missing, conflict } => {
                f.write_str("no state that can be reached satisfies the goal")?;
                let missing: Vec<String> = missing
                    .iter()
                    .map(|(atom, positive)| format!("{}{atom}", if *positive { "" } else { "not " }))
                    .collect();
                if !missing.is_empty() {
                    write!(f, "; at best this is missing: {}", missing.join(", "))?;
                }
                conflict.iter().try_for_each(|conflict| write!(f, "\n{conflict}"))
            }
        }
    }
}

/// A line for each of the first goals, and how many more there are of which the same is to be said.
fn write_some(f: &mut fmt::Formatter<'_>, goals: &[impl Display], cannot: &str) -> fmt::Result {
    let lines: Vec<String> = goals.iter().take(MOST_GOALS).map(ToString::to_string).collect();
    f.write_str(&lines.join("\n"))?;
    match goals.len().saturating_sub(MOST_GOALS) {
        0 => Ok(()),
        more => write!(f, "\n{more} more {cannot}"),
    }
}

impl<A: Display> Display for UnreachableGoal<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let atom = &self.atom;
        match &self.why {
            Unreached::Impossible => write!(f, "{atom} can never hold"),
            why => write!(f, "{atom} cannot be reached: {why}"),
        }
    }
}

impl Display for Unreached {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAction => f.write_str("no action can add it"),
            Self::NeverUsed(action) => {
                write!(f, "no action can add it: {action}, which adds such atoms, can never be used")
            }
            Self::Nearest(nearest) => nearest.say(f, "add"),
            Self::Derived(needed) if needed.is_empty() => f.write_str("it follows from nothing that can be reached"),
            Self::Derived(needed) => {
                write!(f, "it follows only from what cannot be reached: {}", needed.join(", "))
            }
            Self::Impossible => f.write_str("it can never hold"),
        }
    }
}

impl<A: Display> Display for UndeletedGoal<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} must not hold in the end, ", self.atom)?;
        match &self.nearest {
            None => f.write_str("but no action can delete it"),
            Some(nearest) => {
                f.write_str("and cannot be deleted: ")?;
                nearest.say(f, "delete")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_goals_the_first_are_explained_and_the_others_counted() {
        let goal = |i: usize| UnreachableGoal { atom: format!("done(job_{i})"), why: Unreached::NoAction };
        let said = |n: usize| Explanation::Unreachable((0..n).map(goal).collect::<Vec<_>>()).to_string();
        assert_eq!(said(MOST_GOALS).lines().count(), MOST_GOALS);
        let of_many = said(MOST_GOALS + 3);
        assert_eq!(of_many.lines().last(), Some("3 more cannot be reached"));
        assert_eq!(of_many.lines().count(), MOST_GOALS + 1);
    }
}
