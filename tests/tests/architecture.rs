//! The house rules that a compiler does not hold: who may import whom, and what is deliberately absent.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use typelift_tests::source::{Code, Imports, source_files};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the workspace")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Each crate with the crates of ours that it may depend on.
const ALLOWED: [(&str, &[&str]); 16] = [
    ("model", &[]),
    ("belief", &["model"]),
    ("pddl", &["model"]),
    ("world", &["model", "pddl"]),
    ("learn", &["model", "world"]),
    ("plan", &["model"]),
    ("imagine", &["model", "plan"]),
    ("check", &["model", "pddl"]),
    ("agent", &["model", "belief", "world", "plan", "imagine", "check"]),
    ("words", &["model", "belief", "world", "plan", "agent"]),
    ("bridge", &["model", "pddl", "world", "plan"]),
    ("memory", &["model", "world", "learn"]),
    ("kitchen", &["model", "world"]),
    (
        "typelift",
        &["model", "belief", "pddl", "world", "learn", "plan", "imagine", "check", "agent", "words", "bridge"],
    ),
    ("lab", &["typelift", "kitchen"]),
    ("cli", &["typelift", "memory", "kitchen", "lab"]),
];

/// What its tests may depend on besides: the judge of plans is no part of the planner, and judges its tests.
const ALLOWED_IN_TESTS: [(&str, &[&str]); 1] = [("plan", &["check"])];

/// Our crates in the sections of a manifest that are called so, for all platforms or for one.
fn dependencies(manifest: &str, called: &str) -> Vec<String> {
    let mut section = "";
    let mut found = Vec::new();
    for line in manifest.lines() {
        if let Some(header) = line.trim().strip_prefix('[') {
            section = header.trim_end_matches(']').rsplit('.').next().unwrap_or_default();
        } else if section == called
            && let Some(name) = line.split(['.', '=', ' ']).next()
        {
            match name.strip_prefix("typelift-") {
                Some(short) => found.push(short.to_owned()),
                None if name == "typelift" => found.push(name.to_owned()),
                None => {}
            }
        }
    }
    found
}

#[test]
fn imports_go_one_way() {
    let crates = root().join("crates");
    let mut members: Vec<String> = fs::read_dir(&crates)
        .expect("the crates")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    members.sort();
    let mut known: Vec<&str> = ALLOWED.iter().map(|(name, _)| *name).collect();
    known.sort_unstable();
    assert_eq!(members, known, "a new crate needs a line in the table of allowed imports");
    for (name, allowed) in ALLOWED {
        let manifest = read(&crates.join(name).join("Cargo.toml"));
        for dependency in
            [dependencies(&manifest, "dependencies"), dependencies(&manifest, "build-dependencies")].concat()
        {
            assert!(allowed.contains(&dependency.as_str()), "{name} may not depend on {dependency}");
        }
        let in_tests =
            ALLOWED_IN_TESTS.iter().find(|(member, _)| *member == name).map_or(&[][..], |(_, besides)| besides);
        for dependency in dependencies(&manifest, "dev-dependencies") {
            let known = allowed.contains(&dependency.as_str()) || in_tests.contains(&dependency.as_str());
            assert!(known, "tests of {name} may not depend on {dependency}");
        }
    }
}

/// The folder of a crate's source files.
fn sources(name: &str) -> PathBuf {
    root().join("crates").join(name).join("src")
}

fn assert_absent(members: &[&str], words: &[&str], why: &str) {
    for member in members {
        for path in source_files(&sources(member)) {
            let code = Code::read(&path).text();
            for word in words {
                assert!(!code.contains(word), "{}: `{word}`: {why}", path.display());
            }
        }
    }
}

const LIBRARIES: [&str; 15] = [
    "model", "belief", "pddl", "world", "learn", "plan", "imagine", "check", "agent", "words", "bridge", "memory",
    "kitchen", "typelift", "lab",
];

/// Those that know of the kitchen.
const OF_THE_KITCHEN: [&str; 2] = ["kitchen", "lab"];

