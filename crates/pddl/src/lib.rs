//! PDDL as text: the one s-expression reader, domains and problems, type hierarchies, declared objects, recorded
//! trajectories, plan files, and the writers. Whatever is refused is refused with its place, and the line can be
//! [shown](PddlError::render).
//!
//! ```
//! let text = "(:types apple banana - fruit\n        leek fruit - food)";
//! let hierarchy = typelift_pddl::read_hierarchy(text)?;
//! let id = |name| hierarchy.id(name).expect("declared");
//! assert_eq!(hierarchy.lca(id("apple"), id("leek")), id("food"));
//! # Ok::<(), typelift_pddl::PddlError>(())
//! ```
//!
//! PDDL does not tell upper from lower case. The names of types keep their spelling, since snapshots name them; the
//! names of objects, predicates and actions come out in lower case.
#![deny(missing_docs)]

mod compile;
mod definition;
mod domain_reader;
mod effect_reader;
mod error;
mod export;
mod format;
mod formula_reader;
mod formula_text;
#[cfg(test)]
mod generate;
mod layout_tokens;
mod meaning;
mod misfits;
mod model_problem;
mod names;
mod objects;
mod plan_file;
mod position;
mod problem_reader;
mod required;
mod requirements;
mod scope;
mod sexpr;
mod syntax;
mod syntax_writer;
mod trajectory;
mod typed_list;
mod types;
mod vocabulary;

pub use compile::{CompileError, CompilePart, compile_domain, compile_problem};
pub use definition::{Definition, DefinitionKind};
pub use domain_reader::{read_declared_predicates, read_domain};
pub use error::{PddlError, Related};
pub use export::{ExportError, ExportNames, ExportOptions, Exported, Level, MOST_FACTS, UnknownName, export};
pub use format::format;
pub use meaning::{Atoms, Meaning, NoValue};
pub use misfits::misfits;
pub use model_problem::read_model_problem;
pub use objects::{Declarations, ObjectDeclaration, read_objects};
pub use plan_file::{PlanLine, read_plan};
pub use position::{Position, Span};
pub use problem_reader::read_problem;
pub use required::{required_by_domain, required_by_problem, undeclared_requirements};
pub use sexpr::{Children, Document, Sexpr};
pub use syntax::{
    Action, Amount, Derived, Domain, Formula, MOST_NESTED, PddlAtom, PddlEffect, PddlTerm, Problem, Signature, Typed,
};
pub use trajectory::{Trajectory, TrajectoryAction, TrajectoryState, read_trajectory};
pub use typed_list::{TypedName, read_typed_list};
pub use types::{TypeEdge, hierarchy_from_types, locate_hierarchy_error, read_hierarchy, read_types};
