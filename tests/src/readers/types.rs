//! Hierarchy files.

use std::collections::BTreeMap;
use std::fmt::Write;

use typelift::model::Hierarchy;
use typelift::world::read_hierarchy;

use super::errors::assert_shown;
use super::scratch::in_file;

/// What is read is the same when it is written as PDDL, or as JSON.
pub fn types(bytes: &[u8]) {
    checked_hierarchy(bytes);
}

/// The hierarchy of a file, if it is one.
pub(super) fn checked_hierarchy(bytes: &[u8]) -> Option<Hierarchy> {
    let hierarchy = match in_file(bytes, read_hierarchy) {
        Ok(hierarchy) => hierarchy,
        Err(error) => {
            assert_shown(&error, bytes);
            return None;
        }
    };
    let mut pddl = "(:types".to_owned();
    for (child, parent) in hierarchy.edges() {
        write!(pddl, " {child} - {parent}").expect("memory");
    }
    pddl.push(')');
    let mut parents: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (child, parent) in hierarchy.edges() {
        parents.entry(child.to_string()).or_default().push(parent.to_string());
    }
    let json = serde_json::to_string(&parents).expect("JSON");
    let edges = |read: &Hierarchy| {
        let mut edges: Vec<String> = read.edges().map(|(child, parent)| format!("{child} - {parent}")).collect();
        edges.sort();
        edges
    };
    // In JSON, names may differ in case alone.
    let is_pddl = bytes.contains(&b'(') && !bytes.contains(&b'{');
    for text in [json].into_iter().chain(is_pddl.then_some(pddl)) {
        match in_file(text.as_bytes(), read_hierarchy) {
            Ok(again) => assert_eq!(edges(&again), edges(&hierarchy), "{text}"),
            Err(error) => panic!("{error}: {text}"),
        }
    }
    Some(hierarchy)
}
