//! What failed is not believed to be what an action does, and speaks against actions that would have allowed it.

use std::collections::BTreeMap;

use typelift::learn::{Learned, Options, evidence_of, learn};
use typelift::model::{
    GroundAtom, GroundCall, Hierarchy, Observations, ParseConfig, RefusedMerges, Symbol, Unexplained, Unknown,
};
use typelift::world::{Dataset, Expected, Parser, Trace, TraceAction, Verdict};

/// Cups, mugs and jars are vessels; they and shelves are things.
fn types() -> Hierarchy {
    let edges = [("cup", "vessel"), ("mug", "vessel"), ("jar", "vessel"), ("vessel", "thing"), ("shelf", "thing")];
    Hierarchy::from_edges(edges).expect("a tree")
}

/// A step on `cup_1 mug_1 jar_1 shelf_1`: the atoms before, `name(args)`, the atoms after.
fn step(before: &str, call: &str, after: &str) -> (TraceAction, [String; 2]) {
    let call = GroundAtom::parse(call).expect("a call");
    let action = TraceAction::from(GroundCall { name: call.predicate, args: call.args });
    (action, [before.to_owned(), after.to_owned()])
}

fn not_executed(before: &str, call: &str, after: &str) -> (TraceAction, [String; 2]) {
    let (action, states) = step(before, call, after);
    (TraceAction { executed: Some(false), ..action }, states)
}

fn evidence(steps: &[(TraceAction, [String; 2])]) -> Observations {
    let mut parser = Parser::new(types(), ParseConfig::default());
    let objects: BTreeMap<Symbol, Symbol> =
        ["cup", "mug", "jar", "shelf"].map(|ty| (Symbol::from(format!("{ty}_1")), Symbol::new(ty))).into();
    let mut state = |atoms: &String| {
        let atoms = atoms.split_whitespace().map(|text| GroundAtom::parse(text).expect("an atom")).collect();
        parser.parse_symbolic(&objects, &atoms, Unknown::default()).expect("a state")
    };
    let traces = steps.iter().enumerate().map(|(i, (action, states))| Trace {
        file: Some(Symbol::from(format!("{i}.jsonl"))),
        // The same step again is another trace.
        task: i.to_string(),
        states: states.iter().map(&mut state).collect(),
        actions: vec![action.clone()],
        ..Trace::default()
    });
    let traces = traces.collect();
    evidence_of(&Dataset::new(&parser, traces)).total().into_owned()
}

fn learned(evidence: &Observations) -> Learned {
    learn(&types(), evidence, &Options::default()).expect("a model")
}

fn names(learned: &Learned) -> Vec<&str> {
    learned.model.actions.iter().map(|action| action.name.as_str()).collect()
}

#[test]
fn a_slip_that_fells_a_cup_is_no_action_that_fells_cups() {
    let slip = not_executed("stands(cup_1)", "PICK(cup_1)", "fallen(cup_1)");
    let evidence = evidence(std::slice::from_ref(&slip));
    assert!(evidence.clusters.is_empty() && names(&learned(&evidence)).is_empty());
    let (key, seen) = evidence.negatives.first_key_value().expect("a failure");
    assert_eq!((key.action.as_str(), key.types.as_slice(), seen.count), ("PICK", [Symbol::new("cup")].as_slice(), 1));
    // What it left behind is counted, and can be seen.
    let (times, places) = &evidence.unexplained[&Unexplained::NotExecuted];
    assert_eq!((*times, places.first().expect("a place").file.as_str()), (1, "0.jsonl"));
    // The same without a word on whether it was executed is what the cup does when picked.
    let believed = (TraceAction { executed: None, ..slip.0 }, slip.1);
    assert_eq!(self::evidence(&[believed]).clusters.len(), 1);
}

#[test]
fn verdicts() {
    let seen = |executed, verdict| {
        let (action, states) = step("stands(cup_1)", "PICK(cup_1)", "held(cup_1)");
        let evidence = evidence(&[(TraceAction { executed, verdict: Some(verdict), ..action }, states)]);
        (evidence.clusters.len(), evidence.negatives.len(), evidence.unexplained.into_keys().next())
    };
    assert_eq!(seen(Some(false), Verdict::AsExpected), (1, 0, None), "the states are believed, not the flag");
    assert_eq!(seen(Some(true), Verdict::Otherwise), (1, 0, None));
    assert_eq!(seen(Some(true), Verdict::Nothing), (1, 0, None), "but something did change");
    assert_eq!(seen(None, Verdict::Refused), (0, 1, Some(Unexplained::NotExecuted)));
    assert_eq!(seen(Some(true), Verdict::TimedOut), (0, 0, Some(Unexplained::TimedOut)));
}

