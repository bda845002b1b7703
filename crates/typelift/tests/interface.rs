//! The facade's interface is this list. A name is added or taken away here too, and each has an example on the front page.

const NAMES: [&str; 43] = [
    "AccountView",
    "Acted",
    "ActionModel",
    "AnswerView",
    "Budget",
    "Command",
    "Confirmation",
    "DomainFile",
    "Ending",
    "Episode",
    "Event",
    "Experience",
    "Explanation",
    "ExportOptions",
    "GroundAtom",
    "GroundCall",
    "ImagineOptions",
    "Input",
    "LearnOptions",
    "LearnedModel",
    "Options",
    "Outcome",
    "Parser",
    "Plan",
    "Recorder",
    "Reset",
    "Restrictions",
    "Scene",
    "Task",
    "TraceHeader",
    "World",
    "WorldError",
    "check",
    "evidence_of",
    "export",
    "learn_dataset",
    "learn_evidence",
    "propose",
    "read_dataset",
    "read_hierarchy",
    "read_task",
    "run",
    "validate",
];

/// The names that the front page's source re-exports one by one, as users see them.
fn reexported(source: &str) -> Vec<&str> {
    let after = |item: &'static str| source.split(item).skip(1).map(|rest| rest.split(';').next().unwrap_or_default());
    let mut names: Vec<&str> = after("#[doc(inline)]\npub use ")
        .filter_map(|item| Some(item.split_once("::")?.1.trim_matches(['{', '}'])))
        .flat_map(|names| names.split(','))
        .map(|name| name.rsplit(" as ").next().unwrap_or(name).trim())
        .filter(|name| !name.is_empty())
        .collect();
    names.sort_unstable();
    names
}

#[test]
fn the_names_of_the_interface() {
    assert_eq!(reexported(include_str!("../src/lib.rs")), NAMES);
}

#[test]
fn every_name_has_an_example() {
    let source = include_str!("../src/lib.rs");
    // What people see: hidden lines begin with `# `.
    let examples: String = source
        .split("//! ```")
        .skip(1)
        .step_by(2)
        .flat_map(str::lines)
        .filter(|line| !line.starts_with("//! # "))
        .collect();
    let words: Vec<&str> = examples.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    for name in NAMES {
        assert!(words.contains(&name), "{name} has no example on the front page");
    }
}
