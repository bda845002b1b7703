//! The report: claims are judged by the results, what is missing is said, and the page stands alone.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use typelift_lab::TypeHierarchy;
use typelift_lab::report::{EXPERIMENTS, Environment, Finding, Results, claims, judge, report_page};

const VARIANTS: [&str; 4] = ["generalized+imagined", "generalized", "individual+imagined", "individual"];

/// The published table as if it had been measured, with one number changed.
fn table(change: impl Fn(&str, &str) -> Option<Value>) -> Value {
    let published = typelift_lab::published();
    let mut cells = Vec::new();
    for task in typelift_kitchen::tasks() {
        for variant in typelift_lab::Variant::ALL {
            let paper = published.table.cell(&task.name, variant);
            let paper_json = paper.map(|p| {
                json!({"proposals": p.proposals, "plan_length": p.plan_length, "seconds_mean": p.seconds_mean, "seconds_sd": 0.1})
            });
            let solved = if paper.is_some() { 5 } else { 0 };
            let ground = if variant.individual() { 30.0 } else { 150.0 };
            let mut cell = json!({
                "task": task.name, "variant": variant, "runs": 5, "solved": solved,
                "proposals": paper.map(|p| p.proposals), "plan_length": paper.map(|p| p.plan_length),
                "seconds_mean": paper.map(|p| p.seconds_mean), "ground_actions": ground, "paper": paper_json,
            });
            if let Some(Value::Object(changed)) = change(&task.name, variant.name()) {
                for (key, value) in changed {
                    cell[key] = value;
                }
            }
            cells.push(cell);
        }
    }
    let learned = |name: &str| if name.starts_with("individual") { 39 } else { 13 };
    let actions: Vec<Value> = VARIANTS.iter().map(|name| json!({"variant": name, "learned": learned(name)})).collect();
    json!({"runs": 5, "seed": 0, "transitions": 68, "actions": actions, "cells": cells})
}

fn demonstrations(medians: [u64; 7]) -> Value {
    let sizes: Vec<Value> = (2_u64..)
        .zip(medians)
        .map(|(size, median)| {
            let solved = vec![median; 3];
            json!({"demonstrations": size, "solved": solved, "solved_min": median, "solved_median": median,
                   "solved_max": median, "complete": if median == 24 { 3 } else { 0 }})
        })
        .collect();
    json!({"seed": 0, "tasks": 24, "demonstrations": [], "variants": [{"variant": VARIANTS[0], "sizes": sizes}]})
}

fn faults() -> Value {
    let row = |name: &str, broken: &[&str], restart: bool, solved: u64| {
        json!({"scenario": name, "broken": broken, "possible": true, "restart": restart, "solved": solved,
               "proposals": 2.0, "plan_length": 5.0, "excluded": ["cutboard_1"], "repeated_mistakes": 0})
    };
    let rows = [
        row("cutboard: cut", &["cutboard_1"], true, 5),
        row("cutboard: cut", &["cutboard_1"], false, 3),
        row("coconut", &[], true, 4),
    ];
    json!({"runs": 5, "seed": 0, "summary": "A <summary>.", "scenarios": rows})
}

fn write(folder: &Path, name: &str, value: &Value) {
    fs::write(folder.join(name), value.to_string()).expect("written");
}

/// What is said of a claim.
fn finding(results: &Results, id: &str) -> Option<Finding> {
    let judged = judge(results);
    judged.into_iter().find(|judged| judged.claim.id == id).expect("a claim").finding
}

fn held(results: &Results, id: &str) -> Option<bool> {
    finding(results, id).map(|finding| finding.held)
}

fn environment() -> Environment {
    let text = |text: &str| text.to_owned();
    Environment { version: text("1.2.3"), commit: Some(text("abc")), cpu: text("A CPU <1>"), system: text("linux") }
}

#[test]
fn the_published_numbers_make_every_claim_hold() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "table.json", &table(|_, _| None));
    write(folder.path(), "demonstrations.json", &demonstrations([3, 5, 6, 24, 24, 24, 24]));
    TypeHierarchy::of_the_kitchen().write(folder.path()).expect("written");
    let results = Results::read(folder.path()).expect("read");
    assert_eq!(results.missing(), ["faults", "growth", "lifelong"]);
    for claim in claims() {
        let expected = if ["broken", "exception", "repeat"].contains(&claim.id.as_str()) { None } else { Some(true) };
        assert_eq!(held(&results, &claim.id), expected, "{}: {:?}", claim.id, finding(&results, &claim.id));
    }
}

