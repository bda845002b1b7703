//! The scenarios as files: `faults.csv`, `faults.json`, `faults.md`.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

use serde_json::{Value, json};
use typelift::world::{FileError, write_file};

use crate::csv::{Csv, optional};
use crate::faults::{FaultRecord, FaultScenario, FaultsResult, Outcome};
use crate::statistics::median;

/// The runs of a scenario, with restart or without.
#[derive(Debug, Clone, PartialEq)]
pub struct FaultRow<'a> {
    /// The scenario.
    pub scenario: &'a FaultScenario,
    /// Whether the world is set back after a failure.
    pub restart: bool,
    /// What came of each run.
    pub records: Vec<&'a FaultRecord>,
}

impl FaultRow<'_> {
    fn first(&self) -> impl Iterator<Item = &Outcome> {
        self.records.iter().map(|record| &record.first)
    }

    /// How many runs were solved.
    pub fn solved(&self) -> usize {
        self.first().filter(|outcome| outcome.solved()).count()
    }

    /// The median number of proposals, of all runs.
    pub fn proposals(&self) -> f64 {
        median(self.first().map(|outcome| outcome.proposals as f64)).unwrap_or_default()
    }

    /// The median length of the plans that succeeded.
    pub fn plan_length(&self) -> Option<f64> {
        median(self.first().filter_map(|outcome| outcome.plan_length).map(|length| length as f64))
    }

    /// Everything that was excluded in some run.
    pub fn excluded(&self) -> BTreeSet<&str> {
        self.first().flat_map(|outcome| &outcome.excluded).map(String::as_str).collect()
    }

    /// Every imagined action of a plan that succeeded.
    pub fn imagined(&self) -> BTreeSet<&str> {
        self.first().flat_map(|outcome| &outcome.imagined).map(String::as_str).collect()
    }

    /// Why it was not solved, in the first run that was not.
    pub fn why(&self) -> Option<&str> {
        self.first().find(|outcome| !outcome.solved()).map(|outcome| outcome.why.as_deref().unwrap_or(&outcome.ending))
    }

    /// In how many runs the later task was solved.
    pub fn later_solved(&self) -> usize {
        self.records.iter().filter(|record| record.later.solved()).count()
    }

    /// The median number of proposals of the later task.
    pub fn later_proposals(&self) -> f64 {
        median(self.records.iter().map(|record| record.later.proposals as f64)).unwrap_or_default()
    }

    /// Known mistakes made again in the later task, in all runs.
    pub fn repeated(&self) -> usize {
        self.records.iter().map(|record| record.repeated.len()).sum()
    }

    /// In how many runs the later task lifted exclusions, since nothing else was left.
    pub fn later_lifted(&self) -> usize {
        self.records.iter().filter(|record| record.later.lifted).count()
    }

    /// Calls that failed in both tasks with something else expected of them, in all runs.
    pub fn failed_otherwise(&self) -> usize {
        self.records.iter().map(|record| record.failed_otherwise.len()).sum()
    }
}

const COLUMNS: [&str; 16] = [
    "scenario",
    "goal",
    "restart",
    "possible",
    "runs",
    "solved",
    "proposals",
    "plan_length",
    "excluded",
    "imagined",
    "later_goal",
    "later_solved",
    "later_proposals",
    "later_lifted",
    "repeated_mistakes",
    "failed_otherwise",
];

