//! What stands for the parts that an input leaves out.

use std::sync::OnceLock;

use typelift::model::Hierarchy;
use typelift::pddl::read_hierarchy;
use typelift::world::ObjectTypes;

use super::scratch::in_file;

pub(super) const DOMAIN: &str = include_str!("../../../fuzz/seeds/domain/lamps.pddl");
pub(super) const PROBLEM: &str = include_str!("../../../fuzz/seeds/problem/lamps-1.pddl");
const OBJECTS: &str = "(:objects a b c - room l m - lamp h - hall)";
const TYPES: &str = include_str!("../../../fuzz/seeds/types/lamps.pddl");

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
