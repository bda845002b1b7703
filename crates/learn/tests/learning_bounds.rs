//! Transitions with many entities, and with unknown ones: what can be told apart is, what cannot be is reported.

use std::collections::BTreeSet;

use typelift_learn::observe;
use typelift_model::{
    GroundAtom, GroundCall, Hierarchy, MOST_PARAMETERS, Observations, Pattern, State, Symbol, Unexplained, Unknown,
};
use typelift_world::{TraceAction, Transition};

/// `look`, after which `n` entities called by `name` are seen; before, what `before` says of them holds.
fn look(n: usize, name: impl Fn(usize) -> String, before: impl Fn(usize) -> Vec<String>) -> (Observations, State) {
    let hierarchy = Hierarchy::from_edges([("thing", "object")]).expect("a tree");
    let ty = hierarchy.id("thing").expect("declared");
    let atoms =
        |texts: Vec<String>| texts.iter().map(|t| GroundAtom::parse(t).expect("an atom")).collect::<BTreeSet<_>>();
    let mut state = State::default();
    state.objects.extend((0..n).map(|i| (Symbol::from(name(i)), ty)));
    state.atoms = atoms((0..n).flat_map(&before).collect());
    let mut after = state.clone();
    after.atoms.extend(atoms((0..n).map(|i| format!("seen({})", name(i))).collect()));
    (observed(&state, &after), state)
}

fn observed(before: &State, after: &State) -> Observations {
    let hierarchy = Hierarchy::from_edges([("thing", "object")]).expect("a tree");
    let call = GroundCall { name: "look".into(), args: Vec::new() };
    let action = TraceAction::from(call);
    let mut evidence = Observations::default();
    observe(&mut evidence, &Transition { before, action: &action, after, file: None, step: 1 }, &hierarchy);
    evidence
}

/// The same with every name replaced by one that sorts the other way round.
fn backwards(n: usize) -> impl Fn(usize) -> String {
    move |i| format!("o{:04}", n - i)
}

fn forwards(i: usize) -> String {
    format!("o{i:04}")
}

#[test]
fn what_the_pre_state_tells_apart_is_told_apart() {
    for n in [8, 30] {
        // A different mark on each.
        let (evidence, _) = look(n, forwards, |i| vec![format!("mark_{i}({})", forwards(i))]);
        let (other, _) = look(n, backwards(n), |i| vec![format!("mark_{i}({})", backwards(n)(i))]);
        assert_eq!(evidence, other);
        assert_eq!(evidence.clusters.len(), 1, "{n}: {:?}", evidence.unexplained);
        // One on top of the other.
        let on = |name: &dyn Fn(usize) -> String, i: usize| match i {
            0 => Vec::new(),
            i => vec![format!("on({},{})", name(i), name(i - 1))],
        };
        let (evidence, _) = look(n, forwards, |i| on(&forwards, i));
        let (other, _) = look(n, backwards(n), |i| on(&backwards(n), i));
        assert_eq!(evidence, other);
        assert_eq!(evidence.clusters.len(), 1, "{n}: {:?}", evidence.unexplained);
    }
}

#[test]
fn what_is_alike_needs_no_telling_apart() {
    for n in [8, 60] {
        let colour = |i: usize| if i.is_multiple_of(2) { "red" } else { "blue" };
        let (evidence, _) = look(n, forwards, |i| vec![format!("{}({})", colour(i), forwards(i))]);
        let (other, _) = look(n, backwards(n), |i| vec![format!("{}({})", colour(i), backwards(n)(i))]);
        assert_eq!(evidence, other);
        assert_eq!(evidence.clusters.len(), 1, "{n}: {:?}", evidence.unexplained);
    }
}

#[test]
fn too_many_entities_are_reported() {
    let (evidence, _) = look(MOST_PARAMETERS + 1, forwards, |_| Vec::new());
    assert!(evidence.clusters.is_empty());
    assert_eq!(evidence.unexplained.keys().collect::<Vec<_>>(), [&Unexplained::TooLarge]);
}

#[test]
fn what_depends_on_the_unknown_is_reported() {
    let (_, mut state) = look(2, forwards, |_| Vec::new());
    let mut after = state.clone();
    after.atoms.insert(GroundAtom::parse("seen(o0000)").expect("an atom"));
    let unknown = |atom: &str| Pattern::parse(atom).expect("a pattern");
    for elsewhere in ["open(o0001)", "on(o0001,o0001)"] {
        state.unknown = Unknown::Matching([unknown(elsewhere)].into());
        assert_eq!(observed(&state, &after).clusters.len(), 1, "{elsewhere} has no part in it");
    }
    // A `*` may be what has been seen, wherever it stands, and whatever stands beside it.
    for near in ["open(o0000)", "on(o0001,o0000)", "open(*)", "on(o0001,*)", "on(*,o0001)", "on(*,*)", "dark"] {
        state.unknown = Unknown::Matching([unknown("open(o0001)"), unknown(near)].into());
        let evidence = observed(&state, &after);
        assert!(evidence.clusters.is_empty(), "{near}");
        assert_eq!(evidence.unexplained.keys().collect::<Vec<_>>(), [&Unexplained::PartlyObserved], "{near}");
    }
}

#[test]
fn what_the_state_does_not_have_takes_no_part() {
    let (_, state) = look(2, forwards, |_| Vec::new());
    let mut after = state.clone();
    after.atoms.insert(GroundAtom::parse("seen(nobody)").expect("an atom"));
    let evidence = observed(&state, &after);
    assert!(evidence.clusters.is_empty());
    assert_eq!(evidence.unexplained.keys().collect::<Vec<_>>(), [&Unexplained::ObjectsChanged]);
}
