//! The environment, as its agent sees it.

use thiserror::Error;
use typelift_model::{GroundCall, Symbol};

use crate::{Scene, UnreadKey};

/// How an environment is to be set up.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Reset {
    /// The seed of whatever it leaves to chance.
    pub seed: u64,
    /// What to set up, in the environment's own terms; `None` for its default.
    pub scenario: Option<serde_json::Value>,
}

/// What came of an action.
#[derive(Debug, Clone, PartialEq)]
pub struct Acted {
    /// What is observed when the world has settled.
    pub scene: Scene,
    /// Whether the environment says that it did it. The scene decides what is believed.
    pub executed: bool,
    /// Why not, if it says so.
    pub reason: Option<String>,
}

/// An environment that failed: not an action that did, but the environment itself.
/// What can be done about it depends on the kind; the account says what happened, with what was sent and what came back
/// where there was a conversation.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum WorldError {
    /// Something was asked of it before it was set up.
    #[error("the {world} has not been set up: reset comes first")]
    NotSetUp {
        /// What it calls itself.
        world: String,
    },
    /// It cannot be set up like this. In another way it may be.
    #[error("{account}")]
    CannotSetUp {
        /// What happened.
        account: String,
    },
    /// It could not be started, or is there no more.
    #[error("{account}")]
    Gone {
        /// What happened.
        account: String,
    },
    /// It did not answer in time. Whether it did what was asked is not known.
    #[error("{account}")]
    TimedOut {
        /// What happened.
        account: String,
    },
    /// What it answers is not what the protocol says.
    #[error("{account}")]
    Misspoke {
        /// What happened.
        account: String,
    },
    /// It says that it could not do what was asked.
    #[error("{account}")]
    Failed {
        /// What happened.
        account: String,
    },
}

impl WorldError {
    /// The same error, come after something that explains it.
    #[must_use]
    pub fn after(self, what: &str) -> Self {
        let told = |account: String| format!("{what}; after that, {account}");
        match self {
            Self::NotSetUp { .. } => self,
            Self::CannotSetUp { account } => Self::CannotSetUp { account: told(account) },
            Self::Gone { account } => Self::Gone { account: told(account) },
            Self::TimedOut { account } => Self::TimedOut { account: told(account) },
            Self::Misspoke { account } => Self::Misspoke { account: told(account) },
            Self::Failed { account } => Self::Failed { account: told(account) },
        }
    }
}

/// The instance of the world that this one is in after this reset: as it says itself. Else a world that cannot be reset
/// stays one instance, and the same scenario and seed of one are one instance.
pub fn instance_of(world: &dyn World, reset: &Reset) -> Symbol {
    world.instance().unwrap_or_else(|| match (&reset.scenario, world.can_reset()) {
        (_, false) => Symbol::from(world.name()),
        (None, true) => Symbol::from(format!("{}, seed {}", world.name(), reset.seed)),
        (Some(scenario), true) => {
            let scenario = fingerprint(&scenario.to_string());
            Symbol::from(format!("{}, seed {}, scenario {scenario:016x}", world.name(), reset.seed))
        }
    })
}

/// FNV-1a, for a short name of a scenario, which may be large.
fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// An environment: a simulator, a robot, a replayed log.
pub trait World: Send {
    /// What it calls itself.
    fn name(&self) -> String;

    /// Whether it can be set back to an initial state.
    fn can_reset(&self) -> bool {
        true
    }

    /// The instance of the world that it is in, if it says so: as long as this is the same, names mean the same things.
    fn instance(&self) -> Option<Symbol> {
        None
    }

    /// Sets it to an initial state and observes it.
    ///
    /// # Errors
    /// [`WorldError`] if the environment fails or cannot set this up.
    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError>;

    /// Observes it.
    ///
    /// # Errors
    /// [`WorldError`] if the environment fails.
    fn observe(&mut self) -> Result<Scene, WorldError>;

    /// Performs an action and observes what came of it, once the world has settled.
    ///
    /// # Errors
    /// [`WorldError`] if the environment fails; an action that has no effect is not an error.
    fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError>;

    /// The calls that would not be refused in the present scene, in their order; `None` if it does not know. Nothing is
    /// said of what would come of them.
    fn possible_calls(&self) -> Option<Vec<GroundCall>> {
        None
    }

    /// The keys of entities in what it reported so far that nothing reads, each once.
    fn unread_keys(&self) -> &[UnreadKey] {
        &[]
    }

    /// Ends it. Afterwards nothing is asked of it.
    ///
    /// # Errors
    /// [`WorldError`] if it does not end as it should.
    fn close(&mut self) -> Result<(), WorldError> {
        Ok(())
    }
}