#[test]
fn a_failure_is_about_all_that_the_expected_action_is_about() {
    let (action, states) = not_executed("on(cup_1,shelf_1)", "PICK(cup_1)", "on(cup_1,shelf_1)");
    let args = vec![Symbol::new("cup_1"), Symbol::new("shelf_1")];
    let expected =
        Some(Expected { action: Symbol::new("PICK-vessel-shelf"), args, adds: Vec::new(), deletes: Vec::new() });
    let with = evidence(&[(TraceAction { expected, ..action.clone() }, states.clone())]);
    let (key, seen) = with.negatives.first_key_value().expect("a failure");
    let types: Vec<&str> = key.types.iter().map(Symbol::as_str).collect();
    assert_eq!((types, key.call.as_slice()), (vec!["cup", "shelf"], [0].as_slice()));
    assert_eq!(format!("{:?}", seen.states.counts().1), "{on(?0,?1): 1}", "the joint state before");
    let without = evidence(&[(action, states)]);
    assert_eq!(without.negatives.keys().next().expect("a failure").types, [Symbol::new("cup")]);
}

#[test]
fn a_failure_that_only_the_merged_action_allows_keeps_two_actions_apart() {
    let shown =
        |vessel: &str| step(&format!("dirty({vessel})"), &format!("WASH({vessel})"), &format!("clean({vessel})"));
    let (cup, mug) = (shown("cup_1"), shown("mug_1"));
    let jar = not_executed("dirty(jar_1)", "WASH(jar_1)", "dirty(jar_1)");
    let merged = learned(&evidence(&[cup.clone(), mug.clone()]));
    assert_eq!(names(&merged), ["WASH-vessel"]);
    let apart = learned(&evidence(&[cup.clone(), mug.clone(), jar]));
    assert_eq!(names(&apart), ["WASH-cup", "WASH-mug"]);
    assert_eq!((apart.report.refused, apart.report.failures), (RefusedMerges { pairs: 1, failures: 1 }, 1));
    assert_eq!(names(&learned(&evidence(&[cup.clone(), mug.clone()]))), names(&merged), "taken out again, they merge");

    // What the merged action does not allow either says nothing: washing what is not dirty, or what is clean already, or
    // another action.
    for failed in [
        not_executed("", "WASH(jar_1)", ""),
        not_executed("dirty(jar_1) clean(jar_1)", "WASH(jar_1)", "dirty(jar_1) clean(jar_1)"),
        not_executed("dirty(shelf_1)", "WASH(shelf_1)", "dirty(shelf_1)"),
        not_executed("dirty(jar_1)", "WIPE(jar_1)", "dirty(jar_1)"),
    ] {
        assert_eq!(names(&learned(&evidence(&[cup.clone(), mug.clone(), failed]))), names(&merged));
    }
}

#[test]
fn what_is_seen_often_enough_outweighs_a_failure() {
    // 9/10 of what the merged action claims is right, where one of the two alone is right 4 times of 5.
    let shown =
        |vessel: &str| step(&format!("dirty({vessel})"), &format!("WASH({vessel})"), &format!("clean({vessel})"));
    let mut steps = vec![shown("cup_1"); 4];
    steps.push(not_executed("dirty(cup_1)", "WASH(cup_1)", "dirty(cup_1)"));
    steps.extend(vec![shown("mug_1"); 4]);
    // (4/5 + 4/4)/2 = 9/10 > 8/9: the union is worse.
    assert_eq!(names(&learned(&evidence(&steps))), ["WASH-cup", "WASH-mug"]);
    steps.push(shown("mug_1"));
    // 9/10 = (4/5 + 5/5)/2: it is as good.
    assert_eq!(names(&learned(&evidence(&steps))), ["WASH-vessel"]);
}

#[test]
fn an_action_about_more_than_a_failure_tells_is_not_held_against_it() {
    let shown = |vessel: &str| {
        step(&format!("on({vessel},shelf_1)"), &format!("TAKE({vessel})"), &format!("off({vessel}) lit(shelf_1)"))
    };
    let (cup, mug) = (shown("cup_1"), shown("mug_1"));
    let (action, states) = not_executed("on(jar_1,shelf_1)", "TAKE(jar_1)", "on(jar_1,shelf_1)");
    let unexplained = evidence(&[cup.clone(), mug.clone(), (action.clone(), states.clone())]);
    assert_eq!(names(&learned(&unexplained)), ["TAKE-vessel-shelf"], "nothing tells what the jar stood on");
    let args = vec![Symbol::new("jar_1"), Symbol::new("shelf_1")];
    let expected =
        Some(Expected { action: Symbol::new("TAKE-vessel-shelf"), args, adds: Vec::new(), deletes: Vec::new() });
    let told = evidence(&[cup, mug, (TraceAction { expected, ..action }, states)]);
    assert_eq!(names(&learned(&told)), ["TAKE-cup-shelf", "TAKE-mug-shelf"]);
}
