//! What is said of plans, answers, actions, accounts and events: words for people, and wire types for programs.
//!
//! A command line, a notebook and a page show the same things. What they say stands here, once; they only lay it out
//! and paint it. Each thing has a *view*, which serde writes and of which there is a JSON Schema (feature `schema`), and,
//! where people read it as a line, a [`Text`] whose parts have [roles](Role).
//!
//! | file             | what it speaks of                                       |
//! |------------------|---------------------------------------------------------|
//! | `text.rs`        | text in parts, and how they are counted                 |
//! | `plan.rs`        | plans and their steps                                   |
//! | `answer.rs`      | the answer to a planning question                       |
//! | `action.rs`      | actions and axioms of a model                           |
//! | `difference/`    | how two models differ                                   |
//! | `learning.rs`    | what learning could make nothing of, and took too far   |
//! | `given_up.rs`    | what is to be noted where there is no plan              |
//! | `account.rs`     | how an episode went                                     |
//! | `event.rs`       | what happens during an episode                          |
//! | `why.rs`         | what is believed of a call                              |
//! | `wire.rs`        | commands and events for programs outside                |
#![deny(missing_docs)]

mod account;
mod action;
mod answer;
mod difference;
mod event;
mod given_up;
mod inspection;
mod learning;
mod plan;
mod text;
mod why;
mod wire;

pub use account::{AccountView, BrokenOffView, ExclusionView, FailureView, broken_off, summary};
pub use action::{Description, Row, describe_action, describe_axiom, individual_name};
pub use answer::{AnswerView, ending, why_none};
pub use difference::{
    ActionDifference, ListDifference, ModelDifference, difference, difference_lines, evidence_difference,
};
pub use event::line;
pub use given_up::given_up_notes;
pub use inspection::{FindingView, InspectionView, TriedView, inspection_lines};
pub use learning::{TypeNote, dropped_by_merging, missing_actor, unbounded_parameters, why_unexplained};
pub use plan::{PlanView, StepView, imagined_note, numbered_steps, plan_size, without_phrase};
pub use text::{Role, Span, Text, count, places};
pub use why::{CallQuestion, WhyView, why_lines};
pub use wire::{WireCommand, WireEvent, wire_command, wire_event};
