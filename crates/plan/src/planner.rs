//! From a model and a task to plans.

use typelift_model::{ActionModel, Budget, GroundAtom, Task};

use crate::Restrictions;
use crate::explain::{Explanation, unreachable};
use crate::fact::FactId;
use crate::ground::{GroundTask, TieOrder, ground};
use crate::heuristic::OrderedLandmarks;
use crate::landmark::{exclusive_goals, landmark_sequences};
use crate::poll::Poll;
use crate::reach::Cut;
use crate::search::{Outcome, Report, Search};
use crate::successor::holds;

/// How plans are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// In which order successors are tried.
    pub tie_order: TieOrder,
    /// How many plans will be asked for: so many different ways to each node are kept. 1 is the plain search.
    pub plans: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { tie_order: TieOrder::SpecificFirst, plans: 1 }
    }
}

/// A task being planned: grounded once, searched on demand.
#[derive(Debug)]
pub struct Planner {
    model: ActionModel,
    task: Task,
    restrictions: Restrictions,
    ground: GroundTask,
    /// Two goals that cannot hold together.
    exclusive: Option<(GroundAtom, GroundAtom)>,
    /// What must not hold in the end, but does for ever.
    lasting: Vec<GroundAtom>,
    /// `None` if a goal is unreachable, two exclude each other, or something lasts: there is nothing to search.
    search: Option<Search>,
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
        let exclusive = exclusive_goals(&ground, budget)?.map(|(a, b)| (ground.atom(a), ground.atom(b)));
        let lasting = lasting(&ground, budget)?;
        let search = if ground.unreachable_goals().is_empty() && exclusive.is_none() && lasting.is_empty() {
            let heuristic = OrderedLandmarks::new(landmark_sequences(&ground, budget)?);
            Some(Search::new(&ground, Box::new(heuristic), options.plans))
        } else {
            None
        };
        let (model, task, restrictions) = (model.clone(), task.clone(), restrictions.clone());
        Ok(Self { model, task, restrictions, ground, exclusive, lasting, search })
    }

    /// The next plan: one whose multiset of actions was not found before. The budget's expansions are for this call.
    pub fn next_plan(&mut self, budget: &Budget) -> Outcome {
        match &mut self.search {
            None => Outcome::Unsolvable,
            Some(search) => search.next(&self.ground, budget),
        }
    }

    /// A plan cheaper than `cost`, from where the search stands; everything dearer is pruned from now on.
    pub fn better_plan(&mut self, cost: u64, budget: &Budget) -> Outcome {
        if let Some(search) = &mut self.search {
            search.cost_bound = Some(cost);
        }
        self.next_plan(budget)
    }

    /// What was counted so far.
    pub fn report(&self) -> Report {
        self.search.as_ref().map_or_else(
            || Report {
                ground_actions: self.ground.op_count() as u64,
                facts: self.ground.fact_count() as u64,
                ..Report::default()
            },
            |search| search.report,
        )
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
        let Some(search) = &self.search else {
            if self.ground.unreachable_goals().is_empty() {
                if let Some((one, other)) = &self.exclusive {
                    return Explanation::Exclusive { one: one.clone(), other: other.clone() };
                }
                return Explanation::Lasting(self.lasting.clone());
            }
            return Explanation::Unreachable(unreachable(&self.model, &self.task, &self.restrictions, &self.ground));
        };
        let missing = |state: &[u64]| {
            let wanted = self.ground.goal().iter().map(|&fact| (fact, true));
            let unwanted = self.ground.negative_goal().iter().map(|&fact| (fact, false));
            let open = wanted.chain(unwanted).filter(|&(fact, positive)| holds(state, fact) != positive);
            open.map(|(fact, positive)| (self.ground.atom(fact), positive)).collect()
        };
        Explanation::NotTogether { missing: search.closest_state().map(missing).unwrap_or_default() }
    }
}

/// What must not hold in the end, but holds initially and is neither deleted by any action nor derived.
fn lasting(task: &GroundTask, budget: &Budget) -> Result<Vec<GroundAtom>, Cut> {
    let initially = task.negative_goal().iter().filter(|fact| task.init().contains(fact));
    let mut lasting: Vec<FactId> = initially.copied().filter(|&fact| !task.axioms().derives(fact)).collect();
    let mut poll = Poll::new(budget);
    for (_, op) in task.ops() {
        poll.check(1 + lasting.len())?;
        let is_deleted = |fact: &FactId| {
            op.deletes.binary_search(fact).is_ok() || op.conditional.iter().any(|e| !e.adds && e.fact == *fact)
        };
        lasting.retain(|fact| !is_deleted(fact));
    }
    Ok(lasting.into_iter().map(|fact| task.atom(fact)).collect())
}