#[test]
fn a_number_that_differs_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let shorter = |task: &str, variant: &str| {
        (task == "T2.4" && variant == "individual").then(|| json!({"plan_length": 13, "seconds_mean": 9.0}))
    };
    write(folder.path(), "table.json", &table(shorter));
    write(folder.path(), "demonstrations.json", &demonstrations([3, 5, 16, 20, 24, 23, 24]));
    write(folder.path(), "faults.json", &faults());
    let results = Results::read(folder.path()).expect("read");
    let numbers = finding(&results, "numbers").expect("measured");
    assert_eq!((numbers.ours.as_str(), numbers.held), ("95 of 96", false));
    let longer = finding(&results, "s2-longer").expect("measured");
    assert_eq!((longer.ours.as_str(), longer.held), ("8 to 5, 13 to 13 steps", false));
    let jump = finding(&results, "jump").expect("measured");
    assert_eq!((jump.ours.as_str(), jump.held), ("from 3 to 4: 5 to 16", false));
    for (id, expected) in [("cells", true), ("more-demonstrations", false), ("complete", false)] {
        assert_eq!(held(&results, id), Some(expected), "{id}");
    }
    for (id, expected) in [("broken", true), ("exception", false), ("repeat", true)] {
        assert_eq!(held(&results, id), Some(expected), "{id}");
    }
}

#[test]
fn a_quick_table_judges_no_set_of_tasks() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut quick = table(|_, _| None);
    quick["cells"].as_array_mut().expect("cells").truncate(8);
    write(folder.path(), "table.json", &quick);
    let results = Results::read(folder.path()).expect("read");
    assert_eq!(held(&results, "transitions"), Some(true));
    for id in ["cells", "all", "s1-all", "s6"] {
        assert_eq!(held(&results, id), None, "{id}");
    }
}

#[test]
fn what_is_missing_is_said_with_the_command() {
    let page = report_page(&Results::default(), &environment(), "my <results>");
    for (experiment, _) in EXPERIMENTS {
        assert!(
            page.contains(&format!("typelift lab {experiment} -o my &lt;results&gt;/{experiment}")),
            "{experiment}"
        );
    }
    assert!(page.contains("0 of 0 claims that were measured held; 0 of 28 were"), "{page}");
}

#[test]
fn the_page_stands_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("table")).expect("made");
    write(&folder.path().join("table"), "table.json", &table(|_, _| None));
    write(folder.path(), "demonstrations.json", &demonstrations([3, 5, 6, 24, 24, 24, 24]));
    write(folder.path(), "faults.json", &faults());
    TypeHierarchy::of_the_kitchen().write(folder.path()).expect("written");
    let results = Results::read(folder.path()).expect("read");
    let page = report_page(&results, &environment(), "results");
    assert_eq!(page, report_page(&results, &environment(), "results"));
    for outside in ["src=", "@import", "url(", "<script", "<link"] {
        assert!(!page.contains(outside), "{outside}");
    }
    let links = page.match_indices("href=\"").map(|(at, _)| &page[at + 6..at + 7]);
    assert!(links.into_iter().all(|first| first == "#"), "links stay on the page");
    assert_eq!(page.matches("<style>").count(), 1, "figures share the page's style");
    assert_eq!(page.matches("<svg").count(), 3);
    assert!(page.contains("A CPU &lt;1&gt;") && page.contains("A &lt;summary&gt;."));
    assert!(page.contains("table 0 to 4; demonstrations 0; faults 0 to 4"));
    assert_eq!(page.matches("<section").count(), page.matches("</section>").count());
    assert!(page.contains("3 of 5") || page.contains("T1.1"));
}

#[test]
fn a_file_that_is_something_else_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("table.json"), "{\"runs\": 5").expect("written");
    let error = Results::read(folder.path()).expect_err("no table").to_string();
    assert!(error.contains("table.json") && error.contains("not what the experiment writes"), "{error}");
}
