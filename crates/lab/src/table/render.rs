//! The table as files: `table.csv`, `table.json`, `table.md`.

use std::fmt::Write;
use std::path::Path;

use serde_json::{Value, json};
use typelift::world::{FileError, write_file};

use crate::csv::{Csv, optional, seconds};
use crate::published::published;
use crate::statistics::median;
use crate::table::cell::{Cell, Comparison};
use crate::table::{TableOptions, TableResult};
use crate::variant::Variant;

const COLUMNS: [&str; 13] = [
    "task",
    "variant",
    "runs",
    "solved",
    "proposals",
    "plan_length",
    "seconds_mean",
    "seconds_sd",
    "ground_actions",
    "paper_solved",
    "paper_proposals",
    "paper_plan_length",
    "paper_seconds",
];

impl TableResult {
    /// How many cells compare so with the published ones.
    pub fn count(&self, comparison: Comparison) -> usize {
        self.cells.iter().filter(|cell| cell.comparison() == comparison).count()
    }

    /// How many cells are solved in all runs where the published one is, and in none where it is not.
    pub fn same_in_solved(&self) -> usize {
        self.cells.iter().filter(|cell| cell.is_solved() == Some(cell.published.is_some())).count()
    }

    /// `90 of 96 cells equal in #p and |p|, 6 better, 0 worse; 96 of 96 in solved or not.`
    pub fn summary(&self) -> String {
        let (all, better, worse) = (self.cells.len(), self.count(Comparison::Better), self.count(Comparison::Worse));
        let (equal, same) = (self.count(Comparison::Equal), self.same_in_solved());
        format!(
            "{equal} of {all} cells equal in #p and |p|, {better} better, {worse} worse; {same} of {all} in solved or not."
        )
    }

    /// The median number of ground actions of the cells of a variant.
    pub fn ground_actions(&self, variant: Variant) -> f64 {
        let own = self.cells.iter().filter(|cell| cell.variant == variant);
        median(own.map(|cell| cell.ground_actions)).unwrap_or_default()
    }

    /// The tasks, each with its four cells.
    pub fn rows(&self) -> impl Iterator<Item = (&str, &[Cell])> {
        self.cells.chunks(Variant::ALL.len()).map(|row| (row[0].task.as_str(), row))
    }

    /// `#p/|p|` of every cell, in brackets the published one where it differs, and the summary, as Markdown.
    pub fn markdown_cells(&self) -> String {
        let head = Variant::ALL.map(Variant::name).join(" | ");
        let mut text = format!("| task | {head} |\n|---|---|---|---|---|\n");
        for (task, row) in self.rows() {
            let cells: Vec<String> = row.iter().map(beside).collect();
            let _ = writeln!(text, "| {task} | {} |", cells.join(" | "));
        }
        let _ = writeln!(text, "\n{}", self.summary());
        text
    }

    fn markdown(&self) -> String {
        let TableOptions { runs, seed, limits, .. } = self.options;
        let mut text = format!(
            "# Table I, ours and the paper's\n\n{}\n\n{runs} runs of each cell, rooms from seed {seed} on; {limits}.\n\n\
             `#p/|p|`: plans proposed until one succeeded, and its length, medians of the solved runs. In brackets the\n\
             published cell where ours differs; `-`: no plan succeeded.\n\n",
            published().paper,
        );
        text += &self.markdown_cells();
        text += "\n## Planning time in seconds, mean ± standard deviation, and the paper's\n\n";
        let head = Variant::ALL.map(Variant::name).join(" | ");
        let _ = writeln!(text, "| task | {head} |\n|---|---|---|---|---|");
        for (task, row) in self.rows() {
            let cells: Vec<String> = row.iter().map(times).collect();
            let _ = writeln!(text, "| {task} | {} |", cells.join(" | "));
        }
        text += "\n## Actions\n\n| variant | learned | paper | ground, median over the tasks |\n|---|---|---|---|\n";
        let learning = published().learning;
        for variant in Variant::ALL {
            let paper = if variant.individual() { learning.individual } else { learning.generalized };
            let _ = writeln!(
                text,
                "| {variant} | {} | {paper} | {} |",
                self.actions[&variant],
                self.ground_actions(variant)
            );
        }
        let _ =
            writeln!(text, "\nLearned from {} transitions; the paper has {}.", self.transitions, learning.transitions);
        text
    }

