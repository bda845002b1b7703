//! The paper's Table I: 24 tasks, four variants, executed in the simulator.
//!
//! Every cell is held: solved or not against the published table; the length of the plan; the number of proposals
//! exactly where the paper's is reproduced. Where it is not (`individual+imagined` on four tasks, which depends on
//! ties and rooms that the paper does not state) our own number is held, and the published one stands beside it.
//!
//! `cargo test --release -p typelift-tests --test table -- --nocapture` prints the table, over 5 seeds.

use std::fs;
use std::path::Path;

use typelift::agent::{Ending, Options};
use typelift::imagine::{self, Guard};
use typelift::model::{ActionModel, Budget};
use typelift::plan::TieOrder;
use typelift_kitchen::{KitchenTask, tasks};
use typelift_tests::{VARIANTS, kitchen_model, paper_options, solve};

/// `#p` and `|p|`; `None` where no plan was found.
type Cell = Option<(u64, usize)>;

const fn cell(proposals: u64, length: usize) -> Cell {
    Some((proposals, length))
}

/// The published table: task, then generalized+imagined, generalized, individual+imagined, individual.
const PUBLISHED: [(&str, [Cell; 4]); 24] = [
    ("T1.1", [cell(1, 5), cell(1, 5), cell(1, 5), cell(1, 5)]),
    ("T1.2", [cell(1, 5), cell(1, 5), cell(1, 5), cell(1, 5)]),
    ("T1.3", [cell(1, 15), cell(1, 15), cell(1, 15), cell(1, 15)]),
    ("T1.4", [cell(1, 10), cell(1, 10), cell(1, 10), cell(1, 10)]),
    ("T2.1", [cell(1, 5), cell(1, 5), cell(1, 8), cell(1, 8)]),
    ("T2.2", [cell(1, 10), cell(1, 10), None, None]),
    ("T2.3", [cell(1, 13), cell(1, 13), None, None]),
    ("T2.4", [cell(1, 13), cell(1, 13), cell(1, 16), cell(1, 16)]),
    ("T3.1", [cell(1, 15), cell(1, 15), None, None]),
    ("T3.2", [cell(1, 18), cell(1, 18), None, None]),
    ("T3.3", [cell(1, 25), cell(1, 25), None, None]),
    ("T3.4", [cell(1, 30), cell(1, 30), None, None]),
    ("T4.1", [cell(1, 5), None, cell(1, 5), None]),
    ("T4.2", [cell(1, 10), None, cell(1, 10), None]),
    ("T4.3", [cell(1, 13), None, cell(8, 15), None]),
    ("T4.4", [cell(1, 16), None, None, None]),
    ("T5.1", [cell(1, 5), cell(1, 5), cell(2, 5), None]),
    ("T5.2", [cell(1, 10), cell(1, 10), cell(2, 10), None]),
    ("T5.3", [cell(1, 10), cell(1, 10), cell(9, 10), None]),
    ("T5.4", [cell(1, 13), cell(1, 13), cell(9, 15), None]),
    ("T6.1", [cell(1, 18), None, None, None]),
    ("T6.2", [cell(1, 23), None, None, None]),
    ("T6.3", [cell(1, 28), None, None, None]),
    ("T6.4", [cell(1, 36), None, None, None]),
];

/// Where ours differs from the published cell: task, variant, ours.
const DIFFERENCES: [(&str, usize, Cell); 6] = [
    // With the published 15 of T1.3 no order of ties gives 16 here: both tasks have the same landmarks.
    ("T2.4", 2, cell(1, 15)),
    ("T2.4", 3, cell(1, 15)),
    // Proposals of individual+imagined depend on unpublished ties and rooms.
    ("T4.3", 2, cell(2, 15)),
    ("T5.1", 2, cell(1, 5)),
    ("T5.3", 2, cell(2, 10)),
    ("T5.4", 2, cell(2, 15)),
];

const SEEDS: u64 = 5;
const EXPANSIONS: u64 = 200_000;

fn run(model: &ActionModel, task: &KitchenTask, seed: u64, options: &Options) -> (Cell, Ending) {
    let account = solve(model, task, seed, options, &Budget::with_expansions(EXPANSIONS));
    let length = account.plan.as_ref().filter(|_| account.solved()).map(typelift::model::Plan::len);
    (length.map(|length| (account.proposals, length)), account.ending)
}

fn written(cell: Cell) -> String {
    cell.map_or("-".to_owned(), |(proposals, length)| format!("{proposals}/{length}"))
}

