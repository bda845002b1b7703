//! What happens during an episode, a line each.

use typelift_agent::{Event, StepResult, WhyNoOther};
use typelift_world::Verdict;

use crate::plan::imagined_part;
use crate::text::{Role, Text, count};

/// An event in one line; `None` for what people need not be told: when planning begins and ends, and the end of it all,
/// which the [summary](crate::summary) tells.
pub fn line(event: &Event) -> Option<Text> {
    let indented = || Text::new().plain("       ");
    Some(match event {
        Event::PlanningStarted { .. } | Event::PlanningEnded { .. } | Event::Ended { .. } => return None,
        Event::Proposed { proposal, plan } => {
            let (steps, imagined) = (count(plan.len() as u64, "step"), imagined_part(plan.imagined_steps() as u64));
            Text::new().plain(format!("  proposal {proposal}: {steps}{imagined}"))
        }
        Event::Stepped { step, call, imagined, result, reason, .. } => {
            let mut line = Text::new().plain(format!("  {step:>3}  {call}"));
            if *imagined {
                line = line.plain("  ").with(Role::Imagined, "imagined");
            }
            line = line.plain("  ");
            if *result == StepResult::Tried(Verdict::AsExpected) {
                line.with(Role::Good, "ok")
            } else {
                let reason = reason.as_ref().map(|reason| format!(": {reason}"));
                line.with(Role::Bad, result.phrase()).plain(reason.unwrap_or_default())
            }
        }
        Event::Retried { .. } => indented().with(Role::Aside, "again"),
        Event::Excluded { suspect, .. } => indented().with(Role::Warning, "excluded").plain(format!(": {suspect}")),
        Event::Drifted { missing, .. } => indented().plain(match missing.strip_prefix("not ") {
            Some(atom) => format!("the world changed by itself: {atom} holds now"),
            None => format!("the world changed by itself: {missing} no longer holds"),
        }),
        Event::LastResort { resort } => indented().plain(format!("nothing left to try: {}", resort.phrase())),
        Event::NoOtherPlan { why, .. } => indented().plain(match why {
            WhyNoOther::NoMorePlans => "there is no other plan".to_owned(),
            WhyNoOther::ProposalLimit => "no more plans may be proposed".to_owned(),
            WhyNoOther::Stopped(stop) => format!("no other plan was found: {stop}"),
        }),
    })
}
