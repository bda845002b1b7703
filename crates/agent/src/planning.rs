//! What an episode proposes: a plan from where it is, if need be by a last resort, or another one.

use std::borrow::Cow;
use std::sync::Arc;

use typelift_model::{ActionModel, Budget, Plan, State, Stop, Task};
use typelift_plan::{Outcome, Report};

use crate::account::Ending;
use crate::episode::{Episode, EpisodeError, Phase};
use crate::event::{Event, Observer, PlanningTerms, WhyNoOther};
use crate::execution::{Execution, Terms, steps};
use crate::loosening::{propose, propose_loosened};
use crate::options::Options;
use crate::outlook::{Outlooks, with_needs};
use crate::propose::{Proposal, ProposeError, attempt, loosened_and_widened};
use crate::resort::{CountedExclusions, Resort};
use crate::turn::Command;

/// The expansions of a search for a way to try elsewhere what failed: it is a last hope, and often there is no such way.
const ELSEWHERE: u64 = 500;

/// What planning came to, on which terms.
struct Planned {
    proposal: Proposal,
    terms: Terms,
    /// The last resort that it is due to.
    resort: Option<Resort>,
}

impl Episode {
    /// Plans from the current state.
    pub(crate) fn propose(&mut self, observer: &mut dyn Observer) -> Result<Command, EpisodeError> {
        if self.goal.holds_in(&self.state) {
            // It held from the start, or came about by a step that otherwise failed.
            return Ok(self.end(Ending::Solved, observer));
        }
        if self.account.proposals >= self.options.max_proposals {
            return Ok(self.end(Ending::ProposalLimit(self.options.max_proposals), observer));
        }
        self.reconsider();
        self.look_ahead();
        let Planned { mut proposal, terms, resort } = match self.plan_with_last_resorts(observer) {
            Ok(planned) => planned,
            Err(ProposeError::Stopped(stop)) => return Ok(self.end(Ending::Stopped(stop), observer)),
            Err(error) => return Err(error.into()),
        };
        // A plan that did not lead to the goal from this very state, though no step of it failed, is not begun again.
        let mut plans_given = 1;
        let was_in_vain = matches!(&proposal.outcome, Outcome::Solved(plan) if self.was_in_vain(plan));
        if was_in_vain {
            proposal.outcome = self.search_on(&mut proposal, &mut plans_given, observer)?;
        }
        if let Some(resort) = resort {
            self.note_resort(resort, &proposal.outcome, observer);
        }
        let ending = match &proposal.outcome {
            Outcome::Solved(plan) => {
                let plan = plan.clone();
                return Ok(self.offer(plan, proposal, terms, plans_given, observer));
            }
            Outcome::Unsolvable | Outcome::NoMorePlans | Outcome::Stopped(Stop::Expansions) if was_in_vain => {
                Ending::Circular
            }
            Outcome::Unsolvable | Outcome::NoMorePlans => {
                self.account.goal_type_mismatches = proposal.goal_type_mismatches();
                self.account.given_up = proposal.imagination.given_up.clone();
                let counted = self.account.resorts.counted();
                self.account.avoided = self.experience.avoided_because(&self.instance, &self.state, counted);
                Ending::NoPlan(proposal.explain())
            }
            Outcome::Stopped(stop) => Ending::Stopped(*stop),
        };
        Ok(self.end(ending, observer))
    }

    fn was_in_vain(&self, plan: &Plan) -> bool {
        self.in_vain.iter().any(|(state, tried)| *state == self.state && *tried == steps(plan))
    }

    fn offer(
        &mut self,
        plan: Plan,
        proposal: Proposal,
        terms: Terms,
        plans_given: usize,
        observer: &mut dyn Observer,
    ) -> Command {
        self.account.proposals += 1;
        observer.event(&Event::Proposed { proposal: self.account.proposals, plan: plan.clone() });
        self.execution = Some(Execution {
            plan,
            model: Arc::clone(&proposal.model),
            terms,
            made_for: self.state.clone(),
            plans_given,
            next_step: 0,
            taken: 0,
            retries: 0,
        });
        self.proposal = Some(proposal);
        self.command(Phase::AwaitingApproval)
    }