/// Those that know the time: the bridge waits for others, the laboratory measures.
const WITH_A_CLOCK: [&str; 2] = ["bridge", "lab"];

#[test]
fn no_kitchen_word_outside_the_kitchen() {
    let members: Vec<&str> = LIBRARIES.into_iter().filter(|member| !OF_THE_KITCHEN.contains(member)).collect();
    let words = [
        "kitchen",
        "food",
        "plate_",
        "cutboard",
        "lettuce",
        "carrot",
        "bread",
        "toast",
        "blend",
        "chop",
        "PICK",
        "PLACE",
        "\"USE\"",
        "holding",
        "agent_1",
        "content_holds",
    ];
    assert_absent(&members, &words, "a kitchen word");
}

#[test]
fn libraries_do_not_print() {
    assert_absent(&LIBRARIES, &["println!", "print!(", "dbg!(", "io::stdout", "io::stderr"], "libraries do not print");
}

#[test]
fn few_know_the_time() {
    let members: Vec<&str> = LIBRARIES.into_iter().filter(|member| !WITH_A_CLOCK.contains(member)).collect();
    let words = ["Instant::now", "SystemTime", "env::var", "thread_rng", "static mut", "thread_local!"];
    assert_absent(&members, &words, "hidden input");
}

#[test]
fn libraries_deny_missing_docs() {
    for member in LIBRARIES {
        let lib = root().join("crates").join(member).join("src/lib.rs");
        assert!(read(&lib).contains("#![deny(missing_docs)]"), "{member}");
    }
}

/// The modules of `plan`, from the bottom up: each may import those before it, none after it.
#[rustfmt::skip]
const ORDER_IN_PLAN: &[&str] = &[
    "alike", "assignment", "fact", "packed_lists", "outcome", "poll", "report", "restrictions", "shuffle",
    "op", "axioms", "pattern", "scope", "reach", "distinct", "ground", "fdr",
    "instantiate", "conflict", "obstacle", "explanation", "explain", "external", "relaxation", "restriction_literals", "symmetry",
    "landmark", "heuristic", "search", "lama", "ordered_first", "strategy", "options", "stages", "level", "widening",
    "alternatives", "planner",
];

/// The same of `pddl`.
#[rustfmt::skip]
const ORDER_IN_PDDL: &[&str] = &[
    "position", "syntax", "error", "layout_tokens", "sexpr",
    "format", "misfits", "names", "required", "requirements", "syntax_writer", "formula_text", "trajectory", "typed_list", "vocabulary",
    "definition", "objects", "plan_file", "scope", "types",
    "formula_reader", "effect_reader", "domain_reader", "problem_reader", "compile", "export", "meaning", "model_problem",
];

#[test]
fn modules_of_plan_and_pddl_have_an_order() {
    let mut against = BTreeSet::new();
    for (member, order) in [("plan", ORDER_IN_PLAN), ("pddl", ORDER_IN_PDDL)] {
        let imports = Imports::of(&sources(member));
        let known: BTreeSet<String> = order.iter().map(|module| (*module).to_owned()).collect();
        assert_eq!(imports.modules[""], known, "{member}: each module has its place in the list");
        let place = |module: &String| order.iter().position(|known| known == module);
        let upward = imports.folders[""].iter().filter(|(importer, imported)| place(importer) < place(imported));
        against.extend(upward.map(|(importer, imported)| (member, importer.clone(), imported.clone())));
    }
    assert_eq!(against, BTreeSet::new(), "each imports those before it only");
}

#[test]
fn no_modules_import_each_other_in_a_circle() {
    let mut found = Vec::new();
    for (member, _) in ALLOWED {
        let imports = Imports::of(&sources(member));
        for folder in imports.folders.keys() {
            let circle: BTreeSet<String> = imports.circles(folder).into_iter().map(|(importer, _)| importer).collect();
            if !circle.is_empty() {
                found.push(format!("{member}/{folder}: {circle:?}"));
            }
        }
    }
    assert_eq!(found, Vec::<String>::new());
}
