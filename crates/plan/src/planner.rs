//! From a model and a task to plans.

use typelift_model::{ActionModel, Budget, GroundAtom, HashSet, Plan, Task};

use crate::Restrictions;
use crate::explain::{Explanation, unreachable};
use crate::fact::FactId;
use crate::fdr::{ActionIndex, Fdr, SuccessorGenerator};
use crate::ground::{GroundTask, TieOrder, ground};
use crate::landmark::exclusive_goals;
use crate::poll::Poll;
use crate::reach::Cut;
use crate::search::{Found, Outcome, Report, Search, Space};
use crate::strategy::{Stage, Strategy};
use crate::symmetry::Symmetry;

/// How plans are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// How states are searched.
    pub strategy: Strategy,
    /// In which order successors are tried.
    pub tie_order: TieOrder,
    /// How many plans will be asked for: so many different ways to each node are kept. 1 is the plain search.
    pub plans: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { strategy: Strategy::default(), tie_order: TieOrder::SpecificFirst, plans: 1 }
    }
}

/// A task being planned: grounded once, searched on demand.
#[derive(Debug)]
pub struct Planner {
    model: ActionModel,
    task: Task,
    restrictions: Restrictions,
    options: Options,
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

impl Planner {
    /// Grounds the task and finds its landmarks.
    ///
    /// The model is taken as it is: whoever wants strict applicability or imagined actions rewrites it before.
    ///
    /// # Errors
    /// [`Cut`] if the budget ends grounding, or the work on landmarks.
    pub fn new(
        model: &ActionModel,
        task: &Task,
        restrictions: &Restrictions,
        options: &Options,
        budget: &Budget,
    ) -> Result<Self, Cut> {
        let ground = ground(model, task, restrictions, options.tie_order, budget)?;
        let exclusive = exclusive_goals(&ground, budget)?;
        let lasting = lasting(&ground, budget)?;
        let mut this = Self {
            model: model.clone(),
            task: task.clone(),
            restrictions: restrictions.clone(),
            options: *options,
            exclusive: exclusive.map(|(a, b)| (ground.atom(a), ground.atom(b))),
            lasting,
            ground,
            running: None,
        };
        if !this.ground.unreachable_goals().is_empty() || this.exclusive.is_some() || !this.lasting.is_empty() {
            return Ok(this);
        }
        let task = Fdr::new(&this.ground, budget)?;
        if let Some((a, b)) = task.mutexes.excluded_pair(this.ground.goal()) {
            this.exclusive = Some((this.ground.atom(a), this.ground.atom(b)));
            return Ok(this);
        }
        // What may not be used tells objects apart.
        let symmetry = if *restrictions == Restrictions::default() {
            Symmetry::of(model, &this.task, &this.ground, &task)
        } else {
            Symmetry::default()
        };
        let space = Space { successors: SuccessorGenerator::new(&task), symmetry, task, bytes: this.ground.bytes() };
        let (strategy, stage) = (options.strategy, Stage::First);
        let search = strategy.search(stage, &this.ground, &space, options.plans, budget)?;
        let past = Report::default();
        this.running = Some(Running { space, strategy, stage, search, found: HashSet::default(), past });
        Ok(this)
    }

    /// The next plan: one whose multiset of actions was not found before. The budget's expansions are for this call.
    pub fn next_plan(&mut self, budget: &Budget) -> Outcome {
        let Some(running) = &mut self.running else { return Outcome::Unsolvable };
        if !running.strategy.has_one_search() && !running.found.is_empty() {
            // A greedy search closes each state after its first way there; others are found by another search.
            let turned =
                running.turn_to(Strategy::OrderedLandmarks, Stage::First, &self.ground, self.options.plans, budget);
            if let Err(cut) = turned {
                return cut.into();
            }
        }
        running.next(&self.ground, None, budget)
    }

    /// A plan cheaper than `cost`, from where the search stands; everything dearer is pruned from now on.
    pub fn better_plan(&mut self, cost: u64, budget: &Budget) -> Outcome {
        let Some(running) = &mut self.running else { return Outcome::Unsolvable };
        if !running.strategy.has_one_search() && !running.found.is_empty() && running.stage == Stage::First {
            let (strategy, stage) = (running.strategy, running.stage.next());
            if let Err(cut) = running.turn_to(strategy, stage, &self.ground, self.options.plans, budget) {
                return cut.into();
            }
        }
        let outcome = running.next(&self.ground, Some(cost), budget);
        if matches!(outcome, Outcome::Solved(_)) && !running.strategy.has_one_search() {
            let (strategy, stage) = (running.strategy, running.stage.next());
            // Without the time for the next stage this one goes on.
            let _ = running.turn_to(strategy, stage, &self.ground, self.options.plans, budget);
        }
        outcome
    }

    /// What was counted so far.
    pub fn report(&self) -> Report {
        let counted = self.running.as_ref().map(Running::report).unwrap_or_default();
        Report { ground_actions: self.ground.op_count() as u64, facts: self.ground.fact_count() as u64, ..counted }
    }

    /// The grounded task.
    pub fn ground_task(&self) -> &GroundTask {
        &self.ground
    }

    /// The task as it was asked.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// Why no plan was found.
    pub fn explain(&self) -> Explanation {
        let Some(running) = &self.running else {
            if self.ground.unreachable_goals().is_empty() {
                if let Some((one, other)) = &self.exclusive {
                    return Explanation::Exclusive { one: one.clone(), other: other.clone() };
                }
                return Explanation::Lasting(self.lasting.clone());
            }
            return Explanation::Unreachable(unreachable(&self.model, &self.task, &self.restrictions, &self.ground));
        };
        let missing = |values: Vec<u32>| {
            let wanted = self.ground.goal().iter().map(|&fact| (fact, true));
            let unwanted = self.ground.negative_goal().iter().map(|&fact| (fact, false));
            let open = wanted.chain(unwanted).filter(|&(f, positive)| running.space.task.holds(&values, f) != positive);
            open.map(|(fact, positive)| (self.ground.atom(fact), positive)).collect()
        };
        Explanation::NotTogether { missing: running.search.closest().map(missing).unwrap_or_default() }
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
    ) -> Result<(), Cut> {
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
                Found::Cut(outcome) => return outcome,
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

impl From<Cut> for Outcome {
    fn from(cut: Cut) -> Self {
        match cut {
            Cut::OutOfMemory => Self::OutOfMemory,
            Cut::Stopped(stop) => stop.into(),
        }
    }
}

/// What must not hold in the end, but holds initially and is neither deleted by any action nor derived.
fn lasting(task: &GroundTask, budget: &Budget) -> Result<Vec<GroundAtom>, Cut> {
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
