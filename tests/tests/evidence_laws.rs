//! What holds of evidence from many sources: it is their sum, whatever was added when and in which parts; what is taken
//! out again was never there; the same trace counts once; and of compact evidence all but the taking out. Held on the
//! bytes of the models that are learned.

use std::collections::BTreeSet;

use proptest::prelude::*;
use proptest::test_runner::Config;
use typelift::learn::{evidence_of, learn_evidence};
use typelift::model::{
    Evidence, Hierarchy, LearnOptions, LearnedModel, MergeError, Observations, ParseConfig, SourceId, Symbol,
};
use typelift::world::{Dataset, Trace};
use typelift_kitchen::demonstrations;
use typelift_tests::dataset_of;
use typelift_tests::open::{kinds_of, opened};

/// Demonstrations in several rooms, which differ in what holds and have names in common. Two have open states, and one of
/// them does not list everything.
fn shown() -> Dataset {
    let mut dataset = dataset_of(&demonstrations(0));
    dataset.traces.truncate(5);
    dataset.traces.extend(dataset_of(&demonstrations(1)).traces.into_iter().take(3));
    let kinds = kinds_of(&dataset);
    let fewer = kinds.iter().take(kinds.len() / 2).cloned().collect();
    for (index, kinds) in [(2, &kinds), (6, &fewer)] {
        dataset.traces[index] = opened(&dataset.traces[index], &dataset.hierarchy, kinds, |_| false);
    }
    dataset
}

fn of(dataset: &Dataset, chosen: impl IntoIterator<Item = usize>) -> Evidence {
    let traces = chosen.into_iter().map(|index| dataset.traces[index].clone()).collect();
    evidence_of(&Dataset { hierarchy: dataset.hierarchy.clone(), traces, ..Dataset::default() })
}

fn ids(dataset: &Dataset) -> Vec<SourceId> {
    dataset.traces.iter().map(|trace| trace.source_id(&dataset.hierarchy)).collect()
}

fn learned(hierarchy: &Hierarchy, evidence: &Evidence) -> LearnedModel {
    let (parse, options) = (ParseConfig::default(), LearnOptions::default());
    learn_evidence(hierarchy, &parse, evidence.clone(), &options).expect("a model").0
}

fn bytes(hierarchy: &Hierarchy, evidence: &Evidence) -> String {
    let learned = learned(hierarchy, evidence);
    let text = learned.to_json().expect("JSON");
    let read = LearnedModel::from_json(&text).expect("a model");
    assert_eq!(read, learned);
    assert_eq!(read.to_json().expect("JSON"), text);
    text
}

/// The evidence as its file gives it back.
fn kept(hierarchy: &Hierarchy, evidence: &Evidence) -> Evidence {
    LearnedModel::from_json(&bytes(hierarchy, evidence)).expect("a model").evidence
}

proptest! {
    #![proptest_config(Config { cases: 24, failure_persistence: None, ..Config::default() })]

    #[test]
    fn any_parts_in_any_order_give_the_same_bytes(
        parts in prop::collection::vec(prop::collection::btree_set(0..8_usize, 0..5), 1..5),
        order in Just((0..8_usize).collect::<Vec<_>>()).prop_shuffle(),
    ) {
        let dataset = shown();
        let h = &dataset.hierarchy;
        let all: BTreeSet<usize> = parts.iter().flatten().copied().collect();
        let at_once = of(&dataset, order.iter().copied().filter(|index| all.contains(index)));
        // Parts may share sources: these count once.
        let mut merged = Evidence::default();
        for part in &parts {
            let already = merged.sources().clone();
            let part = of(&dataset, part.iter().copied());
            let shared = merged.merge(&part).expect("read in one way");
            prop_assert!(part.sources().keys().filter(|id| already.contains_key(id)).eq(&shared));
            merged = kept(h, &merged);
        }
        prop_assert_eq!(&merged, &at_once);
        prop_assert_eq!(bytes(h, &merged), bytes(h, &at_once));
        let mut backwards = Evidence::default();
        for part in parts.iter().rev() {
            backwards.merge(&of(&dataset, part.iter().copied())).expect("read in one way");
        }
        prop_assert_eq!(&backwards, &at_once);
        let transitions: usize = all.iter().map(|&index| dataset.traces[index].actions.len()).sum();
        prop_assert_eq!(at_once.total().transitions, transitions as u64);
    }

    #[test]
    fn what_is_taken_out_was_never_there(
        first in prop::collection::btree_set(0..8_usize, 0..8),
        out in prop::collection::btree_set(0..8_usize, 0..8),
    ) {
        let dataset = shown();
        let (h, ids) = (&dataset.hierarchy, ids(&dataset));
        let mut evidence = kept(h, &of(&dataset, first.iter().copied()));
        for &index in &out {
            prop_assert_eq!(evidence.take_out(ids[index]), Ok(first.contains(&index)));
        }
        let left = of(&dataset, first.difference(&out).copied());
        prop_assert_eq!(&evidence, &left);
        prop_assert_eq!(bytes(h, &evidence), bytes(h, &left));
    }

    #[test]
    fn compact_evidence_is_the_sum_too(split in 0..9_usize, cut in 0..9_usize) {
        let dataset = shown();
        let h = &dataset.hierarchy;
        let (first, second) = (split.min(cut), split.max(cut));
        let parts = [of(&dataset, 0..first), of(&dataset, first..second), of(&dataset, second..8)];
        let mut all = of(&dataset, 0..8);
        let actions = learned(h, &all).model;
        all.compact();
        prop_assert_eq!(&learned(h, &all).model, &actions, "nothing is lost that is learned from");
        // Whichever part is compact, the sum is.
        for compact in 0..3 {
            let mut sum = Evidence::default();
            for (index, part) in parts.iter().enumerate() {
                let mut part = part.clone();
                if index == compact {
                    part.compact();
                }
                sum.merge(&kept(h, &part)).expect("nothing is shared");
            }
            prop_assert_eq!(&sum, &all);
            prop_assert_eq!(bytes(h, &sum), bytes(h, &all));
        }
    }
}

