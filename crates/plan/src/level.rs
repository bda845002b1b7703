//! One level of planning: a task with some or all of its objects, grounded once and searched on demand.

use std::sync::{Arc, OnceLock};

use typelift_model::{ActionModel, Budget, GroundAtom, HashSet, Stop, Task};

use crate::Restrictions;
use crate::conflict::{Conflict, conflict};
use crate::explain::{undeleted, unreachable};
use crate::explanation::Explanation;
use crate::fact::FactId;
use crate::fdr::Fdr;
use crate::ground::GroundTask;
use crate::landmark::exclusive_goals;
use crate::options::Options;
use crate::poll::Poll;
use crate::reach::Reachable;
use crate::report::Report;
use crate::search::{Found, Search, Space};
use crate::stages::Stages;
use crate::symmetry::Symmetry;

/// A grounded task and its search.
#[derive(Debug)]
pub(crate) struct Level {
    ground: Arc<GroundTask>,
    /// Two goals that cannot hold together.
    exclusive: Option<(GroundAtom, GroundAtom)>,
    /// What must not hold in the end, but is never deleted.
    never_deleted: Vec<GroundAtom>,
    /// Two goals that undo each other; looked for where the search finds nothing.
    conflict: OnceLock<Option<Conflict>>,
    /// `None` if there is nothing to search: a goal is unreachable, two exclude each other, or something is never deleted.
    stages: Option<Stages>,
}

impl Level {
    /// Grounds the task from what can be reached of it, and finds its landmarks.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends it.
    pub(crate) fn new(
        model: &ActionModel,
        task: &Task,
        restrictions: &Restrictions,
        options: &Options,
        reachable: Reachable,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        let ground = Arc::new(GroundTask::of(reachable, model, task, options.tie_order, budget)?);
        let exclusive = exclusive_goals(&ground, budget)?.map(|(a, b)| (ground.atom(a), ground.atom(b)));
        let never_deleted = never_deleted(&ground, budget)?;
        let mut this = Self { ground, exclusive, never_deleted, conflict: OnceLock::new(), stages: None };
        if !this.ground.unreachable_goals().is_empty() || this.exclusive.is_some() || !this.never_deleted.is_empty() {
            return Ok(this);
        }
        let fdr = Fdr::new(&this.ground, budget)?;
        if let Some((a, b)) = fdr.mutexes.excluded_pair(this.ground.goal()) {
            this.exclusive = Some((this.ground.atom(a), this.ground.atom(b)));
            return Ok(this);
        }
        // Restrictions tell objects apart that the task does not.
        let symmetry = if *restrictions == Restrictions::default() {
            Symmetry::of(model, task, &this.ground, &fdr)
        } else {
            Symmetry::default()
        };
        let space = Arc::new(Space::new(Arc::clone(&this.ground), fdr, symmetry));
        this.stages = Some(Stages::new(space, options.strategy, budget)?);
        Ok(this)
    }

    /// Whether there is something to search.
    pub(crate) fn is_open(&self) -> bool {
        self.stages.is_some()
    }

    /// Drops the search. Only what the grounding counted stays.
    pub(crate) fn close(&mut self) {
        self.stages = None;
    }

    /// Two goals that undo each other, if that is known. It is worked out once.
    pub(crate) fn conflict(&self) -> Option<&Conflict> {
        let stages = self.stages.as_ref()?;
        self.conflict.get_or_init(|| conflict(&self.ground, &stages.space().task.mutexes)).as_ref()
    }

    /// The grounded task.
    pub(crate) fn ground(&self) -> &GroundTask {
        &self.ground
    }

    /// Why there is no plan. Model, task and restrictions are those that the level was made from.
    pub(crate) fn explain(&self, model: &ActionModel, task: &Task, restrictions: &Restrictions) -> Explanation {
        if self.is_open() {
            return Explanation::NotTogether { missing: self.missing(), conflict: self.conflict().cloned() };
        }
        if !self.ground.unreachable_goals().is_empty() {
            let reachable = self.ground.reachable();
            return Explanation::Unreachable(unreachable(model, task, restrictions, reachable));
        }
        match &self.exclusive {
            Some((one, other)) => Explanation::Exclusive { one: one.clone(), other: other.clone() },
            None => {
                let (reachable, atoms) = (self.ground.reachable(), &self.never_deleted);
                Explanation::NeverDeleted(undeleted(model, task, restrictions, reachable, atoms))
            }
        }
    }
}

impl Search for Level {
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found {
        self.stages.as_mut().map_or(Found::Nothing, |stages| stages.next(cost_bound, budget))
    }

    fn report(&self) -> Report {
        let counted = self.stages.as_ref().map(Stages::report).unwrap_or_default();
        let (ground_actions, facts) = (self.ground.op_count() as u64, self.ground.fact_count() as u64);
        counted + Report { ground_actions, facts, ..Report::default() }
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        self.stages.as_ref().map(Stages::missing).unwrap_or_default()
    }
}

/// What must not hold in the end, but holds initially and is neither deleted by any action nor derived.
fn never_deleted(task: &GroundTask, budget: &Budget) -> Result<Vec<GroundAtom>, Stop> {
    if task.negative_goal().is_empty() {
        return Ok(Vec::new());
    }
    let initially: HashSet<FactId> = task.init().iter().copied().collect();
    let mut left: HashSet<FactId> = task.negative_goal().iter().copied().collect();
    left.retain(|fact| initially.contains(fact) && !task.derives(*fact));
    let mut poll = Poll::new(budget);
    for (_, op) in task.ops() {
        poll.check(1 + op.deletes.len() + op.conditional.len())?;
        let conditional = op.conditional.iter().filter(|effect| !effect.adds).map(|effect| &effect.fact);
        for fact in op.deletes.iter().chain(conditional) {
            left.remove(fact);
        }
    }
    let kept = task.negative_goal().iter().filter(|fact| left.contains(fact));
    Ok(kept.map(|&fact| task.atom(fact)).collect())
}
