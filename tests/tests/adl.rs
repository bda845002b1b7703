//! Small problems in the whole of ADL, `tests/pddl`: solved exactly if they have a plan, as cheaply as Fast Downward
//! solves them and as was found by hand, and each plan is judged as a plan file is.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use typelift::agent::{Options, propose};
use typelift::check::validate;
use typelift::model::{ActionModel, Budget, GroundCall, Plan, Task};
use typelift::plan::{self, Outcome, Restrictions, Strategy};
use typelift::world::DomainFile;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("pddl")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// What Fast Downward finds, by folder; `None` where there is no plan.
fn expected() -> BTreeMap<String, Option<u64>> {
    let text = read(&root().join("expected.txt"));
    let lines = text.lines().map(|line| {
        let (name, cost) = line.split_once(' ').expect("a name and a cost");
        let cost = (cost != "unsolvable").then(|| cost.parse().expect("a cost"));
        (name.to_owned(), cost)
    });
    lines.collect()
}

/// What the first line of a problem says.
fn by_hand(problem: &Path) -> Option<u64> {
    let text = read(problem);
    let line = text.lines().next().unwrap_or_default();
    if line == "; unsolvable" {
        return None;
    }
    let cost = line.strip_prefix("; cost ").and_then(|rest| rest.split(':').next());
    Some(cost.and_then(|cost| cost.parse().ok()).unwrap_or_else(|| panic!("no cost: {line}")))
}

fn compiled(folder: &Path, domain: &str) -> (ActionModel, Task) {
    let path = folder.join(domain);
    let domain = DomainFile::from_text(&path, read(&path)).unwrap_or_else(|e| panic!("{}", e.render()));
    domain.read_problem(&folder.join("problem.pddl")).unwrap_or_else(|e| panic!("{}", e.render()))
}

/// All plans up to a cheapest, dearest first, that a strategy finds.
fn cheaper_and_cheaper(model: &ActionModel, task: &Task, strategy: Strategy) -> Vec<Plan> {
    let budget = Budget::with_expansions(1_000_000);
    let options = Options { plan: plan::Options { strategy, ..Default::default() }, ..Options::default() };
    let proposal = propose(model, task, &Restrictions::default(), &options, &budget);
    let mut proposal = proposal.expect("a plan that checks out");
    let mut plans: Vec<Plan> = Vec::new();
    let mut outcome = proposal.outcome.clone();
    while let Outcome::Solved(plan) = outcome {
        outcome = proposal.better_plan(plan.cost(), &budget).expect("a plan that checks out");
        plans.push(plan);
    }
    assert!(matches!(outcome, Outcome::Unsolvable | Outcome::NoMorePlans), "{outcome:?}");
    plans
}

fn lines(plan: &Plan) -> Vec<GroundCall> {
    plan.steps.iter().map(|step| step.call.clone()).collect()
}

/// A cheapest plan needs each step that costs something.
fn assert_needs_every_step(name: &str, model: &ActionModel, task: &Task, cheapest: &Plan) {
    for (i, step) in cheapest.steps.iter().enumerate().filter(|(_, step)| step.cost > 0) {
        let mut without = lines(cheapest);
        without.remove(i);
        assert!(validate(model, task, &without).is_err(), "{name}: valid without {}", step.call);
    }
}

#[test]
fn the_cheapest_plans_cost_what_others_say() {
    for strategy in Strategy::ALL {
        assert_eq!(cheapest_plans(strategy), expected(), "{strategy}");
    }
}

/// What the cheapest plans cost that a strategy finds.
fn cheapest_plans(strategy: Strategy) -> BTreeMap<String, Option<u64>> {
    let mut found = BTreeMap::new();
    for (name, expected) in expected() {
        let folder = root().join(&name);
        assert_eq!(by_hand(&folder.join("problem.pddl")), expected, "{name}: by hand, by Fast Downward");
        let (model, task) = compiled(&folder, "domain.pddl");
        let plans = cheaper_and_cheaper(&model, &task, strategy);
        assert!(!strategy.is_optimal() || plans.len() < 2, "{name}, {strategy}: {} plans", plans.len());
        for plan in &plans {
            let valid = validate(&model, &task, &lines(plan)).unwrap_or_else(|(_, e)| panic!("{name}: {e}"));
            assert_eq!(valid.plan.cost(), plan.cost(), "{name}");
        }
        if let Some(cheapest) = plans.last() {
            assert_needs_every_step(&name, &model, &task, cheapest);
        }
        found.insert(name, plans.last().map(Plan::cost));
    }
    found
}

#[test]
fn every_folder_has_its_line() {
    let folders = fs::read_dir(root()).expect("the folder").map(|entry| entry.expect("an entry").path());
    let mut names: Vec<String> = folders
        .filter(|path| path.is_dir())
        .map(|path| path.file_name().expect("a name").to_string_lossy().into())
        .collect();
    names.sort();
    assert_eq!(names, expected().into_keys().collect::<Vec<_>>());
}

#[test]
fn what_is_said_in_other_words_is_the_same() {
    for name in ["either", "nested-effects", "several-parents"] {
        let folder = root().join(name);
        let costs = ["domain.pddl", "equivalent.pddl"].map(|domain| {
            let (model, task) = compiled(&folder, domain);
            cheaper_and_cheaper(&model, &task, Strategy::default()).last().map(Plan::cost)
        });
        assert_eq!(costs[0], costs[1], "{name}");
    }
}
