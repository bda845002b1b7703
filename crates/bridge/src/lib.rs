//! Other programs: an environment, as a [`World`] that speaks `env/1` over a child's pipes, and a planner that reads and
//! writes PDDL files.
//!
//! ```no_run
//! use typelift_bridge::{Bridge, Options};
//! use typelift_world::{Reset, World};
//!
//! let mut world = Bridge::spawn("python3 workshop.py", Options::default(), |line| eprintln!("{line}"))?;
//! let scene = world.reset(&Reset::default())?;
//! world.close()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | file         | what it does                                                           |
//! |--------------|------------------------------------------------------------------------|
//! | `bridge.rs`  | the conversation: one request, one answer, each within its time         |
//! | `process.rs` | the child and everything that it started: watched, ended, reaped       |
//! | `pipes.rs`   | the threads that read and write, so that no pipe blocks anything        |
//! | `answer.rs`  | reads an answer, and says where one is malformed                        |
//! | `error.rs`   | what can go wrong, with what was sent and what came back                |
//! | `planner_command.rs` | a planner: writes the task as PDDL, waits, reads the plan       |
//!
//! A child never outlives its [`Bridge`]: it leads a process group, and the group is killed when the bridge is
//! dropped. (Whatever leaves the group on purpose, as a daemon does, is out of reach.) If the bridge's own process is
//! killed, the child reads the end of its input; an environment should end then.
//!
//! [`World`]: typelift_world::World
#![deny(missing_docs)]

mod answer;
mod bridge;
mod error;
mod options;
mod pipes;
mod planner_command;
mod process;
mod shell;

pub use bridge::{Bridge, Stopper};
pub use error::{BridgeError, Failure};
pub use options::Options;
pub use planner_command::{PlannerCommand, PlannerCommandError};
