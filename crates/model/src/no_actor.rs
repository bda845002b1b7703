//! Why a model has no default actor.

use std::collections::BTreeSet;

use crate::Symbol;

/// A place in which something takes part in a call without acting.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ActedOn {
    /// The call's name.
    pub call: Symbol,
    /// The argument, from 0; none if the call does not name what is there.
    pub argument: Option<usize>,
    /// The type of what was seen there.
    pub ty: Symbol,
}

/// Why the demonstrations do not show who acts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoActor {
    /// No action was learned.
    NothingLearned,
    /// This call has no argument.
    NoArgument(Symbol),
    /// All calls have this name.
    OneCall(Symbol),
    /// What acts is acted on as well: its type was seen in this place, too.
    ActedOn(ActedOn),
    /// What acts takes no other part, but its types have nothing in common but the root.
    NothingInCommon {
        /// The types that act.
        acting: BTreeSet<Symbol>,
        /// The root.
        root: Symbol,
    },
    /// What acts takes no other part, but the type in which its types meet has something in common with what does.
    NotAlone {
        /// The types that act.
        acting: BTreeSet<Symbol>,
        /// Where they meet.
        meet: Symbol,
        /// What takes another part.
        other: ActedOn,
        /// Whether all of that other type is of the type in which they meet; otherwise some of it may be.
        is_covered: bool,
    },
    /// Things of this type are argument 0 of calls of every name, and take no other part; but in some calls something else is.
    NotAlways {
        /// That type.
        actor: Symbol,
        /// The name of such a call.
        call: Symbol,
        /// The type that is argument 0 of it.
        other: Symbol,
    },
    /// All calls but those of one name show who acts.
    ButFor {
        /// That name.
        call: Symbol,
        /// Who acts in all the others.
        actor: Symbol,
        /// Whether none of its own calls has anything of that type in it.
        is_without: bool,
    },
}

impl NoActor {
    /// Whether an actor may have been expected: it is missing for the hierarchy of types alone, or for calls of a single
    /// name.
    pub fn is_unexpected(&self) -> bool {
        matches!(
            self,
            Self::NothingInCommon { .. } | Self::NotAlone { .. } | Self::NotAlways { .. } | Self::ButFor { .. }
        )
    }
}
