//! `typelift validate`.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use typelift::check::{Invalid, validate};
use typelift::imagine::imagine;
use typelift::model::{ActionModel, Budget, Task, strict};
use typelift::pddl::{PddlError, PlanLine, read_plan};
use typelift::plan::Restrictions;
use typelift::world::{FileError, read_text};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::read_model_input;
use crate::plan_text::calls_of_plan;
use crate::style::{BAD, GOOD};

/// Say whether plans are valid, and what they cost
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift validate domain.pddl problem.pddl sas_plan
  typelift validate kitchen.json K/tasks/T1.1.json lettuce.plan

Prints what VAL prints. A plan file has one `(action object …)` a line.

Exit codes: 0 every plan is valid, 12 not every one, 31 bad input, 34 the domain
uses something that is not supported, 36 wrong usage.")]
pub(crate) struct Validate {
    /// A PDDL domain, or a learned model
    model: PathBuf,
    /// A problem of the domain, or a task
    task: PathBuf,
    /// The plans
    #[arg(required = true, value_name = "PLAN")]
    plans: Vec<PathBuf>,
    /// Add the types of this file to a learned model's
    #[arg(long, value_name = "FILE")]
    types: Option<PathBuf>,
    /// Allow the actions that are imagined for the task
    #[arg(long)]
    imagine: bool,
    /// Allow an action of a learned model also where some of its effects hold already
    #[arg(long)]
    plain: bool,
    /// Print one JSON object a plan instead
    #[arg(long)]
    json: bool,
}

/// What is printed with `--json`.
#[derive(Serialize)]
struct Verdict {
    plan: String,
    valid: bool,
    /// Steps that could be taken.
    steps: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    failed_step: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

/// A plan file that was read.
struct PlanFile<'a> {
    path: &'a Path,
    text: String,
    lines: Vec<PlanLine>,
}

impl Validate {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        let input = read_model_input(&self.model, self.types.as_ref())?;
        let (model, task) = input.read_planning_task(&self.task, quiet)?;
        let model = match self.imagine {
            true => imagine(&model, &task, &Restrictions::default(), &Default::default(), &Budget::unlimited())?
                .added_to(&model),
            false => model,
        };
        let model = if self.plain { model } else { strict(&model) };
        let mut files = Vec::with_capacity(self.plans.len());
        for path in &self.plans {
            let text = read_text(path)?;
            let lines = read_plan(&text).map_err(|error| FileError::from_pddl(path, &text, error))?;
            files.push(PlanFile { path, text, lines });
        }
        let mut out = anstream::stdout().lock();
        let mut verdicts = Vec::with_capacity(files.len());
        for file in &files {
            let verdict = self.judge(&mut out, file, &model, &task)?;
            if self.json {
                writeln!(out, "{}", serde_json::to_string(&verdict).unwrap_or_default())?;
            }
            verdicts.push(verdict);
        }
        if !self.json {
            summarize(&mut out, &verdicts)?;
        }
        Ok(if verdicts.iter().all(|verdict| verdict.valid) { Exit::Success } else { Exit::NotAchieved })
    }

    fn judge(
        &self,
        out: &mut impl Write,
        file: &PlanFile<'_>,
        model: &ActionModel,
        task: &Task,
    ) -> Result<Verdict, Failure> {
        let shown = file.path.display().to_string();
        if !self.json {
            writeln!(out, "Checking plan: {shown}")?;
        }
        let calls = calls_of_plan(&file.lines, model, &task.init)?;
        let (steps, value, invalid) = match validate(model, task, &calls) {
            Ok(valid) => (valid.plan.len(), Some(valid.plan.cost()), None),
            Err((taken, invalid)) => (taken.len(), None, Some(invalid)),
        };
        if !self.json {
            print_verdict(out, file, value, steps, invalid.as_ref())?;
        }
        let failed = invalid.as_ref().filter(|invalid| !matches!(invalid, Invalid::Goal { .. })).map(|_| steps + 1);
        let line = failed.map(|step| PddlError::new(&file.text, file.lines[step - 1].span, "").position.line);
        let reason = invalid.map(|invalid| invalid.to_string());
        Ok(Verdict { plan: shown, valid: reason.is_none(), steps, value, failed_step: failed, line, reason })
    }
}

/// What VAL prints, with the reason.
fn print_verdict(
    out: &mut impl Write,
    file: &PlanFile<'_>,
    value: Option<u64>,
    steps: usize,
    invalid: Option<&Invalid>,
) -> Result<(), Failure> {
    match invalid {
        None => {
            writeln!(out, "Plan executed successfully - checking goal\n{GOOD}Plan valid{GOOD:#}")?;
            writeln!(out, "Final value: {}", value.unwrap_or_default())?;
        }
        Some(invalid @ Invalid::Goal { .. }) => {
            writeln!(out, "Plan executed successfully - checking goal\n{BAD}Goal not satisfied{BAD:#}")?;
            writeln!(out, "Plan invalid: {invalid}")?;
        }
        Some(invalid) => {
            writeln!(out, "{BAD}Plan failed to execute{BAD:#}")?;
            let error = PddlError::new(&file.text, file.lines[steps].span, invalid.to_string());
            write!(out, "{}", error.render(&file.path.display().to_string(), &file.text))?;
            writeln!(out, "Plan invalid")?;
        }
    }
    Ok(())
}

/// VAL's closing lists.
fn summarize(out: &mut impl Write, verdicts: &[Verdict]) -> Result<(), Failure> {
    let mut valid: Vec<(u64, &str)> =
        verdicts.iter().filter_map(|verdict| Some((verdict.value?, verdict.plan.as_str()))).collect();
    valid.sort_unstable();
    if !valid.is_empty() {
        writeln!(out, "\nSuccessful plans:")?;
        for group in valid.chunk_by(|a, b| a.0 == b.0) {
            let value = group[0].0;
            writeln!(out, "Value: {value}")?;
            for (_, plan) in group {
                writeln!(out, " {plan} {value}")?;
            }
        }
    }
    let failed: Vec<&str> = verdicts.iter().filter(|v| !v.valid).map(|v| v.plan.as_str()).collect();
    if !failed.is_empty() {
        writeln!(out, "\nFailed plans:\n {}", failed.join("\n "))?;
    }
    Ok(())
}
