//! What an episode proposes: a plan from where it is, if need be by a last resort, or another one.

use std::sync::Arc;

use typelift_model::{ActionModel, Plan, State, Stop, Task};
use typelift_plan::Outcome;

use crate::account::Ending;
use crate::blame::with_conditions;
use crate::episode::{Episode, EpisodeError, Phase};
use crate::event::{Event, Observer};
use crate::execution::{Execution, Terms, steps};
use crate::options::Options;
use crate::propose::{Proposal, ProposeError, propose, widened};
use crate::resort::{Counted, Resort};
use crate::turn::Command;

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
        let (mut proposal, terms) = match self.plan_with_last_resorts(observer) {
            Ok(planned) => planned,
            Err(ProposeError::Stopped(stop)) => return Ok(self.end(Ending::Stopped(stop), observer)),
            Err(error) => return Err(error.into()),
        };
        // A plan that did not lead to the goal from this very state, though no step of it failed, is not begun again.
        let mut plans_given = 1;
        while self.was_in_vain(&proposal.outcome) {
            proposal.outcome = proposal.next_plan(&self.budget)?;
            plans_given += 1;
        }
        let ending = match &proposal.outcome {
            Outcome::Unsolvable | Outcome::NoMorePlans | Outcome::Stopped(Stop::Expansions) if plans_given > 1 => {
                Ending::Circular
            }
            Outcome::Solved(plan) => {
                let plan = plan.clone();
                return Ok(self.offer(plan, proposal, terms, plans_given, observer));
            }
            Outcome::Unsolvable | Outcome::NoMorePlans => {
                self.account.goal_type_mismatches = proposal.goal_type_mismatches();
                Ending::NoPlan(proposal.explain())
            }
            Outcome::Stopped(stop) => Ending::Stopped(*stop),
        };
        Ok(self.end(ending, observer))
    }

    fn was_in_vain(&self, outcome: &Outcome) -> bool {
        let Outcome::Solved(plan) = outcome else { return false };
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

    /// The next plan of the same search. If there is none, or no more may be proposed, the proposed one stands.
    pub(crate) fn another_plan(&mut self, observer: &mut dyn Observer) -> Result<Command, EpisodeError> {
        let Some(execution) = &self.execution else { return Ok(self.standing()) };
        let (terms, plans_given) = (execution.terms.clone(), execution.plans_given);
        let mut proposal = match self.proposal.take() {
            Some(proposal) => proposal,
            // After restoring, the search is taken up where it was.
            None => {
                let mut proposal = self.plan_on(&terms)?;
                for _ in 1..plans_given {
                    proposal.next_plan(&self.budget)?;
                }
                proposal
            }
        };
        let (before, mut given) = (proposal.report().expansions, plans_given);
        let mut outcome = Outcome::NoMorePlans;
        if self.account.proposals < self.options.max_proposals {
            loop {
                outcome = proposal.next_plan(&self.budget)?;
                given += 1;
                if !self.was_in_vain(&outcome) {
                    break;
                }
            }
        }
        self.account.expansions += proposal.report().expansions.saturating_sub(before);
        if let Outcome::Solved(plan) = outcome {
            return Ok(self.offer(plan, proposal, terms, given, observer));
        }
        observer.event(&Event::NoOtherPlan { proposal: self.account.proposals });
        if let Some(execution) = &mut self.execution {
            execution.plans_given = given;
        }
        self.proposal = Some(proposal);
        Ok(self.standing())
    }

    /// Plans. Where there is no plan, it takes the last resorts that there are, one after the other, until there is one.
    fn plan_with_last_resorts(&mut self, observer: &mut dyn Observer) -> Result<(Proposal, Terms), ProposeError> {
        let counted = self.account.resorts.counted();
        let usual = self.terms(counted);
        let proposal = self.plan_aloud(&usual, observer)?;
        if has_answer(&proposal.outcome) {
            return Ok((proposal, usual));
        }
        let resorts: Vec<Resort> = self.account.resorts.iter().map(|last| last.resort).collect();
        for resort in resorts {
            let Some(terms) = self.terms_by(resort, counted, &usual) else { continue };
            let other = self.plan_aloud(&terms, observer)?;
            let led_to_a_plan = has_answer(&other.outcome);
            self.account.resorts.tried(resort, led_to_a_plan.then_some(self.account.proposals + 1));
            if led_to_a_plan {
                observer.event(&Event::LastResort { resort });
                return Ok((other, terms));
            }
        }
        Ok((proposal, usual))
    }

    /// On what terms a resort plans, instead of the usual ones; none if it gives nothing up. An episode that sets the
    /// world back only lifts what was excluded before it; nor is more given up where nothing has failed yet.
    fn terms_by(&self, resort: Resort, counted: Counted, usual: &Terms) -> Option<Terms> {
        let goes_on = !self.options.restart && !self.account.failures.is_empty();
        let terms = match resort {
            Resort::EarlierExclusions if counted == Counted::All => self.terms(Counted::OfThisTask),
            Resort::Strictness if goes_on && self.options.strict => Terms { relaxed: true, ..usual.clone() },
            Resort::AllExclusions if goes_on => self.terms(Counted::None),
            _ => return None,
        };
        (terms != *usual).then_some(terms)
    }

    fn terms(&self, counted: Counted) -> Terms {
        let (restrictions, conditions) = self.experience.avoided(&self.instance, counted);
        Terms { restrictions, conditions, relaxed: false }
    }

    /// Plans, and tells of it.
    fn plan_aloud(&mut self, terms: &Terms, observer: &mut dyn Observer) -> Result<Proposal, ProposeError> {
        observer.event(&Event::PlanningStarted { proposal: self.account.proposals + 1 });
        let planned = self.plan_on(terms);
        let report = planned.as_ref().map(Proposal::report).unwrap_or_default();
        self.account.expansions += report.expansions;
        self.account.ground_actions = self.account.ground_actions.max(report.ground_actions);
        let imagined = planned.as_ref().map(|p| p.imagination.actions.iter().map(|a| a.name.clone()).collect());
        observer.event(&Event::PlanningEnded {
            expansions: report.expansions,
            ground_actions: report.ground_actions,
            imagined: imagined.unwrap_or_default(),
            found: planned.as_ref().is_ok_and(|p| matches!(p.outcome, Outcome::Solved(_))),
        });
        planned
    }

    /// Plans on these terms from the current state.
    fn plan_on(&self, terms: &Terms) -> Result<Proposal, ProposeError> {
        let (task, options) = self.asked(terms, &self.state);
        let model = with_conditions(&self.model, &terms.conditions);
        propose(&model, &task, &terms.restrictions, &options, &self.budget)
    }

    /// The model that a plan on these terms for this state is made with.
    pub(crate) fn planned_on(&self, terms: &Terms, state: &State) -> Result<Arc<ActionModel>, ProposeError> {
        let (task, options) = self.asked(terms, state);
        let model = with_conditions(&self.model, &terms.conditions);
        Ok(widened(&model, &task, &terms.restrictions, &options, &self.budget)?.model)
    }

    fn asked(&self, terms: &Terms, state: &State) -> (Task, Options) {
        let task = Task { init: state.clone(), goal: self.goal.clone(), values: self.values.clone() };
        (task, Options { strict: self.options.strict && !terms.relaxed, ..self.options.clone() })
    }
}

/// Whether a search ended with anything else than that there is no plan, as far as it looked.
fn has_answer(outcome: &Outcome) -> bool {
    !matches!(outcome, Outcome::Unsolvable | Outcome::Stopped(Stop::Expansions))
}
