//! `typelift validate`.

use std::io::Write;
use std::path::PathBuf;

use serde::Serialize;
use typelift::check::{Invalid, validate, validate_stated};
use typelift::model::{ActionModel, Budget, Task};
use typelift::pddl::{PddlError, PlanLine, read_plan};
use typelift::world::{FileError, StatedProblem, is_pddl, read_text};
use typelift_memory::looks_like_memory;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::{Clock, Interrupt, Limits};
use crate::plan_file::calls_of_plan;
use crate::planning_options::ModelArguments;
use crate::style::{BAD, GOOD, HINT};
use crate::watchdog::within;

/// Say whether plans are valid, and what they cost
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift validate domain.pddl problem.pddl sas_plan
  typelift validate kitchen.json K/tasks/T1.1.json lettuce.plan

Prints what VAL prints. A plan file has one `(action object …)` a line.

Exit codes: 0 every plan is valid, 12 not every one, 22 out of memory, 23 out of
time, 31 bad input, 34 the domain uses something that is not supported, 36 wrong
usage.")]
pub(crate) struct Validate {
    #[command(flatten)]
    model: ModelArguments,
    /// A problem of the domain, or a task
    #[arg(index = 2)]
    task: PathBuf,
    /// The plans
    #[arg(required = true, value_name = "PLAN", index = 3)]
    plans: Vec<PathBuf>,
    /// Print one JSON object a plan instead
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    limits: Limits,
}

/// What is printed with `--json`.
#[derive(Serialize)]
struct Verdict<'a> {
    plan: &'a str,
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

/// A plan's file as the user names it, its text and its lines.
type PlanFile = (String, String, Vec<PlanLine>);

/// A plan that was read and held against the task.
struct Checked {
    /// The file, as the user names it.
    plan: String,
    text: String,
    lines: Vec<PlanLine>,
    /// Steps that could be taken.
    steps: usize,
    /// What it costs, if it is valid.
    value: Option<u64>,
    invalid: Option<Invalid>,
}

impl Validate {
    pub(crate) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let checked = within(clock, self.limits, || self.check(clock, quiet))?;
        let mut out = anstream::stdout().lock();
        if self.json {
            for plan in &checked {
                writeln!(out, "{}", serde_json::to_string(&plan.verdict()).unwrap_or_default())?;
            }
        } else {
            for plan in &checked {
                plan.print(&mut out)?;
            }
            summarize(&mut out, &checked)?;
        }
        Ok(if checked.iter().all(|plan| plan.invalid.is_none()) { Exit::Success } else { Exit::NotAchieved })
    }

    /// Reads everything, and takes the plans' steps.
    fn check(&self, clock: Clock, quiet: bool) -> Result<Vec<Checked>, Failure> {
        let model = match looks_like_memory(&self.model.model) {
            true => None,
            false => Some(read_text(&self.model.model)?),
        };
        let task = read_text(&self.task)?;
        let input = match model {
            Some(model) if self.model.is_as_stated() && is_pddl(&model) && is_pddl(&task) => {
                return self.check_stated(model, task);
            }
            Some(model) => self.model.input_of(model)?,
            None => self.model.read(quiet)?,
        };
        let is_given = input.is_given();
        let (model, task) = input.planning_task_from_text(&self.task, &task, quiet)?;
        let budget = self.limits.budget(clock, &Interrupt::default());
        let plans = self.read_plans()?;
        let learned = Some(&model).filter(|_| !self.model.imagine && !is_given);
        let judge = self.model.as_judged(&model, &task, &budget)?;
        let check = |(plan, text, lines): PlanFile| -> Result<_, Failure> {
            let calls = calls_of_plan(&lines, &judge, &task.init)?;
            let (steps, value, invalid) = match validate(&judge, &task, &calls) {
                Ok(valid) => (valid.plan.len(), Some(valid.plan.cost()), None),
                Err((taken, invalid)) => (taken.len(), None, Some(invalid)),
            };
            Ok(Checked { plan, text, lines, steps, value, invalid })
        };
        let checked: Vec<Checked> = plans.into_iter().map(check).collect::<Result<_, _>>()?;
        if let (Some(learned), false) = (learned, quiet)
            && checked.iter().any(|plan| plan.invalid.is_some())
        {
            self.hint_at_imagining(learned, &task, &checked, &budget)?;
        }
        Ok(checked)
    }

    /// Says that a plan is valid with imagined actions, if one of these is.
    fn hint_at_imagining(
        &self,
        learned: &ActionModel,
        task: &Task,
        checked: &[Checked],
        budget: &Budget,
    ) -> Result<(), Failure> {
        let judge = self.model.imagining().as_judged(learned, task, budget)?;
        for Checked { plan, lines, .. } in checked.iter().filter(|plan| plan.invalid.is_some()) {
            if validate(&judge, task, &calls_of_plan(lines, &judge, &task.init)?).is_ok() {
                anstream::eprintln!("{HINT}hint{HINT:#}: {plan} is valid with imagined actions: --imagine allows them");
            }
        }
        Ok(())
    }

    /// The same by what the texts of a domain and a problem state.
    fn check_stated(&self, domain: String, problem: String) -> Result<Vec<Checked>, Failure> {
        let stated = StatedProblem::from_texts((&self.model.model, domain), (&self.task, problem))?;
        let meaning = stated.meaning()?;
        let check = |(plan, text, lines): PlanFile| {
            let (steps, value, invalid) = match validate_stated(&meaning, &lines) {
                Ok(cost) => (lines.len(), Some(cost), None),
                Err((taken, invalid)) => (taken, None, Some(invalid)),
            };
            Checked { plan, text, lines, steps, value, invalid }
        };
        Ok(self.read_plans()?.into_iter().map(check).collect())
    }

    fn read_plans(&self) -> Result<Vec<PlanFile>, Failure> {
        let read = |path: &PathBuf| -> Result<_, Failure> {
            let text = read_text(path)?;
            let lines = read_plan(&text).map_err(|error| FileError::from_pddl(path, &text, error))?;
            Ok((path.display().to_string(), text, lines))
        };
        self.plans.iter().map(read).collect()
    }
}

