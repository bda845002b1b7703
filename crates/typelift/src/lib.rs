//! Show a robot a few tasks; it plans tasks it was never shown.
//!
//! The facade over typelift's crates: a library user depends on this one.
//!
//! | module      | what it holds                                                                    |
//! |-------------|----------------------------------------------------------------------------------|
//! | [`model`]   | the vocabulary: types, atoms, states, actions, models, tasks, plans               |
//! | [`world`]   | snapshots and how they become states, traces, tasks, environments, their protocol |
//! | [`pddl`]    | PDDL types, domains and trajectories                                              |
//! | [`learn`]   | Algorithm 1: individual and type-generalized actions from demonstrations          |
//! | [`imagine`] | Algorithm 2: imagined actions for goals that cannot be reached                    |
//! | [`plan`]    | grounding, landmarks, heuristic search, why there is no plan                      |
//! | [`check`]   | replays plans by the plainest semantics                                           |
//! | [`agent`]   | an episode: propose, act, monitor, exclude, retry, replan                         |
//! | [`words`]   | what is said of plans, answers, accounts and events, for people and programs      |
//! | [`bridge`]  | an environment in a child process                                                 |
//!
//! From two demonstrations to a plan for something never shown:
//!
//! ```
//! use typelift::agent::{Options, propose};
//! use typelift::learn::{evidence_of, learn};
//! use typelift::model::{Budget, GroundAtom, GroundCall, Hierarchy, ParseConfig, Task};
//! use typelift::plan::{Outcome, Restrictions};
//! use typelift::world::{Dataset, Parser, Scene, Trace, TraceAction};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let types = Hierarchy::from_edges([("rod", "piece"), ("plank", "piece"), ("beam", "piece"), ("saw", "machine")])?;
//! let mut parser = Parser::new(types.clone(), ParseConfig::default());
//!
//! // Seen: the saw cuts a rod, and a plank.
//! let mut demonstrations = Dataset { hierarchy: types.clone(), ..Dataset::default() };
//! for kind in ["rod", "plank"] {
//!     let scene = |cut: bool| -> Result<Scene, serde_json::Error> {
//!         serde_json::from_value(serde_json::json!({"entities": [
//!             {"id": "saw_1", "type": "saw"},
//!             {"id": "it", "type": kind, "attributes": {"whole": !cut, "cut": cut}}]}))
//!     };
//!     let call = GroundCall { name: "cut".into(), args: vec!["saw_1".into(), "it".into()] };
//!     demonstrations.traces.push(Trace {
//!         states: vec![parser.parse(&scene(false)?)?, parser.parse(&scene(true)?)?],
//!         actions: vec![TraceAction::from(call)],
//!         ..Trace::default()
//!     });
//! }
//! let learned = learn(&types, &evidence_of(&demonstrations).total(), &Default::default())?;
//! assert_eq!(learned.model.actions[0].name, "cut-saw-piece"); // rod and plank meet in piece
//!
//! // Asked: a beam, which nobody ever cut.
//! let scene: Scene = serde_json::from_str(r#"{"objects": {"saw_1": "saw", "b": "beam"}, "atoms": ["whole(b)"]}"#)?;
//! let task = Task::new(parser.parse(&scene)?, vec![GroundAtom::parse("cut(b)")?]);
//! let (nothing_failed, no_limits) = (Restrictions::default(), Budget::unlimited());
//! let proposal = propose(&learned.model, &task, &nothing_failed, &Options::default(), &no_limits)?;
//! let Outcome::Solved(plan) = proposal.outcome else { panic!("{}", proposal.explain()) };
//! assert_eq!(plan.steps[0].call.to_string(), "cut(saw_1, b)");
//! # Ok(())
//! # }
//! ```
#![deny(missing_docs)]

#[cfg(feature = "schema")]
mod schemas;

#[cfg(feature = "schema")]
pub use schemas::schemas;
pub use typelift_agent as agent;
pub use typelift_bridge as bridge;
pub use typelift_check as check;
pub use typelift_imagine as imagine;
pub use typelift_learn as learn;
pub use typelift_model as model;
pub use typelift_pddl as pddl;
pub use typelift_plan as plan;
pub use typelift_words as words;
pub use typelift_world as world;
