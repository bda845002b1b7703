//! The program as its users meet it: whole commands, with their exit codes, what they print, what they leave behind.

mod acting;
mod bad_models;
mod bad_tasks;
mod bad_traces;
mod bad_types;
mod common;
mod confirming;
mod environments;
mod exporting;
mod given;
mod help;
mod lab;
mod lab_report;
mod learning;
mod learning_more;
mod limits;
mod outputs;
mod pddl_files;
mod planners;
mod planning;
mod recorded;
mod shell;
mod simulator;
mod strange;
mod usage;
mod validating;