impl Checked {
    /// The step that could not be taken, if it is not the goal that is missed.
    fn failed_step(&self) -> Option<usize> {
        self.invalid.as_ref().filter(|invalid| !matches!(invalid, Invalid::Goal { .. })).map(|_| self.steps + 1)
    }

    /// What is wrong, at the line of the step that could not be taken.
    fn error_at(&self, step: usize, reason: &str) -> PddlError {
        PddlError::new(&self.text, self.lines[step - 1].span, reason)
    }

    fn verdict(&self) -> Verdict<'_> {
        let failed_step = self.failed_step();
        Verdict {
            plan: &self.plan,
            valid: self.invalid.is_none(),
            steps: self.steps,
            value: self.value,
            failed_step,
            line: failed_step.map(|step| self.error_at(step, "").position.line),
            reason: self.invalid.as_ref().map(Invalid::to_string),
        }
    }

    /// What VAL prints, with the reason.
    fn print(&self, out: &mut impl Write) -> Result<(), Failure> {
        writeln!(out, "Checking plan: {}", self.plan)?;
        match (&self.invalid, self.failed_step()) {
            (None, _) => {
                writeln!(out, "Plan executed successfully - checking goal\n{GOOD}Plan valid{GOOD:#}")?;
                writeln!(out, "Final value: {}", self.value.unwrap_or_default())?;
            }
            (Some(invalid), None) => {
                writeln!(out, "Plan executed successfully - checking goal\n{BAD}Goal not satisfied{BAD:#}")?;
                writeln!(out, "Plan invalid: {invalid}")?;
            }
            (Some(invalid), Some(step)) => {
                writeln!(out, "{BAD}Plan failed to execute{BAD:#}")?;
                write!(out, "{}", self.error_at(step, &invalid.to_string()).render(&self.plan, &self.text))?;
                writeln!(out, "Plan invalid")?;
            }
        }
        Ok(())
    }
}

/// VAL's closing lists.
fn summarize(out: &mut impl Write, checked: &[Checked]) -> Result<(), Failure> {
    let mut valid: Vec<(u64, &str)> =
        checked.iter().filter_map(|plan| Some((plan.value?, plan.plan.as_str()))).collect();
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
    let failed: Vec<&str> =
        checked.iter().filter(|plan| plan.invalid.is_some()).map(|plan| plan.plan.as_str()).collect();
    if !failed.is_empty() {
        writeln!(out, "\nFailed plans:\n {}", failed.join("\n "))?;
    }
    Ok(())
}
