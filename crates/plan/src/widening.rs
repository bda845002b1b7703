//! Searching with few objects first, then with more and more, in the end with all.

use typelift_model::{ActionModel, Budget, GroundAtom, Stop, Task};

use crate::Restrictions;
use crate::explanation::Explanation;
use crate::level::Level;
use crate::options::Options;
use crate::reach::Reachable;
use crate::report::Report;
use crate::scope::{EAGERLY, LAZILY, Scopes};
use crate::search::{Found, Search};
use crate::strategy::Strategy;

/// What is planned, and how.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asked<'a> {
    pub(crate) model: &'a ActionModel,
    pub(crate) task: &'a Task,
    pub(crate) restrictions: &'a Restrictions,
    pub(crate) options: &'a Options,
}

/// A task, searched level by level.
#[derive(Debug)]
pub(crate) struct Widening {
    model: ActionModel,
    task: Task,
    restrictions: Restrictions,
    options: Options,
    /// The objects planned with.
    scopes: Scopes,
    level: Level,
    /// The level is over, and the next not grounded yet.
    over: bool,
    /// How much this level had expanded when it found its last plan.
    expansions_before: u64,
    /// What finished levels have counted, and all groundings.
    past: Report,
}

impl Widening {
    /// Grounds the task with as few objects as reach its goals. `reachable`, of this model and these
    /// restrictions, saves computing it again, if it has the same objects as the level.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends it.
    pub(crate) fn new(
        mut reachable: Option<Reachable>,
        model: &ActionModel,
        task: &Task,
        restrictions: &Restrictions,
        options: &Options,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        let mut scopes = match options.strategy {
            strategy if strategy.is_optimal() => Scopes::whole(),
            Strategy::OrderedFirst | Strategy::OrderedLandmarks => Scopes::of(model, task, restrictions, EAGERLY),
            _ => Scopes::of(model, task, restrictions, LAZILY),
        };
        let groundings = reachable.as_ref().map_or(0, Reachable::computed);
        let mut past = Report { groundings, ..Report::default() };
        let level = loop {
            let task = scopes.restrict(task);
            let reachable = match reachable.take_if(|known| known.has_objects_of(&task)) {
                Some(known) => known,
                None => {
                    past.groundings += 1;
                    Reachable::of(model, &task, restrictions, budget)?
                }
            };
            let level = Level::new(model, &task, restrictions, options, reachable, budget)?;
            if scopes.is_whole() || level.is_open() {
                break level;
            }
            past += level.report();
            scopes.advance();
        };
        let (model, task, restrictions) = (model.clone(), task.clone(), restrictions.clone());
        let (over, expansions_before) = (false, 0);
        Ok(Self { model, task, restrictions, options: *options, scopes, level, over, expansions_before, past })
    }

    /// Grounds the task with more objects, until no goal is out of reach. If that is stopped, it is done the next time.
    fn widen(&mut self, budget: &Budget) -> Result<(), Stop> {
        if self.level.is_open() {
            self.past += self.level.report();
            self.level.close();
            self.scopes.advance();
        }
        loop {
            let task = self.scopes.restrict(&self.task);
            let reachable = Reachable::of(&self.model, &task, &self.restrictions, budget)?;
            self.past.groundings += 1;
            let level = Level::new(&self.model, &task, &self.restrictions, &self.options, reachable, budget)?;
            if self.scopes.is_whole() || level.is_open() {
                (self.level, self.over, self.expansions_before) = (level, false, 0);
                return Ok(());
            }
            self.past += level.report();
            self.scopes.advance();
        }
    }

    /// What is planned, and how.
    pub(crate) fn asked(&self) -> Asked<'_> {
        let Self { model, task, restrictions, options, .. } = self;
        Asked { model, task, restrictions, options }
    }

    /// The level that is searched now.
    pub(crate) fn level(&self) -> &Level {
        &self.level
    }

    /// The task with all its objects.
    pub(crate) fn task(&self) -> &Task {
        &self.task
    }

    /// Whether it is known, without all being searched, that there is no plan.
    pub(crate) fn is_in_vain(&self) -> bool {
        self.scopes.is_whole() && !self.over && self.level.conflict().is_some()
    }

    /// Why there is no plan.
    pub(crate) fn explain(&self) -> Explanation {
        if self.over {
            return Explanation::NotTogether { missing: self.missing(), conflict: None };
        }
        self.level.explain(&self.model, &self.task, &self.restrictions)
    }
}

impl Search for Widening {
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found {
        let mut budget = budget.clone();
        loop {
            if self.over
                && let Err(stop) = self.widen(&budget)
            {
                return Found::Stopped(stop);
            }
            let before = self.level.report().expansions;
            // A level without all objects is not searched to the end if that takes long.
            let allowed = self.scopes.expansions().map(|all| (all + self.expansions_before).saturating_sub(before));
            let expansions = budget.expansions.into_iter().chain(allowed).min();
            let found = self.level.next(cost_bound, &Budget { expansions, ..budget.clone() });
            let spent = self.level.report().expansions - before;
            budget.expansions = budget.expansions.map(|left| left.saturating_sub(spent));
            match found {
                Found::Plan(_) => {
                    self.expansions_before = before + spent;
                    return found;
                }
                found if self.scopes.is_whole() => return found,
                Found::Nothing => self.over = true,
                Found::Stopped(Stop::Expansions) if budget.expansions != Some(0) => self.over = true,
                found => return found,
            }
        }
    }

    fn report(&self) -> Report {
        if self.over && !self.level.is_open() { self.past } else { self.past + self.level.report() }
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        self.level.missing()
    }
}
