//! Learning from what was read.

use std::collections::BTreeMap;

use typelift::learn::{self, evidence_of, learn, learn_dataset, observe};
use typelift::model::{LearnedModel, Observations, strict};
use typelift::world::Dataset;

use super::domain::assert_kept;

/// Whatever was read can be learned from; evidence is the same in any split, and merged in either order.
pub(super) fn assert_learned(dataset: &Dataset) {
    // Of predicates that no transition is about, whole traces alone tell.
    let whole = Observations { predicates: BTreeMap::new(), ..evidence_of(dataset).total().into_owned() };
    let transitions: Vec<_> = dataset.transitions().collect();
    let (first, second) = transitions.split_at(transitions.len() / 2);
    let [first, second] = [first, second].map(|part| {
        let mut evidence = Observations::default();
        part.iter().for_each(|transition| observe(&mut evidence, transition, &dataset.hierarchy));
        evidence
    });
    assert_eq!(merged(&first, &second), whole);
    assert_eq!(merged(&second, &first), whole);
    for individual in [false, true] {
        let options = learn::Options { individual, ..learn::Options::default() };
        let (learned, report) = learn_dataset(dataset, &options).expect("all types are those of the hierarchy");
        assert_eq!(report.transitions, transitions.len() as u64);
        assert_kept(&learned);
        assert_kept(&LearnedModel { model: strict(&learned.model), ..learned.clone() });
        let again = learn(&dataset.hierarchy, &learned.evidence.total(), &options).expect("as before");
        assert_eq!(again.model.actions, learned.model.actions);
    }
}

fn merged(first: &Observations, second: &Observations) -> Observations {
    let mut merged = first.clone();
    merged.merge(second);
    merged
}
