//! Somebody who knows what no state tells, but for what broke just now, and says no to a plan that would fail.

use typelift::agent::{CommandId, Input, Objection};
use typelift::model::{GroundAtom, GroundCall, Plan, Symbol};
use typelift_kitchen::{Fault, Room};

/// A step that would fail, counted from 1, what speaks against it, and why.
pub(super) struct No {
    step: usize,
    objection: Objection,
    reason: String,
}

impl No {
    /// Said to the proposal of this number.
    pub(super) fn to(self, id: CommandId) -> Input {
        Input::Reject { id, step: self.step, objection: Some(self.objection), reason: self.reason }
    }
}

/// What is said against a plan in a room, if it is not known that `unknown` is broken.
pub(super) fn objection(room: &Room, plan: &Plan, unknown: Option<&Symbol>) -> Option<No> {
    let mut room = room.clone();
    if let Some(tool) = unknown {
        room.mend_tool(tool.as_str());
    }
    (1..).zip(plan.steps.iter().map(|step| &step.call)).find_map(|(step, call)| match room.fault(call) {
        Some(fault) => Some(No { step, reason: fault.to_string(), objection: in_words_of_a_person(call, fault) }),
        None => {
            // What would change nothing has a fault.
            let _ = room.act(call);
            None
        }
    })
}

fn in_words_of_a_person(call: &GroundCall, fault: Fault) -> Objection {
    let things = || call.args.iter().skip(1).cloned().collect();
    match fault {
        Fault::Broken { tool } => Objection::Broken { objects: vec![tool] },
        Fault::Interlock(interlock) => Objection::While { atom: GroundAtom::new("notEmpty", vec![interlock.loaded]) },
        Fault::Exception(_) | Fault::Rule { of_types: true, .. } => Objection::WrongKind { objects: things() },
        Fault::Rule { .. } => Objection::NotNow,
    }
}
