//! Learning from a stream of transitions, measured: each is observed once and forgotten.

use std::time::{Duration, Instant};

use typelift::learn::{Options, learn, observe};
use typelift::model::Evidence;
use typelift::world::Transition;
use typelift_kitchen::hierarchy;

use super::measurement::{End, Measurement};
use super::play::Play;

/// Learns from so many transitions of random play. The time is that of learning alone, not of the simulator or of
/// reading its snapshots; with more than the allowed seconds of it, the measurement is cut.
pub(crate) fn measure(transitions: u64, seconds: f64) -> Measurement {
    let hierarchy = hierarchy();
    let (mut play, mut evidence, mut spent) = (Play::new(0), Evidence::default(), Duration::ZERO);
    let mut end = End::Finished;
    for _ in 0..transitions {
        let seen = play.next();
        let (file, step) = (Some(&seen.file), seen.step);
        let transition = Transition { before: &seen.before, action: &seen.action, after: &seen.after, file, step };
        let begun = Instant::now();
        observe(&mut evidence, &transition, &hierarchy);
        spent += begun.elapsed();
        if spent.as_secs_f64() > seconds {
            end = End::Time;
            break;
        }
    }
    let (begun, observing) = (Instant::now(), spent);
    let learned = learn(&hierarchy, evidence, &Options::default()).expect("the kitchen's own types");
    spent += begun.elapsed();
    let model_bytes = learned.model.to_json().map_or(0, |text| text.len() as u64);
    Measurement {
        actions: Some(learned.report.generalized as u64),
        individual_actions: Some(learned.report.individual as u64),
        observing_seconds: Some(observing.as_secs_f64()),
        model_bytes: Some(model_bytes),
        peak_bytes: super::memory::peak_bytes(),
        ..Measurement::new(end, spent.as_secs_f64())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn play_teaches_actions() {
        let measured = measure(400, 60.0);
        assert_eq!(measured.end, End::Finished);
        let (individual, general) = (measured.individual_actions.expect("counted"), measured.actions.expect("counted"));
        assert!(individual > general && general >= 3, "{individual} {general}");
        assert!(measured.model_bytes > Some(1000));
    }

    #[test]
    fn no_time_cuts_it() {
        assert_eq!(measure(400, 0.0).end, End::Time);
    }
}