    /// The next plan of the same search. If none is found, or no more may be proposed, the proposed one stands, and the
    /// event says why.
    pub(crate) fn another_plan(&mut self, observer: &mut dyn Observer) -> Result<Command, EpisodeError> {
        let Some(execution) = &self.execution else { return Ok(self.standing()) };
        let (terms, mut plans_given) = (execution.terms.clone(), execution.plans_given);
        if self.account.proposals >= self.options.max_proposals {
            return Ok(self.no_other_plan(WhyNoOther::ProposalLimit, observer));
        }
        let mut proposal = match self.proposal.take() {
            Some(proposal) => proposal,
            None => match self.taken_up(&terms, plans_given, observer) {
                Ok(proposal) => proposal,
                Err(ProposeError::Stopped(stop)) => {
                    return Ok(self.no_other_plan(WhyNoOther::Stopped(stop), observer));
                }
                Err(error) => return Err(error.into()),
            },
        };
        let outcome = self.search_on(&mut proposal, &mut plans_given, observer)?;
        let why = match outcome {
            Outcome::Solved(plan) => return Ok(self.offer(plan, proposal, terms, plans_given, observer)),
            Outcome::Unsolvable | Outcome::NoMorePlans => WhyNoOther::NoMorePlans,
            Outcome::Stopped(stop) => WhyNoOther::Stopped(stop),
        };
        if let Some(execution) = &mut self.execution {
            execution.plans_given = plans_given;
        }
        self.proposal = Some(proposal);
        Ok(self.no_other_plan(why, observer))
    }

    fn no_other_plan(&self, why: WhyNoOther, observer: &mut dyn Observer) -> Command {
        observer.event(&Event::NoOtherPlan { proposal: self.account.proposals, why });
        self.standing()
    }

    /// The search that gave so many plans on these terms before the episode was saved, where it was then. What it spends
    /// on that was counted then.
    fn taken_up(
        &self,
        terms: &Terms,
        plans_given: usize,
        observer: &mut dyn Observer,
    ) -> Result<Proposal, ProposeError> {
        self.planning_started(PlanningTerms::AsBefore, observer);
        let planned = self.plan_on(terms).and_then(|mut proposal| {
            let mut outcome = proposal.outcome.clone();
            for _ in 1..plans_given {
                if !matches!(outcome, Outcome::Solved(_)) {
                    break;
                }
                outcome = proposal.next_plan(&self.budget)?;
            }
            match outcome {
                Outcome::Stopped(stop) => Err(ProposeError::Stopped(stop)),
                _ => Ok(proposal),
            }
        });
        let report = planned.as_ref().map(Proposal::report).unwrap_or_default();
        observer.event(&planning_ended(report, planned.as_ref().ok(), planned.is_ok()));
        planned
    }

