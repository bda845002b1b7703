//! The house rules that a compiler does not hold: who may import whom, and what is deliberately absent.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the workspace")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Each crate with the crates of ours that it may depend on.
const ALLOWED: [(&str, &[&str]); 13] = [
    ("model", &[]),
    ("pddl", &["model"]),
    ("world", &["model", "pddl"]),
    ("learn", &["model", "world"]),
    ("plan", &["model"]),
    ("imagine", &["model", "plan"]),
    ("check", &["model"]),
    ("agent", &["model", "world", "plan", "imagine", "check"]),
    ("bridge", &["model", "pddl", "world", "plan"]),
    ("kitchen", &["model", "world"]),
    ("typelift", &["model", "pddl", "world", "learn", "plan", "imagine", "check", "agent", "bridge"]),
    ("lab", &["typelift", "kitchen"]),
    ("cli", &["typelift", "kitchen", "lab"]),
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
    let mut rooms: Vec<String> = fs::read_dir(&crates)
        .expect("the crates")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    rooms.sort();
    let mut known: Vec<&str> = ALLOWED.iter().map(|(name, _)| *name).collect();
    known.sort_unstable();
    assert_eq!(rooms, known, "a new room needs a line in the table of allowed imports");
    for (name, allowed) in ALLOWED {
        let manifest = read(&crates.join(name).join("Cargo.toml"));
        for dependency in
            [dependencies(&manifest, "dependencies"), dependencies(&manifest, "build-dependencies")].concat()
        {
            assert!(allowed.contains(&dependency.as_str()), "{name} may not depend on {dependency}");
        }
        let in_tests = ALLOWED_IN_TESTS.iter().find(|(room, _)| *room == name).map_or(&[][..], |(_, besides)| besides);
        for dependency in dependencies(&manifest, "dev-dependencies") {
            let known = allowed.contains(&dependency.as_str()) || in_tests.contains(&dependency.as_str());
            assert!(known, "tests of {name} may not depend on {dependency}");
        }
    }
}

/// The source files of a crate.
fn sources(name: &str) -> Vec<PathBuf> {
    let mut folders = vec![root().join("crates").join(name).join("src")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                files.push(path);
            }
        }
    }
    files
}

/// The code of a file: without comments, and without the tests at its end.
fn code(path: &Path) -> String {
    let text = read(path);
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    code.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

fn assert_absent(rooms: &[&str], words: &[&str], why: &str) {
    for room in rooms {
        for path in sources(room) {
            let code = code(&path);
            for word in words {
                assert!(!code.contains(word), "{}: `{word}`: {why}", path.display());
            }
        }
    }
}

const LIBRARIES: [&str; 12] =
    ["model", "pddl", "world", "learn", "plan", "imagine", "check", "agent", "bridge", "kitchen", "typelift", "lab"];

/// Those that know of the kitchen.
const OF_THE_KITCHEN: [&str; 2] = ["kitchen", "lab"];

/// Those that know the time: the bridge waits for others, the laboratory measures.
const WITH_A_CLOCK: [&str; 2] = ["bridge", "lab"];

#[test]
fn no_kitchen_word_outside_the_kitchen() {
    let rooms: Vec<&str> = LIBRARIES.into_iter().filter(|room| !OF_THE_KITCHEN.contains(room)).collect();
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
    assert_absent(&rooms, &words, "a kitchen word");
}

#[test]
fn libraries_do_not_print() {
    assert_absent(&LIBRARIES, &["println!", "print!(", "dbg!(", "io::stdout", "io::stderr"], "libraries do not print");
}

#[test]
fn few_know_the_time() {
    let rooms: Vec<&str> = LIBRARIES.into_iter().filter(|room| !WITH_A_CLOCK.contains(room)).collect();
    let words = ["Instant::now", "SystemTime", "env::var", "thread_rng", "static mut", "thread_local!"];
    assert_absent(&rooms, &words, "hidden input");
}

#[test]
fn libraries_deny_missing_docs() {
    for room in LIBRARIES {
        let lib = root().join("crates").join(room).join("src/lib.rs");
        assert!(read(&lib).contains("#![deny(missing_docs)]"), "{room}");
    }
}
