//! What is told of actions that could be merged and are not.

use typelift_learn::{Options, learn, observe};
use typelift_model::{GroundAtom, GroundCall, Hierarchy, Observations, RefusedMerges, State};
use typelift_world::{TraceAction, Transition};

/// Adds a `wash` of a thing of this type of which these atoms hold; after it, it is clean or all is as it was.
fn wash(evidence: &mut Observations, hierarchy: &Hierarchy, ty: &str, held: &[&str], succeeds: bool) {
    let mut before = State::default();
    before.objects.insert("x".into(), hierarchy.id(ty).expect("declared"));
    before.atoms = held.iter().map(|predicate| GroundAtom::new(*predicate, vec!["x".into()])).collect();
    let mut after = before.clone();
    if succeeds {
        after.atoms.insert(GroundAtom::new("clean", vec!["x".into()]));
    }
    let action = TraceAction::from(GroundCall { name: "wash".into(), args: vec!["x".into()] });
    observe(evidence, &Transition { before: &before, action: &action, after: &after, file: None, step: 1 }, hierarchy);
}

#[test]
fn every_failure_that_speaks_against_a_merge_is_counted_once() {
    let edges = [("cup", "vessel"), ("mug", "vessel"), ("jar", "vessel"), ("bowl", "vessel"), ("vessel", "object")];
    let hierarchy = Hierarchy::from_edges(edges).expect("a tree");
    let mut evidence = Observations::default();
    // Each two have one precondition in common.
    for (ty, held) in [("cup", ["wet", "empty"]), ("mug", ["wet", "cold"]), ("jar", ["empty", "cold"])] {
        wash(&mut evidence, &hierarchy, ty, &held, true);
    }
    let refused =
        |evidence: &Observations| learn(&hierarchy, evidence, &Options::default()).expect("known types").report.refused;
    assert_eq!(refused(&evidence), RefusedMerges::default());
    // Each merge would have allowed another failure of the same call.
    for held in ["wet", "empty", "cold"] {
        wash(&mut evidence, &hierarchy, "bowl", &[held], false);
    }
    assert_eq!(refused(&evidence), RefusedMerges { pairs: 3, failures: 3 });
    // This one all of them would have allowed, and this one none.
    wash(&mut evidence, &hierarchy, "bowl", &["wet", "empty", "cold"], false);
    wash(&mut evidence, &hierarchy, "bowl", &[], false);
    assert_eq!(refused(&evidence), RefusedMerges { pairs: 3, failures: 4 });
    let report = learn(&hierarchy, &evidence, &Options::default()).expect("known types").report;
    let pairs = [["wash-cup", "wash-jar"], ["wash-cup", "wash-mug"], ["wash-jar", "wash-mug"]];
    assert_eq!(report.not_merged, pairs);
    assert_eq!(report.against_merges["wash"].times, 4);
}
