//! Commands and events as they go over a wire, to a page or a robot's own loop: nothing in them needs a model to be read.
//! An [`Input`](typelift_agent::Input) over a [`Scene`](typelift_world::Scene) is one already.

use serde::{Deserialize, Serialize};
use typelift_agent::{Account, Command, Event};
use typelift_model::Hierarchy;

use crate::plan::PlanView;

/// A command as a program outside reads it.
pub type WireCommand = Command<PlanView, DoneView>;

/// An event as a program outside reads it.
pub type WireEvent = Event<PlanView>;

/// How an episode ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DoneView {
    /// The [word](typelift_agent::Ending::word) for how it ended.
    pub ending: String,
    /// Plans proposed, the successful one included.
    pub proposals: u64,
    /// Actions executed, retries included.
    pub actions: u64,
}

impl DoneView {
    /// The view of an account.
    pub fn of(account: &Account) -> Self {
        let (ending, proposals, actions) = (account.ending.word().to_owned(), account.proposals, account.actions);
        Self { ending, proposals, actions }
    }
}

/// The command as it goes over a wire; `hierarchy` is that of the episode's model.
pub fn wire_command(command: Command, hierarchy: &Hierarchy) -> WireCommand {
    command.map(|plan| PlanView::of(&plan, hierarchy), |account| DoneView::of(&account))
}

/// The event as it goes over a wire; `hierarchy` is that of the episode's model.
pub fn wire_event(event: &Event, hierarchy: &Hierarchy) -> WireEvent {
    event.map_plan(|plan| PlanView::of(plan, hierarchy))
}
