//! Why an action changed nothing.

use thiserror::Error;
use typelift_model::Symbol;

impl Refusal {
    /// Whether it is a matter of the types of the arguments alone, and would be so in every state.
    pub(crate) fn is_of_types(&self) -> bool {
        match self {
            Self::UnknownAction { .. } | Self::Arguments { .. } | Self::NotA { .. } => true,
            Self::NotAccepted { because, .. } => {
                [NOT_FOOD, NEEDS_MACHETE, NOT_BLENDABLE, NOT_TOASTABLE].contains(because)
            }
            _ => false,
        }
    }
}

/// Objections that are a matter of types.
pub(crate) const NOT_FOOD: &str = "it is not food";
pub(crate) const NEEDS_MACHETE: &str = "only a machete cuts it";
pub(crate) const NOT_BLENDABLE: &str = "it cannot be blended";
pub(crate) const NOT_TOASTABLE: &str = "it cannot be toasted";

/// Why an action changed nothing.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Refusal {
    /// The action is none of PICK, PLACE and USE.
    #[error("there is no action `{name}`; there are PICK, PLACE and USE")]
    UnknownAction {
        /// The name that was called.
        name: Symbol,
    },
    /// Too few or too many arguments.
    #[error("{name} takes ({form}), but the number of its arguments is {count}")]
    Arguments {
        /// The action.
        name: Symbol,
        /// What it takes.
        form: &'static str,
        /// How many there were.
        count: usize,
    },
    /// A name that nothing in the room has.
    #[error("there is no `{name}` here")]
    UnknownEntity {
        /// The name.
        name: Symbol,
    },
    /// An argument that is something else than it has to be.
    #[error("`{name}` is not {wanted}")]
    NotA {
        /// The argument.
        name: Symbol,
        /// What it has to be, with its article.
        wanted: &'static str,
    },
    /// The named item is not in the named container.
    #[error("{item} does not lie in {container}")]
    NotThere {
        /// The item.
        item: Symbol,
        /// The container.
        container: Symbol,
    },
    /// The hand is not empty.
    #[error("the hand already holds {held}")]
    HandFull {
        /// What it holds.
        held: Symbol,
    },
    /// The hand is empty.
    #[error("the hand holds nothing")]
    HandEmpty,
    /// The hand holds another item.
    #[error("the hand holds {held}, not {item}")]
    NotHeld {
        /// The item named.
        item: Symbol,
        /// What it holds.
        held: Symbol,
    },
    /// The item lies on a plate, and what lies there stays there.
    #[error("{item} lies on {plate}, and food is not taken from a plate")]
    OnPlate {
        /// The item.
        item: Symbol,
        /// The plate.
        plate: Symbol,
    },
    /// Another item lies on the item.
    #[error("{item} is not the topmost item in {container}: {above} is")]
    Covered {
        /// The item.
        item: Symbol,
        /// Where both lie.
        container: Symbol,
        /// The topmost.
        above: Symbol,
    },
    /// The plate is in a hand.
    #[error("{plate} does not lie in a station")]
    PlateInHand {
        /// The plate.
        plate: Symbol,
    },
    /// The container has no room left.
    #[error("{container} is full")]
    Full {
        /// The container.
        container: Symbol,
    },
    /// The container does not take the item.
    #[error("{container} does not take {item}: {because}")]
    NotAccepted {
        /// The container.
        container: Symbol,
        /// The item.
        item: Symbol,
        /// What stands against it.
        because: &'static str,
    },
    /// The tool's status is not Ready.
    #[error("the status of {tool} is not Ready")]
    NotReady {
        /// The tool.
        tool: Symbol,
    },
    /// The tool does nothing.
    #[error("{tool} was used, but nothing happened")]
    NothingHappened {
        /// The tool.
        tool: Symbol,
    },
    /// There is no way to a cell next to the target.
    #[error("there is no way to {target}")]
    Unreachable {
        /// The station to be reached.
        target: Symbol,
    },
}
