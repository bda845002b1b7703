//! The `typelift` program: parse the arguments, call the libraries, show what they found.
//!
//! One file, or one folder, a subcommand. Data goes to standard output, everything else to standard error. Every way to end has its
//! exit code, in [`exit`].

mod awaited;
mod check_env;
mod columns;
mod confirm;
mod demo;
mod diff;
mod environment;
mod exit;
mod export;
mod failure;
mod files;
mod kitchen;
mod lab;
mod learn;
mod learn_actor;
mod learn_changes;
mod learn_into;
mod learn_report;
mod limits;
mod memory;
mod narrate;
mod no_plan;
mod overwriting;
mod pddl;
mod plan;
mod plan_file;
mod planner_option;
mod planning_options;
mod quantities;
mod remembered;
mod resident;
mod run;
mod shell;
mod show;
mod show_vocabulary;
mod style;
mod validate;
mod waiting;
mod watchdog;
mod why;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use exit::Exit;
use failure::Failure;
use limits::Clock;

/// Show a robot a few tasks; it plans tasks it was never shown.
#[derive(Debug, Parser)]
#[command(name = "typelift", version, max_term_width = 80, disable_help_subcommand = true)]
#[command(after_help = "Begin with `typelift demo`.")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Say nothing on standard error but errors
    #[arg(long, short, global = true, display_order = LAST_OPTION)]
    quiet: bool,
}

/// The place of what every command has: behind its own options.
const LAST_OPTION: usize = 900;

#[derive(Debug, Subcommand)]
enum Command {
    Demo(demo::Demo),
    Learn(learn::Learn),
    Show(show::Show),
    Why(why::Why),
    Diff(diff::Diff),
    Plan(plan::Plan),
    Export(export::Export),
    Run(run::Run),
    Memory(memory::MemoryCommand),
    CheckEnv(check_env::CheckEnv),
    Validate(validate::Validate),
    Pddl(pddl::Pddl),
    Kitchen(kitchen::Kitchen),
    Lab(lab::Lab),
    Completions(shell::Completions),
    Man(shell::Man),
}

fn main() -> ExitCode {
    let clock = Clock::start();
    let arguments = match Arguments::try_parse_from(with_help_last(std::env::args_os())) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are no errors. If printing fails, that cannot be printed either.
            let _ = error.print();
            return if error.use_stderr() { Exit::Usage.into() } else { Exit::Success.into() };
        }
    };
    let quiet = arguments.quiet;
    let ended = match arguments.command {
        Command::Demo(demo) => demo.run(clock),
        Command::Learn(learn) => learn.run(clock, quiet),
        Command::Show(show) => show.run(quiet),
        Command::Why(why) => why.run(quiet),
        Command::Diff(diff) => diff.run(quiet),
        Command::Plan(plan) => plan.run(clock, quiet),
        Command::Export(export) => export.run(clock, quiet),
        Command::Run(run) => run.run(clock, quiet),
        Command::Memory(memory) => memory.run(quiet),
        Command::CheckEnv(check_env) => check_env.run(quiet),
        Command::Validate(validate) => validate.run(clock, quiet),
        Command::Pddl(pddl) => pddl.run(quiet),
        Command::Kitchen(kitchen) => kitchen.run(quiet),
        Command::Lab(lab) => lab.run(clock, quiet),
        Command::Completions(completions) => completions.run(),
        Command::Man(man) => man.run(quiet),
    };
    ended.unwrap_or_else(|failure: Failure| failure.report()).into()
}

/// The words of the command line, `typelift help plan` as `typelift plan --help`.
fn with_help_last(words: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut words: Vec<OsString> = words.collect();
    if words.get(1).is_some_and(|word| word == "help") {
        words.remove(1);
        words.push("--help".into());
    }
    words
}
