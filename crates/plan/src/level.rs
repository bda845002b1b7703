//! One level of a planner: a task with some or all of its objects, grounded once and searched on demand.

use typelift_model::{ActionModel, Budget, GroundAtom, HashSet, Plan, Stop, Task};

use crate::Restrictions;
use crate::fact::FactId;
use crate::fdr::{ActionIndex, Fdr};
use crate::ground::GroundTask;
use crate::landmark::exclusive_goals;
use crate::outcome::Outcome;
use crate::planner::Options;
use crate::poll::Poll;
use crate::reach::Reachable;
use crate::search::{Found, Report, Search, Space};
use crate::strategy::{Stage, Strategy};
use crate::symmetry::Symmetry;

/// A grounded task and its search.
#[derive(Debug)]
pub(crate) struct Level {
    plans: usize,
    ground: GroundTask,
    /// Two goals that cannot hold together.
    exclusive: Option<(GroundAtom, GroundAtom)>,
    /// What must not hold in the end, but does for ever.
    lasting: Vec<GroundAtom>,
    /// `None` if a goal is unreachable, two exclude each other, or something lasts: there is nothing to search.
    running: Option<Running>,
}

/// A search, and what came before it.
#[derive(Debug)]
struct Running {
    space: Space,
    strategy: Strategy,
    stage: Stage,
    search: Box<dyn Search>,
    /// The plans found, as multisets of actions, sorted.
    found: HashSet<Vec<ActionIndex>>,
    /// What searches that are over have counted.
    past: Report,
}

impl Level {
    /// Grounds the task from what can be reached of it, and finds its landmarks.
    pub(crate) fn new(
        model: &ActionModel,
        task: &Task,
        restrictions: &Restrictions,
        options: &Options,
        reachable: Reachable,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        let ground = GroundTask::of(reachable, model, task, options.tie_order, budget)?;
        let exclusive = exclusive_goals(&ground, budget)?;
        let lasting = lasting(&ground, budget)?;
        let exclusive = exclusive.map(|(a, b)| (ground.atom(a), ground.atom(b)));
        let mut this = Self { plans: options.plans, exclusive, lasting, ground, running: None };
        if !this.ground.unreachable_goals().is_empty() || this.exclusive.is_some() || !this.lasting.is_empty() {
            return Ok(this);
        }
        let fdr = Fdr::new(&this.ground, budget)?;
        if let Some((a, b)) = fdr.mutexes.excluded_pair(this.ground.goal()) {
            this.exclusive = Some((this.ground.atom(a), this.ground.atom(b)));
            return Ok(this);
        }
        // What may not be used tells objects apart.
        let symmetry = if *restrictions == Restrictions::default() {
            Symmetry::of(model, task, &this.ground, &fdr)
        } else {
            Symmetry::default()
        };
        let space = Space::new(fdr, symmetry);
        let (strategy, stage) = (options.strategy, Stage::First);
        let search = strategy.search(stage, &this.ground, &space, options.plans, budget)?;
        let past = Report::default();
        this.running = Some(Running { space, strategy, stage, search, found: HashSet::default(), past });
        Ok(this)
    }

    /// Whether there is something to search.
    pub(crate) fn is_open(&self) -> bool {
        self.running.is_some()
    }

    /// Forgets the search, of which only the counts are left, and nothing can be asked any more.
    pub(crate) fn close(&mut self) {
        self.running = None;
    }

    /// The next plan, or, with a bound, one that is cheaper.
    pub(crate) fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Outcome {
        match cost_bound {
            None => self.next_plan(budget),
            Some(cost) => self.better_plan(cost, budget),
        }
    }

    fn next_plan(&mut self, budget: &Budget) -> Outcome {
        let Some(running) = &mut self.running else { return Outcome::Unsolvable };
        if !running.strategy.has_one_search() && !running.found.is_empty() {
            // A greedy search closes each state after its first way there; others are found by another search.
            let turned = running.turn_to(Strategy::OrderedLandmarks, Stage::First, &self.ground, self.plans, budget);
            if let Err(stop) = turned {
                return stop.into();
            }
        }
        running.next(&self.ground, None, budget)
    }

