//! Goals that exclude each other.

use typelift_model::{Budget, HashSet, Stop};

use crate::fact::FactId;
use crate::ground::GroundTask;
use crate::op::Op;
use crate::poll::Poll;

/// Two goal facts that cannot hold together: one does not hold initially, and everything that achieves it deletes the
/// other, which nothing adds again; or each is deleted by everything that achieves the other, and neither holds initially.
///
/// # Errors
/// [`Stop`] if the budget ends it.
pub(crate) fn exclusive_goals(task: &GroundTask, budget: &Budget) -> Result<Option<(FactId, FactId)>, Stop> {
    let mut poll = Poll::new(budget);
    let goal = task.goal();
    let mut achievers: Vec<Vec<&Op>> = vec![Vec::new(); goal.len()];
    for (_, op) in task.ops_and_axioms() {
        poll.check(1 + op.adds.len() + op.conditional.len())?;
        let conditional = op.conditional.iter().filter(|effect| effect.adds).map(|effect| effect.fact);
        for fact in op.adds.iter().copied().chain(conditional) {
            if let Ok(place) = goal.binary_search(&fact) {
                achievers[place].push(op);
            }
        }
    }
    let initially: HashSet<FactId> = task.init().iter().copied().collect();
    let initial: Vec<bool> = goal.iter().map(|fact| initially.contains(fact)).collect();
    let destroys = |achieved: usize, other: usize| {
        achievers[achieved].iter().all(|op| op.deletes.binary_search(&goal[other]).is_ok())
    };
    let exclude = |a: usize, b: usize| {
        let gone_for_good = achievers[b].is_empty();
        a != b && !initial[a] && destroys(a, b) && (gone_for_good || !initial[b] && destroys(b, a))
    };
    for (a, b) in (0..goal.len()).flat_map(|a| (0..goal.len()).map(move |b| (a, b))) {
        poll.check(1 + achievers[a].len())?;
        if exclude(a, b) {
            return Ok(Some((goal[a], goal[b])));
        }
    }
    Ok(None)
}
