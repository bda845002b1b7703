//! From a model and a task to plans.

use typelift_model::{ActionModel, Budget, HashSet, Plan, Stop, Symbol, Task};

use crate::Restrictions;
use crate::explain::{Explanation, unreachable};
use crate::ground::{GroundTask, TieOrder};
use crate::level::Level;
use crate::outcome::Outcome;
use crate::reach::Reachable;
use crate::scope::{EAGERLY, LAZILY, Scopes};
use crate::search::Report;
use crate::strategy::Strategy;

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
///
/// A task with many objects is planned with those that can matter first, and with more and more of them while no plan
/// is found; a plan with fewer objects is a plan of the task. So it is with further plans and better ones: with all
/// objects they are looked for when with fewer there are no more, or none is found for long. That there is none, no other,
/// or no better one is only ever said of all objects. A strategy whose first plan is a cheapest one takes all at once.
#[derive(Debug)]
pub struct Planner {
    model: ActionModel,
    task: Task,
    restrictions: Restrictions,
    options: Options,
    /// The objects planned with.
    scopes: Scopes,
    level: Level,
    /// The level is over, and the next not grounded yet.
    over: bool,
    /// The expansions of this level when it had found its last plan.
    expansions_before: u64,
    /// What levels that are over have counted.
    past: Report,
    /// How often what can be reached was worked out.
    groundings: u64,
    /// The plans of levels with fewer objects, as multisets of actions, sorted.
    found: HashSet<Vec<(Symbol, Vec<Symbol>)>>,
}

impl Planner {
    /// Grounds the task and finds its landmarks.
    ///
    /// The model is taken as it is: whoever wants strict applicability or imagined actions rewrites it before.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends grounding, or the work on landmarks.
    pub fn new(
        model: &ActionModel,
        task: &Task,
        restrictions: &Restrictions,
        options: &Options,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        Self::starting_from(None, model, task, restrictions, options, budget)
    }

    /// The same from what can be reached of the task, with this model and these restrictions, and perhaps with few objects:
    /// where the task is planned with the same objects, it is not worked out again.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends grounding, or the work on landmarks.
    pub fn starting_from(
        reachable: Option<Reachable>,
        model: &ActionModel,
        task: &Task,
        restrictions: &Restrictions,
        options: &Options,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        let mut known = reachable;
        let mut groundings = known.as_ref().map_or(0, Reachable::computed);
        let mut scopes = match options.strategy {
            strategy if strategy.is_optimal() => Scopes::whole(),
            Strategy::OrderedLandmarks => Scopes::of(model, task, restrictions, EAGERLY),
            _ => Scopes::of(model, task, restrictions, LAZILY),
        };
        let mut past = Report::default();
        let level = loop {
            let task = scopes.restrict(task);
            let reachable = match known.take_if(|known| known.has_objects_of(&task)) {
                Some(known) => known,
                None => {
                    groundings += 1;
                    Reachable::of(model, &task, restrictions, budget)?
                }
            };
            let level = Level::new(model, &task, restrictions, options, reachable, budget)?;
            if scopes.is_whole() || level.is_open() {
                break level;
            }
            past = past.and(level.report());
            scopes.advance();
        };
        Ok(Self {
            model: model.clone(),
            task: task.clone(),
            restrictions: restrictions.clone(),
            options: *options,
            scopes,
            level,
            over: false,
            expansions_before: 0,
            past,
            groundings,
            found: HashSet::default(),
        })
    }

    /// The next plan: one whose multiset of actions was not found before. The budget's expansions are for this call.
    pub fn next_plan(&mut self, budget: &Budget) -> Outcome {
        self.next(None, budget)
    }

