//! What passes between an episode and its driver.
//!
//! Each command carries an id that its answer echoes. What answers another command than the one that stands changes
//! nothing: an approval counts for the plan that was shown, a result for the action that was begun, and for no other.

use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::{GroundCall, Plan, State, Symbol};
use typelift_world::{ParseError, Parser, Scene};

use crate::account::Account;
use crate::objection::Objection;

/// The number of a command, from 1; only its episode makes them. A command that is repeated keeps its number.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct CommandId(u64);

impl CommandId {
    /// The number of the command after this one.
    pub(crate) fn next(self) -> Self {
        Self(self.0 + 1)
    }
}

impl fmt::Display for CommandId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)
    }
}

/// What the driver is to do. `P` is how plans are told, `A` how the account is: programs outside are given views of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "command", rename_all = "snake_case")]
pub enum Command<P = Plan, A = Box<Account>> {
    /// Set the world to its initial state; answer with [`Input::Reset`].
    Reset {
        /// The answer names it.
        id: CommandId,
    },
    /// Observe; answer with an observation.
    Observe {
        /// The answer names it.
        id: CommandId,
    },
    /// Have this plan approved or rejected, if anyone is to be asked; or ask for another.
    Propose {
        /// The answer names it.
        id: CommandId,
        /// The plan.
        plan: P,
    },
    /// Execute this; answer with an observation, a refusal or a time-out.
    Act {
        /// The answer names it.
        id: CommandId,
        /// The action.
        call: GroundCall,
    },
    /// This was to be executed, and its result has not been reported: not to be executed again, since it may be under
    /// way. Answer as [`Act`](Self::Act) would be answered.
    Await {
        /// The id of the action's [`Act`](Self::Act).
        id: CommandId,
        /// The action.
        call: GroundCall,
    },
    /// It is over.
    Done(A),
}

impl<P, A> Command<P, A> {
    /// The same with plan and account told as these do.
    pub fn map<Q, B>(self, tell_plan: impl FnOnce(P) -> Q, tell_account: impl FnOnce(A) -> B) -> Command<Q, B> {
        match self {
            Self::Reset { id } => Command::Reset { id },
            Self::Observe { id } => Command::Observe { id },
            Self::Propose { id, plan } => Command::Propose { id, plan: tell_plan(plan) },
            Self::Act { id, call } => Command::Act { id, call },
            Self::Await { id, call } => Command::Await { id, call },
            Self::Done(account) => Command::Done(tell_account(account)),
        }
    }
}

/// What the driver reports. `S` is how it tells states: as a [`Scene`] on the wire.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "input", rename_all = "snake_case")]
pub enum Input<S = State> {
    /// The episode may begin. Later: which command stands?
    Started,
    /// The world is in its initial state.
    Reset {
        /// The id of the command that is answered.
        id: CommandId,
        /// What is observed.
        state: S,
        /// In which instance of the world names mean what they mean now, if that is known.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        instance: Option<Symbol>,
    },
    /// What is observed, after an action that was executed too.
    Observation {
        /// The id of the command that is answered.
        id: CommandId,
        /// What is observed.
        state: S,
    },
    /// The plan may be executed.
    Approve {
        /// The id of the proposal that was shown.
        id: CommandId,
    },
    /// A step of the proposed plan is not to be taken.
    Reject {
        /// The id of the proposal that was shown.
        id: CommandId,
        /// The step, counted from 1; one that there is not counts as the nearest that there is.
        step: usize,
        /// What speaks against it; if nothing is said, the kind of thing that an imagined step puts where it was never
        /// seen, else what a failure would be blamed on.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        objection: Option<Objection>,
        /// Why, in words.
        reason: String,
    },
    /// Another plan is wanted instead of the proposed one, against which nothing is said.
    AnotherPlan {
        /// The id of the proposal that was shown.
        id: CommandId,
    },
    /// A person showed what to do instead of the proposed plan; with what is observed now.
    Shown {
        /// The id of the proposal that was shown.
        id: CommandId,
        /// What is observed.
        state: S,
    },
    /// The environment declined the action; with what is observed now. The observation decides: if what was
    /// expected happened all the same, the step succeeded.
    Refused {
        /// The id of the command that is answered.
        id: CommandId,
        /// Why.
        reason: String,
        /// What is observed now.
        state: S,
    },
    /// The action was not finished in time, but the world may still be observed, which the episode asks for next.
    TimedOut {
        /// The id of the command that is answered.
        id: CommandId,
    },
    /// End the episode.
    Stop,
}

impl<S> Input<S> {
    /// The id of the command that it answers; none if it may come at any time.
    pub fn id(&self) -> Option<CommandId> {
        match self {
            Self::Started | Self::Stop => None,
            Self::Reset { id, .. }
            | Self::Observation { id, .. }
            | Self::Approve { id }
            | Self::Reject { id, .. }
            | Self::AnotherPlan { id }
            | Self::Shown { id, .. }
            | Self::Refused { id, .. }
            | Self::TimedOut { id } => Some(*id),
        }
    }

    /// The same with its state read by `read`.
    ///
    /// # Errors
    /// What `read` fails with.
    pub fn try_map<T, E>(self, read: impl FnOnce(S) -> Result<T, E>) -> Result<Input<T>, E> {
        Ok(match self {
            Self::Started => Input::Started,
            Self::Reset { id, state, instance } => Input::Reset { id, state: read(state)?, instance },
            Self::Observation { id, state } => Input::Observation { id, state: read(state)? },
            Self::Approve { id } => Input::Approve { id },
            Self::Reject { id, step, objection, reason } => Input::Reject { id, step, objection, reason },
            Self::AnotherPlan { id } => Input::AnotherPlan { id },
            Self::Shown { id, state } => Input::Shown { id, state: read(state)? },
            Self::Refused { id, reason, state } => Input::Refused { id, reason, state: read(state)? },
            Self::TimedOut { id } => Input::TimedOut { id },
            Self::Stop => Input::Stop,
        })
    }
}

impl Input<Scene> {
    /// The input with its state parsed.
    ///
    /// # Errors
    /// [`ParseError`] if the scene is none.
    pub fn parsed(self, parser: &mut Parser) -> Result<Input, ParseError> {
        self.try_map(|scene| parser.parse(&scene))
    }
}
