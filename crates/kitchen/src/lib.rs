//! The kitchen: a small simulated room in which an agent prepares food (the paper's experiments).
//!
//! A [`Room`] is one kitchen in one state: what stands and lies where, what the agent holds, and what an action
//! does to it. [`Kitchen`] wraps it as a [`World`](typelift_world::World) that is set up from a [`Scenario`], and
//! [`serve`] speaks the environment protocol for it. [`demonstrations`], [`tasks()`] and [`faults`] are what the
//! experiments are made of, and [`life`] strings them together in a kitchen in which tools break and are mended;
//! [`replay()`] holds the simulator against a recording, [`draw`] shows it to a person.
//!
//! The room is a grid of 7 × 7 cells. Its border is taken by stations, the agent walks on the rest. Walking is no
//! action: before each action the agent walks to where it can reach the target.
//!
//! ```
//! use typelift_kitchen::Kitchen;
//! use typelift_model::GroundCall;
//! use typelift_world::{Reset, World};
//!
//! let mut kitchen = Kitchen::new();
//! kitchen.reset(&Reset { seed: 7, scenario: None })?;
//! let call = GroundCall { name: "PICK".into(), args: vec!["agent_1".into(), "lettuce_1".into()] };
//! assert!(kitchen.act(&call)?.executed);
//! # Ok::<(), typelift_world::WorldError>(())
//! ```
#![deny(missing_docs)]

mod call;
mod demonstration;
mod drawing;
mod fault;
mod grid;
mod kind;
mod kitchen;
mod life;
mod placement;
mod quirk;
mod refusal;
mod replay;
mod restore;
mod room;
mod rules;
mod scenario;
mod server;
mod settle;
mod snapshot;
mod snapshot_error;
mod tasks;
mod types;
mod walk;

pub use demonstration::{Demonstration, demonstrations};
pub use drawing::draw;
pub use fault::Fault;
pub use kitchen::Kitchen;
pub use life::{Life, LifeTask, life};
pub use quirk::{Exception, Interlock};
pub use refusal::Refusal;
pub use replay::{Difference, ReplayError, ReplayReport, replay};
pub use room::Room;
pub use scenario::{Filler, Scenario, ScenarioError};
pub use server::serve;
pub use snapshot_error::SnapshotError;
pub use tasks::{KitchenTask, faults, tasks};
pub use types::{hierarchy, parse_config, types_pddl};