    /// The next plan of a search that was not in vain here, told as planning. Whatever is given counts, but a search that
    /// was stopped gave nothing.
    fn search_on(
        &mut self,
        proposal: &mut Proposal,
        plans_given: &mut usize,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, ProposeError> {
        self.planning_started(PlanningTerms::AsBefore, observer);
        let before = proposal.report().expansions;
        let outcome = loop {
            let outcome = proposal.next_plan(&self.budget);
            let Ok(Outcome::Solved(plan)) = &outcome else { break outcome };
            *plans_given += 1;
            if !self.was_in_vain(plan) {
                break outcome;
            }
        };
        let report = proposal.report();
        let report = Report { expansions: report.expansions.saturating_sub(before), ..report };
        self.count(report);
        observer.event(&planning_ended(report, Some(proposal), matches!(outcome, Ok(Outcome::Solved(_)))));
        outcome
    }

    /// Plans. Where there is no plan, it tries the last resorts that there are, one after the other, until there is one or
    /// the budget ends it.
    fn plan_with_last_resorts(&mut self, observer: &mut dyn Observer) -> Result<Planned, ProposeError> {
        let counted = self.account.resorts.counted();
        let usual = self.terms(counted);
        let proposal = self.plan_aloud(&usual, PlanningTerms::Usual, observer)?;
        if has_answer(&proposal.outcome) {
            return Ok(Planned { proposal, terms: usual, resort: None });
        }
        let resorts: Vec<Resort> = self.account.resorts.iter().map(|last| last.resort).collect();
        let mut in_vain = vec![usual.clone()];
        for resort in resorts {
            let Some(terms) = self.terms_by(resort, counted, &usual) else { continue };
            if in_vain.contains(&terms) {
                continue;
            }
            let other = self.plan_aloud(&terms, PlanningTerms::WithResort(resort), observer)?;
            if has_answer(&other.outcome) {
                return Ok(Planned { proposal: other, terms, resort: Some(resort) });
            }
            self.account.resorts.tried(resort, None);
            in_vain.push(terms);
        }
        if proposal.outcome == Outcome::Unsolvable {
            let mut terms = usual.clone();
            // Who does without preconditions could do without what a failure asked for, and try the same again.
            terms.restrictions.banned.extend(self.experience.bans(&self.instance).into_iter().map(|(ban, _)| ban));
            if let Some(loosened) = self.plan_loosened(&terms, observer)? {
                terms.loosened.clone_from(&loosened.imagination.loosened);
                return Ok(Planned { proposal: loosened, terms, resort: None });
            }
        }
        Ok(Planned { proposal, terms: usual, resort: None })
    }

    /// A plan that does without preconditions, where the options allow that.
    fn plan_loosened(&mut self, terms: &Terms, observer: &mut dyn Observer) -> Result<Option<Proposal>, ProposeError> {
        if !self.options.loosens() {
            return Ok(None);
        }
        self.planning_started(PlanningTerms::Loosened, observer);
        let (task, options) = self.asked(terms, &self.state);
        let planned = propose_loosened(&self.model_on(terms), &task, &terms.restrictions, &options, &self.budget);
        let found = planned.as_ref().ok().and_then(Option::as_ref);
        let report = found.map(Proposal::report).unwrap_or_default();
        observer.event(&planning_ended(report, found, found.is_some()));
        self.count(report);
        planned
    }

    /// Notes what became of a resort, before the plan that it led to is offered. One that the budget ended led to none.
    fn note_resort(&mut self, resort: Resort, outcome: &Outcome, observer: &mut dyn Observer) {
        let led_to_a_plan = matches!(outcome, Outcome::Solved(_));
        self.account.resorts.tried(resort, led_to_a_plan.then_some(self.account.proposals + 1));
        if led_to_a_plan {
            observer.event(&Event::LastResort { resort });
        }
    }

    /// On what terms a resort plans, instead of the usual ones; none if it gives nothing up. An episode that sets the
    /// world back only lifts what was excluded before it; nor is more given up where nothing has failed yet.
    fn terms_by(&self, resort: Resort, counted: CountedExclusions, usual: &Terms) -> Option<Terms> {
        let goes_on = !self.options.restart && !self.account.failures.is_empty();
        Some(match resort {
            Resort::GuessedExclusions if counted == CountedExclusions::All => self.terms(CountedExclusions::Likely),
            Resort::EarlierExclusions if matches!(counted, CountedExclusions::All | CountedExclusions::Likely) => {
                self.terms(CountedExclusions::OfThisTask)
            }
            Resort::Strictness if goes_on && self.options.strict => Terms { relaxed: true, ..usual.clone() },
            Resort::AllExclusions if goes_on && counted != CountedExclusions::Elsewhere => {
                self.terms(CountedExclusions::None)
            }
            Resort::Bans if goes_on => self.terms(CountedExclusions::Elsewhere),
            _ => return None,
        })
    }

    fn terms(&self, counted: CountedExclusions) -> Terms {
        let (restrictions, conditions) = self.experience.avoided(&self.instance, &self.state, counted);
        let elsewhere = counted == CountedExclusions::Elsewhere;
        let Outlooks { risks, needs } = self.outlooks.clone();
        // What is only as good as needed is given up with the first guesses.
        let needs = if counted == CountedExclusions::All { needs } else { Vec::new() };
        Terms { restrictions, conditions, relaxed: false, elsewhere, loosened: Vec::new(), needs, risks }
    }

    fn planning_started(&self, terms: PlanningTerms, observer: &mut dyn Observer) {
        observer.event(&Event::PlanningStarted { proposal: self.account.proposals + 1, terms });
    }

    /// Plans, and tells of it.
    fn plan_aloud(
        &mut self,
        terms: &Terms,
        told: PlanningTerms,
        observer: &mut dyn Observer,
    ) -> Result<Proposal, ProposeError> {
        self.planning_started(told, observer);
        let planned = self.plan_on(terms);
        let report = planned.as_ref().map(Proposal::report).unwrap_or_default();
        self.count(report);
        let found = planned.as_ref().is_ok_and(|proposal| matches!(proposal.outcome, Outcome::Solved(_)));
        observer.event(&planning_ended(report, planned.as_ref().ok(), found));
        planned
    }

    /// The plan that there would be from where it is, on the terms that it has come to, if actions were imagined. Nothing is
    /// counted, and nobody is told.
    ///
    /// # Errors
    /// [`ProposeError`] as for [`propose`].
    pub fn plan_if_imagining(
        &self,
        imagine: typelift_imagine::Options,
        budget: &Budget,
    ) -> Result<Option<Plan>, ProposeError> {
        let terms = self.terms(self.account.resorts.counted());
        let (task, options) = self.asked(&terms, &self.state);
        let options = Options { imagine: Some(imagine), ..options };
        match propose(&self.model_on(&terms), &task, &terms.restrictions, &options, budget)?.outcome {
            Outcome::Solved(plan) => Ok(Some(plan)),
            _ => Ok(None),
        }
    }

    /// Adds what planning took to the account.
    fn count(&mut self, report: Report) {
        self.account.expansions += report.expansions;
        self.account.ground_actions = self.account.ground_actions.max(report.ground_actions);
    }

    /// Plans on these terms from the current state.
    fn plan_on(&self, terms: &Terms) -> Result<Proposal, ProposeError> {
        let (task, options) = self.asked(terms, &self.state);
        let model = self.model_on(terms);
        let mut budget = self.budget.clone();
        if terms.elsewhere {
            budget.expansions = Some(budget.expansions.unwrap_or(ELSEWHERE).min(ELSEWHERE));
        }
        attempt(&model, &task, &terms.restrictions, &options, &terms.loosened, &terms.risks, &budget)
    }

    /// The model that a plan on these terms for this state is made with.
    pub(crate) fn planned_on(&self, terms: &Terms, state: &State) -> Result<Arc<ActionModel>, ProposeError> {
        let (task, options) = self.asked(terms, state);
        let model = self.model_on(terms);
        let restrictions = &terms.restrictions;
        Ok(loosened_and_widened(&model, &task, restrictions, &options, &terms.loosened, &self.budget)?.model)
    }

    /// The model with what keeps actions from being used on these terms.
    pub(crate) fn model_on(&self, terms: &Terms) -> Cow<'_, ActionModel> {
        with_needs(terms.conditions.in_model(&self.model), &terms.needs)
    }

    pub(crate) fn asked(&self, terms: &Terms, state: &State) -> (Task, Options) {
        let task = Task { init: state.clone(), goal: self.goal.clone(), values: self.values.clone() };
        (task, Options { strict: self.options.strict && !terms.relaxed, ..self.options.clone() })
    }
}

/// That planning ended, with what it took.
fn planning_ended(report: Report, proposal: Option<&Proposal>, found: bool) -> Event {
    let imagined = proposal.into_iter().flat_map(|proposal| &proposal.imagination.actions);
    Event::PlanningEnded {
        expansions: report.expansions,
        ground_actions: report.ground_actions,
        imagined: imagined.map(|action| action.name.clone()).collect(),
        found,
    }
}

/// Whether a search ended with anything else than that there is no plan, as far as it looked.
fn has_answer(outcome: &Outcome) -> bool {
    !matches!(outcome, Outcome::Unsolvable | Outcome::Stopped(Stop::Expansions))
}