    fn csv(&self) -> String {
        let mut csv = Csv::new(&COLUMNS);
        for cell in &self.cells {
            csv.row([
                cell.task.clone(),
                cell.variant.to_string(),
                cell.runs.to_string(),
                cell.solved.to_string(),
                optional(cell.proposals),
                optional(cell.plan_length),
                seconds(cell.seconds.map(|(mean, _)| mean)),
                seconds(cell.seconds.map(|(_, sd)| sd)),
                cell.ground_actions.to_string(),
                u8::from(cell.published.is_some()).to_string(),
                optional(cell.published.map(|paper| paper.proposals)),
                optional(cell.published.map(|paper| paper.plan_length)),
                optional(cell.published.map(|paper| paper.seconds_mean)),
            ]);
        }
        csv.into_text()
    }

    /// The table as JSON: the same as the file `table.json`.
    pub fn json(&self) -> Value {
        let cells: Vec<Value> = self.cells.iter().map(cell_json).collect();
        let learned: Vec<Value> = Variant::ALL
            .iter()
            .map(|variant| {
                json!({
                    "variant": variant,
                    "learned": self.actions[variant],
                    "ground_actions": self.ground_actions(*variant),
                })
            })
            .collect();
        json!({
            "format": "lab-table/1",
            "typelift": env!("CARGO_PKG_VERSION"),
            "runs": self.options.runs,
            "seed": self.options.seed,
            "limits": self.options.limits,
            "transitions": self.transitions,
            "actions": learned,
            "summary": {
                "cells": self.cells.len(),
                "equal": self.count(Comparison::Equal),
                "better": self.count(Comparison::Better),
                "worse": self.count(Comparison::Worse),
                "same_in_solved": self.same_in_solved(),
            },
            "cells": cells,
        })
    }

    pub(super) fn write(&self, folder: &Path) -> Result<(), FileError> {
        write_file(&folder.join("table.csv"), self.csv().as_bytes())?;
        write_file(&folder.join("table.json"), format!("{:#}\n", self.json()).as_bytes())?;
        write_file(&folder.join("table.md"), self.markdown().as_bytes())
    }
}

/// `#p/|p|`, and the published cell where it differs.
fn beside(cell: &Cell) -> String {
    if cell.comparison() == Comparison::Equal {
        cell.text()
    } else {
        format!("{} ({})", cell.text(), cell.published_text())
    }
}

fn times(cell: &Cell) -> String {
    let ours = cell.seconds.map_or("-".to_owned(), |(mean, sd)| format!("{mean:.3} ± {sd:.3}"));
    match cell.published {
        Some(paper) => format!("{ours} ({} ± {})", paper.seconds_mean, paper.seconds_sd),
        None => format!("{ours} (-)"),
    }
}

fn cell_json(cell: &Cell) -> Value {
    let verdict = match cell.comparison() {
        Comparison::Equal => "equal",
        Comparison::Better => "better",
        Comparison::Worse => "worse",
    };
    let paper = cell.published.map(|paper| {
        json!({
            "proposals": paper.proposals,
            "plan_length": paper.plan_length,
            "seconds_mean": paper.seconds_mean,
            "seconds_sd": paper.seconds_sd,
        })
    });
    json!({
        "task": cell.task,
        "variant": cell.variant,
        "runs": cell.runs,
        "solved": cell.solved,
        "out_of_time": cell.out_of_time,
        "proposals": cell.proposals,
        "plan_length": cell.plan_length,
        "imagined_steps": cell.imagined_steps,
        "seconds_mean": cell.seconds.map(|(mean, _)| mean),
        "seconds_sd": cell.seconds.map(|(_, sd)| sd),
        "ground_actions": cell.ground_actions,
        "expansions": cell.expansions,
        "paper": paper,
        "verdict": verdict,
    })
}
