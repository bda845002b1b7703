//! Learning from open states: what is listed in full gives what closed states give; what is hidden gives nothing that the
//! steps that count would contradict, if everything were seen; and a step counts only if nothing is hidden that it may
//! have changed.

use std::collections::BTreeSet;

use typelift::learn::{Learned, Options, evidence_of, learn, observe};
use typelift::model::{AtomKind, Evidence, GroundAtom, Observations, Symbol, Unexplained};
use typelift::world::{Dataset, Trace};
use typelift_kitchen::demonstrations;
use typelift_tests::dataset_of;
use typelift_tests::open::{kinds_of, opened};

fn learned(dataset: &Dataset, observations: &Observations, individual: bool) -> Learned {
    learn(&dataset.hierarchy, observations, &Options { individual, ..Options::default() }).expect("a model")
}

/// The dataset with open states that list all atoms of kinds that ever hold, but for those that are `hidden`.
fn opened_dataset(dataset: &Dataset, mut hidden: impl FnMut(&GroundAtom) -> bool) -> Dataset {
    let kinds = kinds_of(dataset);
    let open = |trace: &Trace| opened(trace, &dataset.hierarchy, &kinds, &mut hidden);
    Dataset { traces: dataset.traces.iter().map(open).collect(), ..dataset.clone() }
}

/// A source of chance: true once in `n` times.
fn once_in(n: u64, seed: u64) -> impl FnMut(&GroundAtom) -> bool {
    let mut state = seed;
    move |_| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33).is_multiple_of(n)
    }
}

/// How many steps are of no use, for any of these reasons.
fn unexplained(observations: &Observations, reasons: &[Unexplained]) -> u64 {
    reasons.iter().filter_map(|reason| observations.unexplained.get(reason)).map(|(count, _)| count).sum()
}

#[test]
fn what_is_listed_in_full_is_learned_as_from_closed_states() {
    let closed = dataset_of(&demonstrations(0));
    let open = opened_dataset(&closed, |_| false);
    assert!(open.traces.iter().flat_map(|trace| &trace.states).all(|state| !state.unknown.is_nothing()));
    for individual in [true, false] {
        let expected = learned(&closed, &evidence_of(&closed).total(), individual);
        let found = learned(&open, &evidence_of(&open).total(), individual);
        assert_eq!((found.model, found.report), (expected.model, expected.report));
    }
}

#[test]
fn closed_and_open_traces_are_learned_from_together() {
    let closed = dataset_of(&demonstrations(0));
    let open = opened_dataset(&closed, |_| false);
    let traces = (0..).zip(&closed.traces).zip(&open.traces);
    let mixed = traces.map(|((i, closed), open)| if i % 2 == 0 { closed.clone() } else { open.clone() }).collect();
    let mixed = Dataset { traces: mixed, ..closed.clone() };
    let (expected, found) = (evidence_of(&closed), evidence_of(&mixed));
    assert_eq!(learned(&mixed, &found.total(), false).model, learned(&closed, &expected.total(), false).model);
}

#[test]
fn hiding_is_at_worst_like_leaving_steps_out() {
    let closed = dataset_of(&demonstrations(0));
    let (h, kinds) = (&closed.hierarchy, kinds_of(&closed));
    let mut counted: Vec<u64> = Vec::new();
    for n in [3, 100, 1_000, 10_000, 100_000] {
        let mut all = 0;
        for seed in 0..8 {
            let open = opened_dataset(&closed, once_in(n, seed));
            let found = evidence_of(&open).total().into_owned();
            // The steps that count, as they were before anything was hidden.
            let mut seen = Observations::default();
            for (open, closed) in open.transitions().zip(closed.transitions()) {
                let mut step = Observations::default();
                step.open.kinds.clone_from(&kinds);
                observe(&mut step, &open, h);
                if step.settled().unexplained.is_empty() {
                    observe(&mut seen, &closed, h);
                }
            }
            assert_eq!(found.clusters, seen.clusters, "one in {n} hidden, {seed}");
            assert_eq!(found.negatives, seen.negatives, "one in {n} hidden, {seed}");
            let told = unexplained(&found, &[Unexplained::PartlyObserved, Unexplained::UnlistedKinds]);
            assert_eq!(seen.transitions + told, found.transitions, "each counts, or is told of");
            all += seen.transitions;
        }
        counted.push(all);
    }
    assert!(
        counted.is_sorted() && counted[0] == 0 && counted[4] > 8 * 60,
        "the less is hidden, the more counts: {counted:?}"
    );
}

#[test]
fn what_another_trace_lists_may_have_changed_unseen() {
    let closed = dataset_of(&demonstrations(0));
    let kinds = kinds_of(&closed);
    let is_held = |kind: &AtomKind| kind.to_string().starts_with("holding_holds");
    let fewer: BTreeSet<AtomKind> = kinds.iter().filter(|kind| !is_held(kind)).cloned().collect();
    let trace = |name: &str, kinds| {
        let trace = closed.traces.iter().find(|trace| trace.file.as_ref().is_some_and(|file| file == name));
        opened(trace.expect(name), &closed.hierarchy, kinds, |_| false)
    };
    let of = |traces: Vec<Trace>| evidence_of(&Dataset { traces, ..closed.clone() });
    let alone = of(vec![trace("blend_carrot.jsonl", &fewer)]);
    let other = of(vec![trace("blend_two_carrots.jsonl", &kinds)]);
    let told = |evidence: &Evidence| unexplained(&evidence.total(), &[Unexplained::UnlistedKinds]);
    assert_eq!((told(&alone), told(&other)), (0, 0), "nothing tells that something is missing");
    let mut both = alone.clone();
    both.merge(&other).expect("no source is shared");
    assert_eq!(told(&both), alone.total().transitions);
    assert_eq!(both.total().clusters, other.total().clusters);
    // It is a matter of all the evidence, so it can change again.
    for id in other.sources().keys() {
        both.take_out(*id).expect("not compact");
    }
    assert_eq!(both, alone);
}

#[test]
fn no_failure_is_seen_where_an_effect_may_be_hidden() {
    let closed = dataset_of(&demonstrations(0));
    let changing: BTreeSet<Symbol> = evidence_of(&closed)
        .total()
        .clusters
        .keys()
        .flat_map(|key| key.adds.iter().chain(&key.deletes).map(|atom| atom.predicate.clone()))
        .collect();
    // Every second atom that may change is hidden, so that some steps show no change at all.
    let mut odd = false;
    let open = opened_dataset(&closed, |atom| {
        odd = !odd;
        odd && changing.contains(&atom.predicate)
    });
    let unchanged =
        open.transitions().filter(|t| t.before.added(t.after).chain(t.before.deleted(t.after)).next().is_none());
    assert!(unchanged.count() > 0);
    let found = evidence_of(&open).total().into_owned();
    assert_eq!(found.failures(), 0);
    assert_eq!(unexplained(&found, &[Unexplained::PartlyObserved, Unexplained::UnlistedKinds]), 68);
}
