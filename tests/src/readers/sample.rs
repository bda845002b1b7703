//! What stands for the parts that an input leaves out.

use std::sync::OnceLock;

use typelift::model::{ActionModel, Hierarchy, Task};
use typelift::pddl::{Domain, read_hierarchy};
use typelift::world::ObjectTypes;

use super::domain::checked_domain;
use super::problem::checked_problem;
use super::scratch::in_file;

const DOMAIN: &str = include_str!("../../../fuzz/seeds/domain/lamps.pddl");
const PROBLEM: &str = include_str!("../../../fuzz/seeds/problem/lamps-1.pddl");
const OBJECTS: &str = "(:objects a b c - room l m - lamp h - hall)";
const TYPES: &str = include_str!("../../../fuzz/seeds/types/lamps.pddl");

/// A domain with its model.
pub(super) fn domain() -> &'static (Domain, ActionModel) {
    static KNOWN: OnceLock<(Domain, ActionModel)> = OnceLock::new();
    KNOWN.get_or_init(|| checked_domain(DOMAIN).expect("a domain"))
}

/// A problem of that domain: its model and its task.
pub(super) fn problem() -> &'static (ActionModel, Task) {
    static KNOWN: OnceLock<(ActionModel, Task)> = OnceLock::new();
    let (domain, model) = domain();
    KNOWN.get_or_init(|| checked_problem(PROBLEM, domain, model.clone()).expect("a problem"))
}

/// The types of traces, and of the objects of trajectories.
pub(super) fn hierarchy() -> Hierarchy {
    static KNOWN: OnceLock<Hierarchy> = OnceLock::new();
    KNOWN.get_or_init(|| read_hierarchy(TYPES).expect("a tree")).clone()
}

/// The objects of trajectories.
pub(super) fn objects() -> ObjectTypes {
    static KNOWN: OnceLock<ObjectTypes> = OnceLock::new();
    KNOWN.get_or_init(|| in_file(OBJECTS.as_bytes(), ObjectTypes::from_file).expect("objects")).clone()
}
