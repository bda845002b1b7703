//! Further plans: each does without a call of every plan given before.
//!
//! A plan that only adds steps to one that was given, or takes its steps in another order, is no other plan, and neither is
//! one with a step that it does as well without. So other plans are those of the same task without a call of a known plan,
//! for each of its calls; and of what is found there, without another call in turn. This is the partition of Murty (1968) and
//! Lawler (1972), without their required parts. Whatever plan there is, it either makes all calls of one that is given, or
//! is found in the end: where it does without a call of the plan of a branch, it is a plan of a branch below.
//!
//! A branch that has no plan may take for ever to say so. So branches are searched in rounds, with twice the expansions each
//! time. Some effort goes into more than one branch before the cheapest plan found is given. Each branch is grounded anew,
//! one at a time; a limit of expansions does not count that, and a branch that is stopped while it is grounded begins again.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use typelift_model::{Budget, GroundCall, Plan, Stop};

use crate::report::Report;
use crate::search::{Found, Search};
use crate::widening::{Asked, Widening};

/// The expansions of a branch in the first round, at least.
const FIRST_ROUND: u64 = 1_000;

/// The expansions and ground actions, at least, that go into branches before a plan is given.
const EFFORT: u64 = 10_000;

/// What a branch does without.
type LeftOut = BTreeSet<GroundCall>;

/// The branches of a task of which a plan is known.
#[derive(Debug)]
pub(crate) struct Alternatives {
    /// Branches of this round.
    open: VecDeque<LeftOut>,
    /// The branch that is being searched, if the search was stopped.
    current: Option<(LeftOut, Widening)>,
    /// Branches of the next round.
    later: VecDeque<LeftOut>,
    /// All that there were.
    known: BTreeSet<LeftOut>,
    /// Plans that were not given yet, by cost and number, with their branches.
    found: BTreeMap<(u64, u64), (Plan, LeftOut)>,
    number: u64,
    /// The expansions that a branch has in this round.
    round: u64,
    /// The effort that goes into branches before a plan is given, and what went into them since the last one.
    effort: u64,
    spent: u64,
    report: Report,
}

impl Alternatives {
    /// The branches of a plan that was found by a search that counted this.
    pub(crate) fn to(plan: &Plan, first: Report) -> Self {
        let mut this = Self {
            open: VecDeque::new(),
            current: None,
            later: VecDeque::new(),
            known: BTreeSet::new(),
            found: BTreeMap::new(),
            number: 0,
            round: FIRST_ROUND.max(first.expansions),
            effort: EFFORT.max(effort(first)),
            spent: 0,
            report: Report::default(),
        };
        this.branch(plan, &LeftOut::new());
        this
    }

    /// The next plan that `is_new` takes. The budget's expansions are for this call.
    pub(crate) fn next(&mut self, asked: Asked<'_>, is_new: impl Fn(&Plan) -> bool, budget: &Budget) -> Found {
        let mut budget = budget.clone();
        loop {
            if let Some((plan, left_out)) = self.take_found(asked.options.strategy.is_optimal()) {
                self.branch(&plan, &left_out);
                if is_new(&plan) {
                    self.spent = 0;
                    return Found::Plan(plan);
                }
                continue;
            }
            if self.current.is_none() {
                match self.begin(asked, &budget) {
                    Ok(true) => {}
                    Ok(false) => return Found::Nothing,
                    Err(stop) => return Found::Stopped(stop),
                }
            }
            if let Err(stop) = self.search_on(&mut budget) {
                return Found::Stopped(stop);
            }
        }
    }

    /// The cheapest plan that was found, if it is time to give one.
    fn take_found(&mut self, all_first: bool) -> Option<(Plan, LeftOut)> {
        let are_over = self.current.is_none() && self.open.is_empty() && self.later.is_empty();
        let is_time = are_over || (!all_first && self.current.is_none() && self.spent >= self.effort);
        if is_time { self.found.pop_first().map(|(_, found)| found) } else { None }
    }

    /// Begins to search the next branch, if there is one.
    fn begin(&mut self, asked: Asked<'_>, budget: &Budget) -> Result<bool, Stop> {
        if self.open.is_empty() && !self.later.is_empty() {
            std::mem::swap(&mut self.open, &mut self.later);
            self.round = self.round.saturating_mul(2);
        }
        let Some(left_out) = self.open.front() else { return Ok(false) };
        let mut restrictions = asked.restrictions.clone();
        restrictions.calls.extend(left_out.iter().cloned());
        let search = Widening::new(None, asked.model, asked.task, &restrictions, asked.options, budget)?;
        self.current = self.open.pop_front().map(|left_out| (left_out, search));
        Ok(true)
    }

    /// Searches the branch that was begun, as long as this round and the budget allow.
    fn search_on(&mut self, budget: &mut Budget) -> Result<(), Stop> {
        let Some((left_out, mut search)) = self.current.take() else { return Ok(()) };
        let before = search.report().expansions;
        let left = self.round.saturating_sub(before);
        let allowed = budget.expansions.map_or(left, |allowed| allowed.min(left));
        let found = search.next(None, &Budget { expansions: Some(allowed), ..budget.clone() });
        let counted = search.report();
        let spent = counted.expansions - before;
        budget.expansions = budget.expansions.map(|allowed| allowed.saturating_sub(spent));
        match found {
            Found::Plan(plan) => {
                self.found.insert((plan.cost(), self.number), (plan, left_out));
                self.number += 1;
            }
            Found::Nothing => {}
            Found::Stopped(Stop::Expansions) if spent >= left => self.later.push_back(left_out),
            Found::Stopped(stop) => {
                self.current = Some((left_out, search));
                return Err(stop);
            }
        }
        self.report += counted;
        self.spent += effort(counted);
        Ok(())
    }

    /// What all branches have counted.
    pub(crate) fn report(&self) -> Report {
        self.report + self.current.as_ref().map(|(_, search)| search.report()).unwrap_or_default()
    }

    /// Opens the branches of a plan: for each of its calls, one that does without it as well.
    fn branch(&mut self, plan: &Plan, left_out: &LeftOut) {
        for step in &plan.steps {
            let mut more = left_out.clone();
            more.insert(step.call.clone());
            if self.known.insert(more.clone()) {
                self.open.push_back(more);
            }
        }
    }
}

/// What a search cost.
fn effort(report: Report) -> u64 {
    report.expansions + report.ground_actions
}
