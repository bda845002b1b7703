//! A kitchen of which somebody knows what no state tells.

use std::sync::{Arc, Mutex};

use typelift::agent::{Confirmation, Objection};
use typelift::model::{GroundAtom, GroundCall, Plan, Symbol};
use typelift::world::{Acted, Reset, Scene, World, WorldError};
use typelift_kitchen::{Fault, Kitchen, Room};

use crate::runner::locked;

/// A kitchen that notes for each call why it changes nothing, if it does.
#[derive(Debug, Default)]
pub(super) struct Watched {
    kitchen: Kitchen,
    notes: Arc<Mutex<Notes>>,
}

/// What is noted.
#[derive(Debug, Default)]
pub(super) struct Notes {
    /// For each call that was made why it changed nothing; none if it changed something.
    pub(super) faults: Vec<Option<Fault>>,
    /// The room as it is now.
    room: Option<Room>,
}

impl Watched {
    /// What is noted, now and later.
    pub(super) fn notes(&self) -> Arc<Mutex<Notes>> {
        Arc::clone(&self.notes)
    }
}

impl World for Watched {
    fn name(&self) -> String {
        self.kitchen.name()
    }

    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError> {
        let scene = self.kitchen.reset(reset)?;
        locked(&self.notes).room = self.kitchen.room().cloned();
        Ok(scene)
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        self.kitchen.observe()
    }

    fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError> {
        let fault = self.kitchen.room().and_then(|room| room.fault(call));
        let acted = self.kitchen.act(call)?;
        let mut notes = locked(&self.notes);
        notes.faults.push(fault);
        notes.room = self.kitchen.room().cloned();
        Ok(acted)
    }
}

impl Notes {
    /// What whoever knows all but that `newly_broken` is broken says to a plan. Once it failed, that is known as well.
    pub(super) fn answer(&self, plan: &Plan, newly_broken: Option<&Symbol>) -> Confirmation {
        let Some(mut room) = self.room.clone() else { return Confirmation::Approve };
        let failed = |tool: &Symbol| self.faults.contains(&Some(Fault::Broken { tool: tool.clone() }));
        if let Some(tool) = newly_broken.filter(|tool| !failed(tool)) {
            room.mend_tool(tool.as_str());
        }
        for (step, call) in (1..).zip(plan.steps.iter().map(|step| &step.call)) {
            if let Some(fault) = room.fault(call) {
                let reason = fault.to_string();
                return Confirmation::Reject { step, objection: Some(objection(call, fault)), reason };
            }
            // What would change nothing has a fault.
            let _ = room.act(call);
        }
        Confirmation::Approve
    }
}

/// A fault as a person says it.
fn objection(call: &GroundCall, fault: Fault) -> Objection {
    let things = || call.args.iter().skip(1).cloned().collect();
    match fault {
        Fault::Broken { tool } => Objection::Broken { objects: vec![tool] },
        Fault::Interlock(interlock) => Objection::While { atom: GroundAtom::new("notEmpty", vec![interlock.loaded]) },
        Fault::Exception(_) | Fault::Rule { of_types: true, .. } => Objection::WrongKind { objects: things() },
        Fault::Rule { .. } => Objection::NotNow,
    }
}