#[test]
fn nothing_can_be_added_to_anything_and_anything_to_nothing() {
    let dataset = shown();
    let by_source = of(&dataset, 0..3);
    let mut compact = by_source.clone();
    compact.compact();
    let unnamed = Evidence::of_total([].into(), by_source.total().into_owned());
    for evidence in [by_source, compact, unnamed.clone()] {
        let (mut left, mut right) = (evidence.clone(), Evidence::default());
        assert_eq!((left.merge(&Evidence::default()), right.merge(&evidence)), (Ok(Vec::new()), Ok(Vec::new())));
        assert_eq!((&left, &right), (&evidence, &evidence));
    }
    assert_eq!(of(&dataset, 3..4).merge(&unnamed), Err(MergeError::UnknownSources));
}

#[test]
fn compact_evidence_takes_nothing_twice_and_nothing_out() {
    let dataset = shown();
    let ids = ids(&dataset);
    let mut compact = of(&dataset, 0..3);
    compact.compact();
    let before = compact.clone();
    let error = compact.merge(&of(&dataset, 2..4)).expect_err("one is in both");
    let name = dataset.traces[2].file.clone().expect("a name");
    assert_eq!(error, MergeError::Shared(vec![(ids[2], name.clone())]));
    assert!(error.to_string().contains(&format!("{name} ({})", ids[2].short())), "{error}");
    assert_eq!(of(&dataset, 2..4).merge(&compact), Err(error));
    assert!(compact.take_out(ids[0]).is_err());
    assert_eq!(compact, before, "nothing happened");
}

#[test]
fn the_same_trace_counts_once_under_any_name() {
    let mut dataset = dataset_of(&demonstrations(0));
    let expected = evidence_of(&dataset);
    assert_eq!((expected.sources().len(), expected.total().transitions), (8, 68));
    let mut again = dataset.traces[3].clone();
    again.file = Some(Symbol::new("z_copy.jsonl"));
    dataset.traces.insert(0, again.clone());
    assert_eq!(evidence_of(&dataset), expected);
    // Of two names the first in the alphabet is kept, whichever comes first.
    let named = |name: &str| Trace { file: Some(Symbol::new(name)), ..again.clone() };
    let of = |traces: Vec<Trace>| evidence_of(&Dataset { traces, ..dataset.clone() });
    let (a, b) = (of(vec![named("a"), named("b")]), of(vec![named("b"), named("a")]));
    assert_eq!((&a, a.sources().values().next().map(|source| source.name.as_str())), (&b, Some("a")));
    let (mut ab, mut ba) = (of(vec![named("a")]), of(vec![named("b")]));
    ab.merge(&ba).expect("the same");
    ba.merge(&ab).expect("the same");
    assert_eq!((&ab, &ba), (&a, &a));
    // What was done makes a trace, not its name: another order of the same steps is another one.
    assert_ne!(named("a").source_id(&dataset.hierarchy), dataset.traces[1].source_id(&dataset.hierarchy));
}

#[test]
fn a_trace_that_was_read_in_two_ways_is_refused() {
    let dataset = shown();
    let id = ids(&dataset)[0];
    let read = |index: usize| {
        let observations: Observations = of(&dataset, [index]).total().into_owned();
        Evidence::from_iter([(id, Symbol::new("a.jsonl"), observations)])
    };
    let error = read(0).merge(&read(1)).expect_err("they differ");
    assert_eq!(error, MergeError::ReadDifferently { id, name: Symbol::new("a.jsonl") });
}
