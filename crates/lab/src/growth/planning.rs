//! Planning one task in a large kitchen, measured.

use std::sync::Arc;

use typelift::agent::{Options, ProposeError, propose};
use typelift::imagine;
use typelift::model::{ActionModel, Budget, MemoryLimit, MemoryProbe, Stop, Task};
use typelift::plan::{Outcome, Restrictions};

use super::measurement::{End, Measurement};
use super::processor_time::Stopwatch;

/// What is left to one measurement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowance {
    /// Seconds on a processor.
    pub seconds: f64,
    /// Bytes that planning may come to hold.
    pub bytes: u64,
}

/// What is measured several times is measured for at most so many seconds, and so often.
const REPEAT: (f64, usize) = (0.5, 5);

/// Plans the task as the agent would, with imagination. The shortest of a few times is kept, since whatever else the
/// machine does only makes it longer.
pub(crate) fn measure(model: &ActionModel, task: &Task, allowance: Allowance, memory: &MemoryProbe) -> Measurement {
    let begun = Stopwatch::start();
    let mut best = once(model, task, allowance, memory);
    for _ in 1..REPEAT.1 {
        if best.end != End::Finished || begun.seconds() > REPEAT.0 {
            break;
        }
        let next = once(model, task, allowance, memory);
        if next.seconds < best.seconds {
            best = next;
        }
    }
    best.peak_bytes = super::memory::peak_bytes();
    best
}

fn once(model: &ActionModel, task: &Task, allowance: Allowance, memory: &MemoryProbe) -> Measurement {
    let begun = Stopwatch::start();
    let stop = move || (begun.seconds() >= allowance.seconds).then_some(Stop::Time);
    let memory = MemoryLimit { bytes: allowance.bytes, probe: Arc::clone(memory) };
    let budget = Budget { expansions: None, memory: Some(memory), stop: Some(Arc::new(stop)) };
    let options = Options { imagine: Some(imagine::Options::default()), ..Options::default() };
    let proposal = propose(model, task, &Restrictions::default(), &options, &budget);
    let seconds = begun.seconds();
    let (end, report, steps) = match proposal {
        Ok(proposal) => {
            let (end, steps) = match &proposal.outcome {
                Outcome::Solved(plan) => (End::Finished, Some(plan.len())),
                Outcome::Stopped(stop) => (End::Stopped(*stop), None),
                _ => (End::NoPlan, None),
            };
            (end, Some(proposal.report()), steps)
        }
        Err(ProposeError::Stopped(stop)) => (End::Stopped(stop), None, None),
        Err(_) => (End::NoPlan, None, None),
    };
    Measurement {
        ground_actions: report.map(|r| r.ground_actions),
        expansions: report.map(|r| r.expansions),
        steps: steps.map(|steps| steps as u64),
        ..Measurement::new(end, seconds)
    }
}
