//! Whether an object was out of order where something failed: a cause that is known in its instance of the world only, and that
//! passes.

use typelift_model::Symbol;

use crate::CHANCE;
use crate::deed::Tried;

/// The odds that an object is out of order; one that the goal speaks of; how much less where it worked before or since.
const BROKEN: f64 = 0.1;
const BROKEN_IN_GOAL: f64 = 0.03;
const WORKED_BESIDES: f64 = 0.3;
/// How much more it is suspected for each time that another action of the same call failed with it.
const FAILED_BESIDES: f64 = 4.0;
/// After so many tasks an object is suspected half as much: things are mended.
const HALF_LIFE: f64 = 5.0;

/// How an object is suspected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OutOfOrder {
    /// The logarithmic odds that it was out of order then: rarely, and more rarely where it had worked before in a call of
    /// this name, or has since.
    pub(crate) then: f64,
    /// By how much these change until now: things are mended, and what has worked since is in order.
    pub(crate) since: f64,
}

/// How an object of a failure is suspected.
pub(crate) fn out_of_order(failure: &Tried<'_>, object: &Symbol, all: &[Tried<'_>]) -> OutOfOrder {
    let prior = if failure.in_goal.contains(object) { BROKEN_IN_GOAL } else { BROKEN };
    let place = |tried: &Tried<'_>| {
        let mut participants = tried.deed.participants.iter();
        participants.find(|participant| participant.object == *object).map(|participant| participant.place)
    };
    let same_call = || {
        all.iter().filter(|tried| {
            let same = tried.deed.instance == failure.deed.instance && tried.deed.call == failure.deed.call;
            same && place(tried).is_some_and(|at| Some(at) == place(failure))
        })
    };
    let other = |tried: &&Tried<'_>| {
        let as_many = tried.deed.participants.len() == failure.deed.participants.len();
        !(tried.worked || as_many && tried.deed.adds == failure.deed.adds)
    };
    let failed_besides = same_call().filter(other).count() as f64;
    let last = same_call().filter(|tried| tried.worked).map(|tried| tried.when).max();
    let has_worked_since = last.is_some_and(|when| when > failure.when);
    OutOfOrder {
        then: prior.ln()
            + failed_besides * FAILED_BESIDES.ln()
            + if last.is_some() { WORKED_BESIDES.ln() } else { 0.0 },
        since: if has_worked_since { CHANCE.ln() } else { 0.0 }
            - failure.tasks_ago as f64 / HALF_LIFE * std::f64::consts::LN_2,
    }
}
