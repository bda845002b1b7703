//! The lives as files: `lifelong.csv`, a row a task; `failed.csv`, a row a failed step; `lifelong.json` and `lifelong.md`.

use std::fmt::Write;
use std::path::Path;

use serde_json::{Value, json};
use typelift::world::{FileError, write_file};

use super::{LifelongResult, Truth};
use crate::csv::Csv;

impl LifelongResult {
    pub(super) fn write(&self, folder: &Path) -> Result<(), FileError> {
        write_file(&folder.join("lifelong.csv"), self.csv().as_bytes())?;
        write_file(&folder.join("failed.csv"), self.failed_csv().as_bytes())?;
        write_file(&folder.join("lifelong.json"), format!("{:#}\n", self.json()).as_bytes())?;
        write_file(&folder.join("lifelong.md"), self.markdown().as_bytes())
    }

    fn csv(&self) -> String {
        let mut csv = Csv::new(&["life", "agent", "number", "task", "ending", "proposals", "actions", "failed_steps"]);
        for (run, record) in &self.records {
            for (number, task) in (1..).zip(&record.tasks) {
                let counts = [task.proposals, task.actions, task.failed.len() as u64].map(|count| count.to_string());
                let head = [run.seed.to_string(), run.agent.to_string(), format!("{number}"), task.task.clone()];
                csv.row(head.into_iter().chain([task.ending.clone()]).chain(counts));
            }
        }
        csv.into_text()
    }

    fn failed_csv(&self) -> String {
        let mut csv = Csv::new(&["life", "agent", "number", "task", "call", "action", "retry", "kind", "cause"]);
        for (run, record) in &self.records {
            for (number, task) in (1..).zip(&record.tasks) {
                for step in &task.failed {
                    csv.row([
                        run.seed.to_string(),
                        run.agent.to_string(),
                        format!("{number}"),
                        task.task.clone(),
                        step.call.clone(),
                        step.action.clone(),
                        u8::from(step.retry).to_string(),
                        step.cause.kind().to_owned(),
                        step.cause.to_string(),
                    ]);
                }
            }
        }
        csv.into_text()
    }

    /// The lives as JSON: the same as the file `lifelong.json`.
    pub fn json(&self) -> Value {
        json!({
            "format": "lab-lifelong/1",
            "typelift": env!("CARGO_PKG_VERSION"),
            "runs": self.options.runs,
            "seed": self.options.seed,
            "tasks": self.options.tasks,
            "window": self.window(),
            "limits": self.options.limits,
            "agents": self.summaries(),
            "blame": self.blame(),
            "truth": self.truth().iter().map(truth_json).collect::<Vec<_>>(),
            "goals": self.goals(),
        })
    }

    fn markdown(&self) -> String {
        let (window, summaries) = (self.window(), self.summaries());
        let mut text = format!(
            "# Lives\n\n{} lives of {} tasks each, from seed {} on; {}.\n\n\
             | agent | solved | plans a task | failed steps a task | first {window} | last {window} | lost |\n\
             |---|---|---|---|---|---|---|\n",
            self.options.runs, self.options.tasks, self.options.seed, self.options.limits
        );
        for summary in &summaries {
            let end = |part: Option<&f64>| part.map(|failed| format!("{failed:.3}")).unwrap_or_default();
            let (first, last) = (summary.failed_over_time.first(), summary.failed_over_time.last());
            let _ = writeln!(
                text,
                "| {} | {} of {} | {:.2} | {:.3} | {} | {} | {} |",
                summary.agent,
                summary.solved,
                summary.tasks,
                summary.proposals,
                summary.failed,
                end(first),
                end(last),
                summary.lost.len()
            );
        }
        text += "\n## Failed steps by true cause\n\n| agent | cause | first | last | all |\n|---|---|---|---|---|\n";
        for summary in &summaries {
            for (kind, [first, last, all]) in summary.causes_in_order() {
                let _ = writeln!(text, "| {} | {kind} | {first} | {last} | {all} |", summary.agent);
            }
        }
        let blame = self.blame();
        if blame.first[1] > 0 {
            text += "\n## Blame\n\n| when a true cause struck | the right kind of culprit came first |\n|---|---|\n";
            for (when, [hit, of]) in [("for the first time", blame.first), ("for the third time", blame.third)] {
                let _ = writeln!(text, "| {when} | {hit} of {of} |");
            }
            for (cause, [hit, of]) in &blame.by_cause {
                let _ = writeln!(text, "| {cause}, every time | {hit} of {of} |");
            }
            let [believed, object, kind] = blame.brier;
            let _ = writeln!(
                text,
                "\nBrier's score: {believed:.3}; if it is always thought to be the object {object:.3}, and always the \
                 type {kind:.3}.\n\n| thought to be to blame | is | of |\n|---|---|---|"
            );
            for (count, sum, to_blame) in blame.bins.iter().filter(|(count, ..)| *count > 0) {
                let of = *count as f64;
                let _ = writeln!(text, "| {:.3} | {:.3} | {count} |", sum / of, *to_blame as f64 / of);
            }
        }
        if !self.truth().is_empty() {
            text += "\n## What is thought to work\n\n| after | precision | recall |\n|---|---|---|\n";
        }
        for truth in self.truth() {
            let _ = writeln!(text, "| {} | {:.4} | {:.4} |", truth.after, truth.precision(), truth.recall());
        }
        text += "\n## What was to be reached\n\n| what | at most | is |\n|---|---|---|\n";
        for goal in self.goals() {
            let _ = writeln!(text, "| {} | {:.3} | {:.3} |", goal.what, goal.at_most, goal.reached);
        }
        text
    }
}

fn truth_json(truth: &Truth) -> Value {
    let Truth { after, right, too_much, too_little } = truth;
    json!({
        "after": after,
        "precision": truth.precision(),
        "recall": truth.recall(),
        "right": right,
        "too_much": too_much,
        "too_little": too_little,
    })
}
