//! Learning from a stream of transitions, measured: each is observed once and forgotten.

use typelift::learn::{Learned, Options, learn, observe};
use typelift::model::{Evidence, LearnedModel, Observations, ParseConfig, SourceId, Stop, Symbol};
use typelift::world::Record;
use typelift_kitchen::hierarchy;

use super::measurement::{End, Measurement};
use super::play::Play;
use super::processor_time::Stopwatch;

/// Transitions that are held at a time: looking at the clock around each would take longer than learning from it.
const CHUNK: u64 = 50;

/// Learns from so many transitions of random play. The time is that of learning alone, not of the simulator or of
/// reading its snapshots; with more than the allowed seconds of it, the measurement is cut.
pub(crate) fn measure(transitions: u64, seconds: f64) -> Measurement {
    let hierarchy = hierarchy();
    let (mut play, mut evidence, mut observing) = (Play::new(0), Observations::default(), 0.0);
    let (mut end, mut left) = (End::Finished, transitions);
    while left > 0 {
        let chunk: Vec<Record> = (0..left.min(CHUNK)).map(|_| play.next()).collect();
        left -= chunk.len() as u64;
        let begun = Stopwatch::start();
        for seen in &chunk {
            observe(&mut evidence, &seen.transition(), &hierarchy);
        }
        observing += begun.seconds();
        if observing > seconds {
            end = End::Stopped(Stop::Time);
            break;
        }
    }
    let begun = Stopwatch::start();
    let Learned { model, report } = learn(&hierarchy, &evidence, &Options::default()).expect("the kitchen's own types");
    let spent = observing + begun.seconds();
    let learned = LearnedModel {
        model,
        parse: ParseConfig::default(),
        options: Options::default(),
        // One long trace.
        evidence: Evidence::from_iter([(SourceId::new([0; 32]), Symbol::new("play"), evidence)]),
        refused: report.refused,
        ..LearnedModel::default()
    };
    let model_bytes = learned.to_json().map_or(0, |text| text.len() as u64);
    Measurement {
        actions: Some(report.generalized as u64),
        individual_actions: Some(report.individual as u64),
        observing_seconds: Some(observing),
        model_bytes: Some(model_bytes),
        peak_bytes: super::memory::peak_bytes(),
        ..Measurement::new(end, spent)
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
        assert_eq!(measure(400, 0.0).end, End::Stopped(Stop::Time));
    }
}
