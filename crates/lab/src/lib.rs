//! The laboratory: every experiment of the paper, run again, and its numbers beside the published ones.
//!
//! An experiment is a list of runs that do not depend on each other ([`Experiment`]). [`carry_out`] carries them out
//! in parallel and logs each as it finishes, so that a run that was once finished is never repeated. What is then
//! computed from the records, tables and figures, is a pure function of them.
#![deny(missing_docs)]

mod attempt;
mod csv;
mod demonstrations;
mod error;
mod faults;
pub mod figure;
mod growth;
mod hierarchy;
mod json;
mod learned;
mod lifelong;
mod limits;
mod published;
pub mod report;
mod run_log;
mod runner;
mod statistics;
mod table;
mod variant;

pub use attempt::{Attempt, Setting, attempt, attempt_in, ending_word, is_out_of_time};
pub use csv::Csv;
pub use demonstrations::{
    DemonstrationsOptions, DemonstrationsResult, Gain, Size, Subset, SubsetRecord, SubsetRun, demonstrations_experiment,
};
pub use error::LabError;
pub use faults::{
    FaultRecord, FaultRow, FaultRun, FaultScenario, FaultsOptions, FaultsResult, Outcome, fault_scenarios,
    faults_experiment,
};
pub use growth::{
    Allowance, End, Growth, GrowthResult, Measure, Measurement, Point, Series, SeriesFit, UnknownPoint, measure,
};
pub use hierarchy::{ParameterRow, TypeHierarchy, TypeRow};
pub use learned::{dataset_of, kitchen_model, learned_from};
pub use lifelong::{
    Agent, AgentSummary, Blame, FailedStep, Goal, LifeRecord, LifeRun, LifelongOptions, LifelongResult, OtherEffect,
    TaskRecord, TrueCause, Truth, lifelong_experiment,
};
pub use limits::{Limits, Stopper};
pub use published::{Demonstrations, Learning, Published, PublishedCell, Table, published};
pub use run_log::{FILE_NAME, FORMAT, Header, RunLog};
pub use runner::{Experiment, Progress, RunnerOptions, carry_out};
pub use statistics::{mean_and_sd, median};
pub use table::{Cell, Comparison, QUICK, TableOptions, TableRecord, TableResult, TableRun, table};
pub use variant::{Variant, paper_options};