    fn better_plan(&mut self, cost: u64, budget: &Budget) -> Outcome {
        let Some(running) = &mut self.running else { return Outcome::Unsolvable };
        if !running.strategy.has_one_search() && !running.found.is_empty() && running.stage == Stage::First {
            let (strategy, stage) = (running.strategy, running.stage.next());
            if let Err(stop) = running.turn_to(strategy, stage, &self.ground, self.plans, budget) {
                return stop.into();
            }
        }
        let outcome = running.next(&self.ground, Some(cost), budget);
        if matches!(outcome, Outcome::Solved(_)) && !running.strategy.has_one_search() {
            let (strategy, stage) = (running.strategy, running.stage.next());
            // Without the time for the next stage this one goes on.
            let _ = running.turn_to(strategy, stage, &self.ground, self.plans, budget);
        }
        outcome
    }

    /// What was counted so far.
    pub(crate) fn report(&self) -> Report {
        let counted = self.running.as_ref().map(Running::report).unwrap_or_default();
        let (ground_actions, facts) = (self.ground.op_count() as u64, self.ground.fact_count() as u64);
        Report { ground_actions, facts, ..counted }
    }

    /// The grounded task.
    pub(crate) fn ground(&self) -> &GroundTask {
        &self.ground
    }

    /// Two goals that cannot hold together.
    pub(crate) fn exclusive(&self) -> Option<&(GroundAtom, GroundAtom)> {
        self.exclusive.as_ref()
    }

    /// What must not hold in the end, but does for ever.
    pub(crate) fn lasting(&self) -> &[GroundAtom] {
        &self.lasting
    }

    /// What was missing where the search came closest to the goal, and whether each must hold.
    pub(crate) fn missing(&self) -> Vec<(GroundAtom, bool)> {
        let Some(running) = &self.running else { return Vec::new() };
        let missing = |values: Vec<u32>| {
            let wanted = self.ground.goal().iter().map(|&fact| (fact, true));
            let unwanted = self.ground.negative_goal().iter().map(|&fact| (fact, false));
            let open = wanted.chain(unwanted).filter(|&(f, positive)| running.space.task.holds(&values, f) != positive);
            open.map(|(fact, positive)| (self.ground.atom(fact), positive)).collect()
        };
        running.search.closest().map(missing).unwrap_or_default()
    }
}

impl Running {
    fn turn_to(
        &mut self,
        strategy: Strategy,
        stage: Stage,
        ground: &GroundTask,
        plans: usize,
        budget: &Budget,
    ) -> Result<(), Stop> {
        if (strategy, stage) == (self.strategy, self.stage) {
            return Ok(());
        }
        let search = strategy.search(stage, ground, &self.space, plans, budget)?;
        self.past = self.report();
        (self.strategy, self.stage, self.search) = (strategy, stage, search);
        Ok(())
    }

    fn next(&mut self, ground: &GroundTask, cost_bound: Option<u64>, budget: &Budget) -> Outcome {
        loop {
            match self.search.next(&self.space, cost_bound, budget) {
                Found::Plan(actions) => {
                    let mut multiset = actions.clone();
                    multiset.sort_unstable();
                    if self.found.insert(multiset) {
                        let ids = &self.space.task.actions.ids;
                        let steps = actions.iter().map(|&action| ground.step(ids[action as usize])).collect();
                        return Outcome::Solved(Plan { steps });
                    }
                }
                Found::Nothing if self.found.is_empty() && cost_bound.is_none() => return Outcome::Unsolvable,
                Found::Nothing => return Outcome::NoMorePlans,
                Found::Stopped(stop) => return stop.into(),
            }
        }
    }

    fn report(&self) -> Report {
        let now = self.search.report();
        Report {
            expansions: self.past.expansions + now.expansions,
            evaluations: self.past.evaluations + now.evaluations,
            reopened: self.past.reopened + now.reopened,
            ..now
        }
    }
}

/// What must not hold in the end, but holds initially and is neither deleted by any action nor derived.
fn lasting(task: &GroundTask, budget: &Budget) -> Result<Vec<GroundAtom>, Stop> {
    if task.negative_goal().is_empty() {
        return Ok(Vec::new());
    }
    let initially: HashSet<FactId> = task.init().iter().copied().collect();
    let mut lasting: HashSet<FactId> = task.negative_goal().iter().copied().collect();
    lasting.retain(|fact| initially.contains(fact) && !task.derives(*fact));
    let mut poll = Poll::new(budget);
    for (_, op) in task.ops() {
        poll.check(1 + op.deletes.len() + op.conditional.len())?;
        let conditional = op.conditional.iter().filter(|effect| !effect.adds).map(|effect| &effect.fact);
        for fact in op.deletes.iter().chain(conditional) {
            lasting.remove(fact);
        }
    }
    let kept = task.negative_goal().iter().filter(|fact| lasting.contains(fact));
    Ok(kept.map(|&fact| task.atom(fact)).collect())
}
