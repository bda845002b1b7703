//! The hierarchy, growth, and the page that everything comes together on.

use std::fs;

use serde_json::Value;

use crate::common::{Folder, names};

#[test]
fn the_hierarchy() {
    let folder = Folder::new();
    let ended = folder.run("lab hierarchy -o deep/H");
    ended.succeeds();
    insta::assert_snapshot!("lab-hierarchy", format!("{ended}"));
    let files = ["hierarchy.csv", "hierarchy.json", "hierarchy.svg", "parameters.csv", "tree.svg"];
    assert_eq!(names(&folder.path("deep/H")), files);
    assert_eq!(folder.run("lab hierarchy -o deep/H --json -q").out, folder.read("deep/H/hierarchy.json"));
}

#[test]
fn quick_growth() {
    let folder = Folder::new();
    let ended = folder.run("lab growth --quick -o G");
    ended.succeeds();
    assert!(ended.err.starts_with("10 runs\nwrote growth.csv,"), "{ended}");
    let growth = folder.json("G/growth.json");
    let points = growth["points"].as_array().expect("points");
    assert_eq!(points.len(), 10);
    for point in points {
        assert_eq!(point["end"], "finished", "{point}");
        assert!(point["seconds"].as_f64() > Some(0.0) && point["peak_bytes"].as_u64() > Some(1 << 20), "{point}");
    }
    let fits = growth["fits"].as_array().expect("fits");
    let fitted = |series: &str, quantity: &str| -> f64 {
        let fit = fits.iter().find(|fit| fit["series"] == series && fit["quantity"] == quantity);
        fit.and_then(|fit| fit["exponent"].as_f64()).expect(quantity)
    };
    // What is counted is the same on every machine: 100 objects are planned with hardly more than 64.
    let ground = fitted("storeroom", "ground_actions");
    assert!((0.5..1.2).contains(&ground), "{ground}");
    assert!(fitted("goals", "ground_actions").abs() < 1e-9);
    let plot = folder.read("G/growth_objects_ground.svg");
    assert!(plot.contains("larger storeroom: ∝ n^"), "{plot}");
    // Nothing is measured twice.
    let log = folder.read("G/runs.jsonl");
    assert!(folder.run("lab growth --quick -o G").err.starts_with("0 runs, 10 were finished before\n"));
    assert_eq!(folder.read("G/runs.jsonl"), log);
    folder.refuses(31, "lab growth --quick --time-limit 5s -o G");
}

#[test]
fn growth_that_is_cut_says_where() {
    let folder = Folder::new();
    folder.run("lab growth --quick --time-limit 0s -o G -q").succeeds();
    let growth = folder.json("G/growth.json");
    let points = growth["points"].as_array().expect("points");
    assert!(points.iter().all(|point| point["end"] == "out_of_time"), "{growth}");
    assert_eq!(growth["fits"], Value::Array(Vec::new()));
    assert!(folder.read("G/growth_transitions_time.svg").contains("random play, cut at 100"));
}

#[test]
fn a_quick_report_runs_what_is_missing_and_stands_alone() {
    let folder = Folder::new();
    let empty = folder.run("lab report -o R");
    empty.succeeds();
    assert!(empty.err.contains("not run yet: `typelift lab growth -o R/growth`"), "{empty}");
    assert!(empty.out.ends_with("None of the claims was measured.\n"), "{empty}");
    assert!(folder.read("R/report.html").contains("<code>typelift lab table -o R/table</code>"));
    folder.run("lab hierarchy -q -o R").succeeds();

    let ended = folder.run("lab report --quick -o R");
    ended.succeeds();
    let page = folder.read("R/report.html");
    assert_eq!(names(&folder.path("R/growth")).len(), 14);
    assert!(!folder.path("R/hierarchy").exists(), "what is there is not run again");
    assert!(!page.contains("class=\"missing\"") && page.contains("68</td>"), "{page}");
    assert!(ended.out.contains("held          13 generalized actions are learned from them.\n"), "{ended}");
    // A panel for each variant, the matrix, the tree, and the plots of growth.
    assert_eq!(page.matches("<svg").count(), 4 + 2 + 10);
    let judged: Value = serde_json::from_str(&folder.run("lab report --json -o R").out).expect("JSON");
    let measured = judged.as_array().expect("claims").iter().filter(|claim| claim["finding"]["held"] == true);
    let last = format!("{} of ", measured.count());
    assert!(ended.out.lines().last().is_some_and(|line| line.starts_with(&last)), "{ended}");
    let again = folder.run("lab report --quick -o R");
    assert_eq!((again.out, folder.read("R/report.html")), (ended.out, page), "from the same results the same page");
}

#[test]
fn a_folder_that_cannot_be_written_to_and_a_file_that_is_something_else() {
    let folder = Folder::new();
    folder.write("file", "something");
    for command in ["hierarchy", "report", "growth --quick"] {
        let ended = folder.refuses(31, &format!("lab {command} -o file"));
        assert!(ended.err.starts_with("error: file"), "{ended}");
        folder.refuses(31, &format!("lab {command} -o file/below"));
    }
    fs::create_dir(folder.path("R")).expect("made");
    folder.write("R/growth.json", "{\"points\": 3}");
    let ended = folder.refuses(31, "lab report -o R");
    assert!(ended.err.contains("growth.json: this is not what the experiment writes"), "{ended}");
    assert!(ended.err.contains("hint: The experiment writes it anew"), "{ended}");
    assert_eq!(names(&folder.path("R")), ["growth.json"]);
}
