//! Whether what is blamed is to blame: the explanations of failures, beside their true causes.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use typelift::belief::Culprit;
use typelift::model::Symbol;
use typelift_kitchen::Fault;

use super::record::{FailedStep, LifeRecord, TrueCause};

/// Parts of the probabilities from 0 to 1 that are looked at apart.
const BINS: usize = 10;

/// What became of blame in lives.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Blame {
    /// How often the right kind of culprit came first when a true cause struck for the first time, and of how many.
    pub first: [u64; 2],
    /// The same when it struck for the third time.
    pub third: [u64; 2],
    /// The same by kind of true cause, for every failure.
    pub by_cause: BTreeMap<String, [u64; 2]>,
    /// Of every failure: the mean of the summed squares of what the probability of each kind of culprit is off (Brier's score, 0
    /// to 2), as believed, if it is always thought to be the object, and always the type.
    pub brier: [f64; 3],
    /// For each tenth of the probabilities that a kind is to blame, how many there were, their sum, and how often it was.
    pub bins: [(u64, f64, u64); BINS],
}

/// The kinds of culprit that are right for a cause; none if the kitchen's rules alone are to blame for what was expected.
fn right(cause: &TrueCause) -> &'static [Culprit] {
    match cause {
        TrueCause::Fault(Fault::Broken { .. }) => &[Culprit::Object],
        TrueCause::Fault(Fault::Exception(_)) => &[Culprit::Pair],
        TrueCause::Fault(Fault::Rule { of_types: true, .. }) => &[Culprit::Pair, Culprit::Type],
        TrueCause::Fault(Fault::Interlock(_) | Fault::Rule { .. }) | TrueCause::Effect(_) => &[Culprit::Literal],
    }
}

/// What tells causes apart: the same tool is broken anew after it was mended, and a rule of types is one for each action and pair.
fn identity(step: &FailedStep, breakages: &BTreeMap<Symbol, u64>) -> String {
    match &step.cause {
        TrueCause::Fault(Fault::Broken { tool }) => {
            format!("{tool}, broken for the time {}", breakages.get(tool).copied().unwrap_or_default())
        }
        TrueCause::Fault(Fault::Rule { .. }) | TrueCause::Effect(_) => format!("{} {}", step.action, step.cause),
        cause => cause.to_string(),
    }
}

const KINDS: [Culprit; 5] = [Culprit::Object, Culprit::Type, Culprit::Pair, Culprit::Literal, Culprit::Chance];

/// The blame in some lives.
pub(super) fn blame<'r>(lives: impl Iterator<Item = &'r LifeRecord>) -> Blame {
    let (mut blame, mut failures) = (Blame::default(), 0.0);
    for life in lives {
        let (mut times, mut breakages): (BTreeMap<String, u64>, BTreeMap<Symbol, u64>) = Default::default();
        for task in &life.tasks {
            if let Some(tool) = &task.newly_broken {
                *breakages.entry(tool.clone()).or_default() += 1;
            }
            for step in task.failed.iter().filter(|step| !step.explanations.is_empty()) {
                let times = times.entry(identity(step, &breakages)).or_default();
                *times += 1;
                failures += 1.0;
                count(&mut blame, step, *times);
            }
        }
    }
    blame.brier = blame.brier.map(|sum| sum / f64::max(failures, 1.0));
    blame
}

fn count(blame: &mut Blame, step: &FailedStep, times: u64) {
    let right = right(&step.cause);
    let hit = u64::from(step.explanations.first().is_some_and(|first| right.contains(&first.kind)));
    let tally = |counts: &mut [u64; 2]| {
        counts[0] += hit;
        counts[1] += 1;
    };
    match times {
        1 => tally(&mut blame.first),
        3 => tally(&mut blame.third),
        _ => {}
    }
    tally(blame.by_cause.entry(step.cause.kind().to_owned()).or_default());
    let share =
        |kind: Culprit| -> f64 { step.explanations.iter().filter(|one| one.kind == kind).map(|one| one.share).sum() };
    let shares = KINDS.map(share);
    let always = |kind: Culprit| KINDS.map(|other| f64::from(u8::from(other == kind)));
    for (sum, probabilities) in blame.brier.iter_mut().zip([shares, always(Culprit::Object), always(Culprit::Type)]) {
        *sum += brier(&probabilities, right);
    }
    for (kind, share) in KINDS.into_iter().zip(shares) {
        let bin = ((share * BINS as f64) as usize).min(BINS - 1);
        let (count, sum, to_blame) = &mut blame.bins[bin];
        *count += 1;
        *sum += share;
        *to_blame += u64::from(right.contains(&kind));
    }
}

/// Brier's score of the probabilities of all kinds; where several are right they count as one.
fn brier(probabilities: &[f64; 5], right: &[Culprit]) -> f64 {
    let of = |is_right: bool| KINDS.iter().zip(probabilities).filter(move |(kind, _)| right.contains(kind) == is_right);
    let hit: f64 = of(true).map(|(_, p)| p).sum();
    let missed: f64 = of(false).map(|(_, p)| p * p).sum();
    (1.0 - hit).powi(2) + missed
}
