//! How much every strategy searches on some twenty tasks, to the last node, and what its plans cost.
//!
//! Nothing here says that a number is good. But what makes the planner fast (estimates, preferred actions, orders of
//! landmarks, symmetries, mutex groups) leaves every plan a plan when it breaks, and only these numbers show it. A reader who
//! means to change how much is searched accepts the new numbers with `INSTA_UPDATE=always` and reads the difference.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use typelift::agent::{self, propose};
use typelift::imagine;
use typelift::model::{ActionModel, Budget, Task};
use typelift::plan::{Options, Outcome, Planner, Report, Restrictions, Strategy};
use typelift::world::DomainFile;
use typelift_kitchen::tasks;
use typelift_tests::{kitchen_model, planning_task};

/// So many expansions a first plan may take: with LAMA's searches enough for each of them to have its turn.
fn for_the_first(strategy: Strategy) -> Budget {
    Budget::with_expansions(match strategy {
        Strategy::OrderedFirst | Strategy::OrderedLandmarks | Strategy::AStarLmCut | Strategy::AStarBlind => 400,
        Strategy::LazyFf | Strategy::LazyLandmarks | Strategy::Bfws => 1_000,
        Strategy::LamaPortfolio => 6_000,
    })
}

/// So many expansions a further plan may take.
const FOR_ANOTHER: u64 = 400;

/// So many different plans are asked for, and so many cheaper ones.
const PLANS: usize = 3;

fn planner(model: &ActionModel, task: &Task, strategy: Strategy) -> Planner {
    let options = Options { strategy, ..Options::default() };
    Planner::new(model, task, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits")
}

/// The plans that a planner is asked for, one after the other: the cost and length of each, or why there is none.
fn answers(mut ask: impl FnMut(Option<u64>) -> Outcome) -> String {
    let (mut answers, mut cost) = (Vec::new(), None);
    for _ in 0..PLANS {
        match ask(cost) {
            Outcome::Solved(plan) => {
                answers.push(format!("{}/{}", plan.cost(), plan.len()));
                cost = Some(plan.cost());
            }
            Outcome::Unsolvable => return "unsolvable".to_owned(),
            Outcome::NoMorePlans => {
                answers.push("end".to_owned());
                break;
            }
            _ => {
                answers.push("…".to_owned());
                break;
            }
        }
    }
    answers.join(" ")
}

fn counted(report: &Report) -> String {
    format!("{} {} {}", report.expansions, report.evaluations, report.reopened)
}

/// A line a strategy, of three searches: for the first plan, for cheaper and cheaper ones, and for different ones.
fn table(model: &ActionModel, task: &Task) -> String {
    let further = Budget::with_expansions(FOR_ANOTHER);
    let first_row = ["strategy", "cheaper and cheaper", "first", "all", "different", "all"].map(str::to_owned);
    let mut rows = vec![first_row];
    for strategy in Strategy::ALL {
        let budget = for_the_first(strategy);
        let mut asked = planner(model, task, strategy);
        let mut first = None;
        let cheaper = answers(|cost| {
            let outcome = match cost {
                None => asked.next_plan(&budget),
                Some(cost) => asked.better_plan(cost, &further),
            };
            first.get_or_insert_with(|| counted(&asked.report()));
            outcome
        });
        let mut several = planner(model, task, strategy);
        let different = answers(|cost| several.next_plan(if cost.is_none() { &budget } else { &further }));
        rows.push([
            strategy.to_string(),
            cheaper,
            first.unwrap_or_default(),
            counted(&asked.report()),
            different,
            counted(&several.report()),
        ]);
    }
    aligned(&rows)
}

fn aligned(rows: &[[String; 6]]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or_default();
    let widths: Vec<usize> = (0..6).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let cells: Vec<String> = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}")).collect();
        let _ = writeln!(text, "{}", cells.join(" │ ").trim_end());
    }
    text
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn compiled(folder: &Path) -> (ActionModel, Task) {
    let path = folder.join("domain.pddl");
    let domain = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let domain = DomainFile::from_text(&path, domain).unwrap_or_else(|e| panic!("{}", e.render()));
    domain.read_problem(&folder.join("problem.pddl")).unwrap_or_else(|e| panic!("{}", e.render()))
}

fn tables<'a>(tasks: impl IntoIterator<Item = (&'a str, ActionModel, Task)>) -> String {
    let tables = tasks.into_iter().map(|(name, model, task)| format!("{name}\n{}", table(&model, &task)));
    tables.collect::<Vec<_>>().join("\n")
}

#[test]
fn on_classical_problems() {
    let names = [
        "blocks",
        "boxes",
        "more-boxes",
        "gripper",
        "keys",
        "logistics",
        "parking",
        "sandwiches",
        "satellites",
        "transport",
    ];
    let tables = tables(names.map(|name| {
        let (model, task) = compiled(&folder("classical").join(name));
        (name, model, task)
    }));
    insta::assert_snapshot!(tables);
}

#[test]
fn on_problems_in_adl() {
    let names = ["costs", "nested-effects", "stratified-negation", "transitive-closure", "universal-effect", "swap"];
    let tables = tables(names.map(|name| {
        let (model, task) = compiled(&folder("pddl").join(name));
        (name, model, task)
    }));
    insta::assert_snapshot!(tables);
}

#[test]
fn on_tasks_of_the_kitchen() {
    let model = kitchen_model(false);
    let options = agent::Options { imagine: Some(imagine::Options::default()), ..agent::Options::default() };
    let names = ["T1.1", "T1.3", "T2.2", "T3.1", "T4.3", "T6.4"];
    let tasks = tasks();
    let tables = tables(names.map(|name| {
        let task = tasks.iter().find(|task| task.name == name).unwrap_or_else(|| panic!("no task {name}"));
        let asked = planning_task(&model, task, 0);
        let nothing = Restrictions::default();
        let proposal = propose(&model, &asked, &nothing, &options, &Budget::unlimited()).expect("a plan");
        (name, typelift::model::ActionModel::clone(&proposal.model), asked)
    }));
    insta::assert_snapshot!(tables);
}