#[test]
fn every_cell() {
    let models = [kitchen_model(false), kitchen_model(true)];
    assert_eq!(models.each_ref().map(|model| model.actions.len()), [13, 39]);
    // Unoptimised, the searches that end only at the limit of expansions would take minutes.
    let seeds = if cfg!(debug_assertions) { 1 } else { SEEDS };
    let mut equal = 0;
    let mut table = format!("| task | {} |\n|---|---|---|---|---|\n", VARIANTS.map(|(name, _, _)| name).join(" | "));
    for (task, (name, published)) in tasks().iter().zip(PUBLISHED) {
        assert_eq!(task.name, name);
        let mut line = format!("| {name} |");
        for (variant, (_, individual, imagine)) in VARIANTS.into_iter().enumerate() {
            let difference = DIFFERENCES.iter().find(|(task, v, _)| (*task, *v) == (name, variant));
            let expected = difference.map_or(published[variant], |(_, _, ours)| *ours);
            for seed in 0..seeds {
                let (found, ending) = run(&models[usize::from(individual)], task, seed, &paper_options(imagine));
                assert_eq!(found, expected, "{name}, variant {variant}, seed {seed}: {ending:?}");
            }
            equal += usize::from(expected == published[variant]);
            assert_eq!(expected.is_some(), published[variant].is_some(), "{name}, variant {variant}");
            let beside = difference.map(|_| format!(" ({})", written(published[variant]))).unwrap_or_default();
            line += &format!(" {}{beside} |", written(expected));
        }
        table += &line;
        table.push('\n');
    }
    assert_eq!(equal, 96 - DIFFERENCES.len());
    table += &format!("\n{equal} of 96 cells equal in #p and |p|, 96 of 96 in solved or not.\n");
    println!("{seeds} seeds\n{table}");
    hold_document(&table);
}

/// The table in `docs/reproduction.md` is the one that was just computed; `UPDATE_DOCS=1` writes it there.
fn hold_document(table: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/reproduction.md");
    let text = fs::read_to_string(&path).expect("the document");
    let (before, rest) = text.split_once("<!-- table -->\n").expect("a place for the table");
    let (_, after) = rest.split_once("<!-- /table -->").expect("the table's end");
    let right = format!("{before}<!-- table -->\n{table}<!-- /table -->{after}");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        fs::write(&path, right).expect("the document is written");
    } else {
        assert!(text == right, "docs/reproduction.md shows another table: UPDATE_DOCS=1 writes this one:\n{table}");
    }
}

/// What becomes of the table when a rule that the paper leaves open is switched off: the rule matters, and it is the
/// rule that matters. The variant `individual+imagined` is compared on the tasks that it solves.
#[test]
fn rules_switched_off() {
    let models = [kitchen_model(false), kitchen_model(true)];
    let tasks = tasks();
    let changed = |options: &dyn Fn(bool) -> Options| {
        let mut cells = Vec::new();
        for (task, (name, published)) in tasks.iter().zip(PUBLISHED) {
            for (variant, (label, individual, imagine)) in VARIANTS.into_iter().enumerate() {
                let difference = DIFFERENCES.iter().find(|(task, v, _)| (*task, *v) == (name, variant));
                let usual = difference.map_or(published[variant], |(_, _, ours)| *ours);
                // The searches that end only at the limit are slow, and their cells are the same by being unsolved.
                if variant == 2 && (usual.is_none() || name == "T4.3" || name == "T5.4") {
                    continue;
                }
                let (found, _) = run(&models[usize::from(individual)], task, 0, &options(imagine));
                if found != usual {
                    cells.push(format!("{name} {label} {} for {}", written(found), written(usual)));
                }
            }
        }
        cells
    };
    let with_order = |tie_order| {
        move |imagine| Options {
            plan: typelift::plan::Options { tie_order, ..Default::default() },
            ..paper_options(imagine)
        }
    };
    let with_guard = |guard| {
        move |imagine: bool| Options {
            imagine: imagine.then_some(imagine::Options { guard }),
            ..paper_options(imagine)
        }
    };
    let plain = |tie_order| move |imagine| Options { strict: false, ..with_order(tie_order)(imagine) };
    // Each rule with the number of cells that change without it.
    let experiments: [(&str, usize, Vec<String>); 8] = [
        ("successors by name alone", 0, changed(&with_order(TieOrder::Name))),
        ("general actions first", 3, changed(&with_order(TieOrder::GeneralFirst))),
        ("guard for any two parameters", 2, changed(&with_guard(Guard::Parameters))),
        ("guard by topmost types", 0, changed(&with_guard(Guard::TopTypes))),
        ("guard off", 4, changed(&with_guard(Guard::Off))),
        ("not strict", 1, changed(&plain(TieOrder::SpecificFirst))),
        ("not strict, successors by name alone", 38, changed(&plain(TieOrder::Name))),
        ("not strict, general actions first", 39, changed(&plain(TieOrder::GeneralFirst))),
    ];
    for (rule, expected, cells) in &experiments {
        println!("{rule}: {} cells change", cells.len());
        for cell in cells {
            println!("  {cell}");
        }
        assert_eq!(cells.len(), *expected, "{rule}");
    }
}
