//! What is observed: the snapshots that an environment gives, how they become symbolic states, the transitions of
//! demonstrations, and the files and messages in which people and programs exchange them.
#![deny(missing_docs)]

mod dataset;
mod dataset_file;
mod entity_line;
mod environment;
mod file_error;
mod goal_literals;
mod hierarchy_file;
mod inspection;
mod json;
mod line_reader;
mod object_types;
mod parse;
mod pddl_file;
mod protocol;
mod record_sink;
mod recorder;
mod recording;
mod snapshot;
mod source;
mod task_file;
mod text_file;
mod trace_file;
mod trace_line;
mod trace_reader;
mod trace_writer;
mod trajectory_file;
mod values;
mod verdict;

pub use dataset::{Dataset, Record, Repeated, Trace, TraceAction, TraceHeader, Transition};
pub use dataset_file::{any_trace_from, dataset_from, demonstrations_at, read_any_trace, read_dataset};
pub use entity_line::UnreadKey;
pub use environment::{Acted, Reset, World, WorldError, instance_of};
pub use file_error::FileError;
pub use goal_literals::WrittenGoal;
pub use hierarchy_file::{TypesFile, hierarchy_from_text, read_hierarchy, read_types};
pub use inspection::{Change, Finding, InspectOptions, Inspection, Problem, Tried, inspect};
pub use line_reader::LINE_LIMIT;
pub use object_types::ObjectTypes;
pub use parse::{ParseError, ParseErrorKind, Parser};
pub use pddl_file::{DomainFile, StatedProblem, is_pddl, model_problem_from_text};
pub use protocol::{Answer, PROTOCOL, Request, RequestBody, unread_keys_of_answer};
pub use record_sink::{Beginning, RecordSink};
pub use recorder::Recorder;
pub use recording::Recording;
pub use snapshot::{Entity, Relation, Scene, Snapshot, Value};
pub use source::{source_of, source_of_file};
pub use task_file::{TASK_FORMAT, TaskError, TaskFile, read_task, write_task};
pub use text_file::{read_text, remove_left_behind, text_from, write_file};
pub use trace_file::{is_trace, read_trace, trace_from};
pub use trace_line::{TRACE_FORMAT, TraceLine};
pub use trace_reader::{TraceItem, TraceReader};
pub use trace_writer::TraceWriter;
pub use trajectory_file::{TrajectoryContext, Unlisted, read_trajectory};
pub use verdict::{Expected, Verdict};
