//! Commands and events as they go over a wire, to a page or a robot's own loop: nothing in them needs a model to be read.
//! An [`Input`](typelift_agent::Input) over a [`Scene`](typelift_world::Scene) is one already.

use typelift_agent::{Account, Command, Event};
use typelift_model::Hierarchy;

use crate::account::AccountView;
use crate::plan::PlanView;

/// A command as a program outside reads it.
pub type WireCommand = Command<PlanView, AccountView>;

/// An event as a program outside reads it.
pub type WireEvent = Event<PlanView>;

/// The command as it goes over a wire; `hierarchy` is that of the episode's model, and `tell_account` gives the view of the
/// account, which needs what the driver knows: the task's name, and how long planning took.
pub fn wire_command(
    command: Command,
    hierarchy: &Hierarchy,
    tell_account: impl FnOnce(&Account) -> AccountView,
) -> WireCommand {
    command.map(|plan| PlanView::of(&plan, hierarchy), |account| tell_account(&account))
}

/// The event as it goes over a wire; `hierarchy` is that of the episode's model.
pub fn wire_event(event: &Event, hierarchy: &Hierarchy) -> WireEvent {
    event.map_plan(|plan| PlanView::of(plan, hierarchy))
}