    /// A plan cheaper than `cost`, from where the search stands; everything dearer is pruned from now on.
    pub fn better_plan(&mut self, cost: u64, budget: &Budget) -> Outcome {
        self.next(Some(cost), budget)
    }

    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Outcome {
        let mut budget = budget.clone();
        loop {
            if self.over
                && let Err(stop) = self.grow(&budget)
            {
                return stop.into();
            }
            let before = self.level.report().expansions;
            // With fewer objects not everything is searched, however long it takes.
            let allowed = self.scopes.expansions().map(|all| (all + self.expansions_before).saturating_sub(before));
            let expansions = budget.expansions.into_iter().chain(allowed).min();
            let outcome = self.level.next(cost_bound, &Budget { expansions, ..budget.clone() });
            let spent = self.level.report().expansions - before;
            budget.expansions = budget.expansions.map(|left| left.saturating_sub(spent));
            match outcome {
                Outcome::Solved(plan) => {
                    self.expansions_before = before + spent;
                    if self.is_new(&plan) {
                        return Outcome::Solved(plan);
                    }
                }
                Outcome::Unsolvable if self.scopes.is_whole() && !self.found.is_empty() => return Outcome::NoMorePlans,
                outcome if self.scopes.is_whole() => return outcome,
                Outcome::Unsolvable | Outcome::NoMorePlans => self.over = true,
                Outcome::Stopped(Stop::Expansions) if budget.expansions != Some(0) => self.over = true,
                outcome => return outcome,
            }
        }
    }

    /// Grounds the task with more objects, until no goal is out of reach. If that is cut, it is done the next time.
    fn grow(&mut self, budget: &Budget) -> Result<(), Stop> {
        if self.level.is_open() {
            self.past = self.past.and(self.level.report());
            self.level.close();
            self.scopes.advance();
        }
        loop {
            let task = self.scopes.restrict(&self.task);
            let reachable = Reachable::of(&self.model, &task, &self.restrictions, budget)?;
            self.groundings += 1;
            let level = Level::new(&self.model, &task, &self.restrictions, &self.options, reachable, budget)?;
            if self.scopes.is_whole() || level.is_open() {
                (self.level, self.over, self.expansions_before) = (level, false, 0);
                return Ok(());
            }
            self.past = self.past.and(level.report());
            self.scopes.advance();
        }
    }

    /// Whether no level with fewer objects has found a plan; at such a level it has now.
    fn is_new(&mut self, plan: &Plan) -> bool {
        if self.scopes.is_whole() && self.found.is_empty() {
            return true;
        }
        let mut actions: Vec<_> = plan.steps.iter().map(|step| (step.action.clone(), step.objects.clone())).collect();
        actions.sort_unstable();
        if self.scopes.is_whole() { !self.found.contains(&actions) } else { self.found.insert(actions) }
    }

    /// What was counted so far, with fewer objects and with more.
    pub fn report(&self) -> Report {
        let counted = if self.over && !self.level.is_open() { self.past } else { self.past.and(self.level.report()) };
        Report { groundings: self.groundings, ..counted }
    }

    /// The grounded task: with as many objects as are planned with now.
    pub fn ground_task(&self) -> &GroundTask {
        self.level.ground()
    }

    /// The task as it was asked.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// Why no plan was found.
    pub fn explain(&self) -> Explanation {
        let ground = self.level.ground();
        if self.over || self.level.is_open() {
            return Explanation::NotTogether { missing: self.level.missing() };
        }
        if !ground.unreachable_goals().is_empty() {
            return Explanation::Unreachable(unreachable(
                &self.model,
                &self.task,
                &self.restrictions,
                ground.reachable(),
            ));
        }
        match self.level.exclusive() {
            Some((one, other)) => Explanation::Exclusive { one: one.clone(), other: other.clone() },
            None => Explanation::Lasting(self.level.lasting().to_vec()),
        }
    }
}

impl Report {
    /// This, and what was counted after it.
    fn and(self, later: Self) -> Self {
        Self {
            groundings: self.groundings + later.groundings,
            ground_actions: self.ground_actions + later.ground_actions,
            facts: self.facts + later.facts,
            expansions: self.expansions + later.expansions,
            evaluations: self.evaluations + later.evaluations,
            reopened: self.reopened + later.reopened,
        }
    }
}