impl FaultsResult {
    /// Each scenario with restart, then without.
    pub fn rows(&self) -> Vec<FaultRow<'_>> {
        let row = |scenario, restart| {
            let own = self.records.iter().filter(move |(run, _)| run_is(run, scenario, restart));
            FaultRow { scenario, restart, records: own.map(|(_, record)| record).collect() }
        };
        self.scenarios.iter().flat_map(|scenario| [true, false].map(|restart| row(scenario, restart))).collect()
    }

    /// `With restart 27 of 27 scenarios that have a solution were solved in every run, …`.
    pub fn summary(&self) -> String {
        let rows = self.rows();
        let counts = [true, false].map(|restart| {
            let possible = rows.iter().filter(|row| row.restart == restart && row.scenario.possible);
            let solved = possible.clone().filter(|row| row.solved() == row.records.len()).count();
            format!("{solved} of {}", possible.count())
        });
        let [with, without] = counts;
        let false_hope = rows.iter().filter(|row| !row.scenario.possible && row.solved() > 0).count();
        let repeated: usize = rows.iter().map(FaultRow::repeated).sum();
        let mut text = format!(
            "Of the scenarios in which a way is left, {with} were solved in every run with restart, {without} without; \
             {repeated} known mistakes were repeated in later tasks."
        );
        let lifted: usize = rows.iter().map(FaultRow::later_lifted).sum();
        let otherwise: usize = rows.iter().map(FaultRow::failed_otherwise).sum();
        if lifted > 0 {
            let _ = write!(
                text,
                " In {lifted} runs of later tasks nothing else was left and exclusions were lifted; {otherwise} calls \
                 that had failed then failed again, with something else expected of them."
            );
        }
        if false_hope > 0 {
            let _ = write!(text, " {false_hope} were solved in which no way was expected.");
        }
        text
    }

    fn csv(&self) -> String {
        let mut csv = Csv::new(&COLUMNS);
        for row in self.rows() {
            let [goal, later] = row.scenario.titles();
            csv.row([
                row.scenario.name.clone(),
                goal.to_owned(),
                u8::from(row.restart).to_string(),
                u8::from(row.scenario.possible).to_string(),
                row.records.len().to_string(),
                row.solved().to_string(),
                row.proposals().to_string(),
                optional(row.plan_length()),
                joined(row.excluded()),
                joined(row.imagined()),
                later.to_owned(),
                row.later_solved().to_string(),
                row.later_proposals().to_string(),
                row.later_lifted().to_string(),
                row.repeated().to_string(),
                row.failed_otherwise().to_string(),
            ]);
        }
        csv.into_text()
    }

    /// The experiment as JSON: the same as the file `faults.json`.
    pub fn json(&self) -> Value {
        let rows: Vec<Value> = self.rows().iter().map(row_json).collect();
        json!({
            "format": "lab-faults/1",
            "typelift": env!("CARGO_PKG_VERSION"),
            "runs": self.options.runs,
            "seed": self.options.seed,
            "limits": self.options.limits,
            "summary": self.summary(),
            "scenarios": rows,
        })
    }

    fn markdown(&self) -> String {
        let mut text = format!(
            "# Broken tools and exceptions\n\ngeneralized+imagined, {} runs of each scenario, rooms from seed {} on; {}.\n\n\
             `#p`: proposals, medians; `later`: solved runs and proposals of a later task that knows what failed.\n\n\
             | scenario | restart | solved | #p | length | excluded | imagined | later | repeated |\n\
             |---|---|---|---|---|---|---|---|---|\n",
            self.options.runs, self.options.seed, self.options.limits
        );
        for row in self.rows() {
            let _ = writeln!(
                text,
                "| {} | {} | {} of {} | {} | {} | {} | {} | {} in {} | {} |",
                row.scenario.name,
                if row.restart { "yes" } else { "no" },
                row.solved(),
                row.records.len(),
                row.proposals(),
                optional(row.plan_length()),
                joined(row.excluded()),
                joined(row.imagined()),
                row.later_solved(),
                row.later_proposals(),
                row.repeated()
            );
        }
        let _ = writeln!(text, "\n{}\n\n## What was not solved, and why\n", self.summary());
        for row in self.rows() {
            if let Some(why) = row.why() {
                let how = if row.restart { "with" } else { "without" };
                let _ = writeln!(text, "- {}, {how} restart: {why}", row.scenario.name);
            }
        }
        text
    }

    pub(super) fn write(&self, folder: &Path) -> Result<(), FileError> {
        write_file(&folder.join("faults.csv"), self.csv().as_bytes())?;
        write_file(&folder.join("faults.json"), format!("{:#}\n", self.json()).as_bytes())?;
        write_file(&folder.join("faults.md"), self.markdown().as_bytes())
    }
}

fn run_is(run: &crate::faults::FaultRun, scenario: &FaultScenario, restart: bool) -> bool {
    run.scenario == scenario.name && run.restart == restart
}

fn joined(words: BTreeSet<&str>) -> String {
    words.into_iter().collect::<Vec<_>>().join(", ")
}

fn row_json(row: &FaultRow<'_>) -> Value {
    json!({
        "scenario": row.scenario.name,
        "broken": row.scenario.broken,
        "goal": row.scenario.titles()[0],
        "later_goal": row.scenario.titles()[1],
        "restart": row.restart,
        "possible": row.scenario.possible,
        "solved": row.solved(),
        "proposals": row.proposals(),
        "plan_length": row.plan_length(),
        "excluded": row.excluded(),
        "imagined": row.imagined(),
        "why": row.why(),
        "later_solved": row.later_solved(),
        "later_proposals": row.later_proposals(),
        "later_lifted": row.later_lifted(),
        "repeated_mistakes": row.repeated(),
        "failed_otherwise": row.failed_otherwise(),
    })
}
