//! What happens during an episode, a line each.

use typelift_agent::{Event, StepResult, WhyNoOther};
use typelift_world::Verdict;

use crate::account::although;
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
        Event::Stepped { step, call, imagined, result, reason, reported, missed, added, deleted, .. } => {
            let mut line = Text::new().plain(format!("  {step:>3}  {call}"));
            if *imagined {
                line = line.plain("  ").with(Role::Imagined, "imagined");
            }
            line = line.plain("  ");
            if *result == StepResult::Tried(Verdict::AsExpected) {
                line = line.with(Role::Good, "ok");
            } else {
                line = line.with(Role::Bad, result.in_words(missed, added, deleted));
            }
            if let Some(reported) = reported {
                line = line.plain(", ").with(Role::Warning, although(*reported));
            }
            match reason {
                Some(reason) if *result != StepResult::Tried(Verdict::AsExpected) || reported.is_some() => {
                    line.plain(format!(": {reason}"))
                }
                _ => line,
            }
        }
        Event::Retried { .. } => indented().with(Role::Aside, "again"),
        Event::Excluded { suspect, .. } => indented().with(Role::Warning, "excluded").plain(format!(": {suspect}")),
        Event::Overruled { reason } => indented().plain(format!("no longer counts: {reason}")),
        Event::Drifted { missing, .. } => indented().plain(match missing.strip_prefix("not ") {
            Some(atom) => format!("the world changed by itself: {atom} holds now"),
            None if missing.contains('(') => format!("the world changed by itself: {missing} no longer holds"),
            None => format!("the world changed by itself: {missing} is there no more"),
        }),
        Event::LastResort { resort } => indented().plain(format!("nothing left to try: {}", resort.phrase())),
        Event::NoOtherPlan { why, .. } => indented().plain(match why {
            WhyNoOther::NoMorePlans => "there is no other plan".to_owned(),
            WhyNoOther::ProposalLimit => "no more plans may be proposed".to_owned(),
            WhyNoOther::Stopped(stop) => format!("no other plan was found: {stop}"),
        }),
    })
}

#[cfg(test)]
mod tests {
    use typelift_model::{GroundCall, Symbol};

    use super::*;

    #[test]
    fn a_part_that_is_missing_is_named_and_so_is_what_is_gone() {
        let stepped = |verdict, reason: Option<&str>| Event::Stepped {
            proposal: 1,
            step: 2,
            call: GroundCall { name: Symbol::new("unload"), args: vec![Symbol::new("bin_1")] },
            imagined: false,
            result: StepResult::Tried(verdict),
            reason: reason.map(str::to_owned),
            reported: None,
            added: Vec::new(),
            deleted: Vec::new(),
            missed: vec!["empty(bin_1)".to_owned(), "not shut(bin_1)".to_owned()],
        };
        let said = |event: &Event| line(event).expect("it is told").to_string();
        assert_eq!(
            said(&stepped(Verdict::Partly, Some("it jams"))),
            "    2  unload(bin_1)  only part of the expected effect happened (missing: empty(bin_1), not shut(bin_1)): it jams"
        );
        assert_eq!(said(&stepped(Verdict::Nothing, None)), "    2  unload(bin_1)  nothing changed");
        let mut late = stepped(Verdict::AsExpected, None);
        let Event::Stepped { reported, .. } = &mut late else { unreachable!() };
        *reported = Some(Verdict::TimedOut);
        assert_eq!(said(&late), "    2  unload(bin_1)  ok, as observed after it timed out");
        let mut contradicted = stepped(Verdict::AsExpected, Some("I lost it"));
        let Event::Stepped { reported, .. } = &mut contradicted else { unreachable!() };
        *reported = Some(Verdict::Refused);
        assert_eq!(said(&contradicted), "    2  unload(bin_1)  ok, although it was reported as: refused: I lost it");
        let drifted = |missing: &str| said(&Event::Drifted { step: 2, missing: missing.to_owned() });
        assert_eq!(drifted("shut(bin_1)"), "       the world changed by itself: shut(bin_1) no longer holds");
        assert_eq!(drifted("not shut(bin_1)"), "       the world changed by itself: shut(bin_1) holds now");
        assert_eq!(drifted("bin_1"), "       the world changed by itself: bin_1 is there no more");
    }
}
