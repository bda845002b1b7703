//! A cell of the table: the runs of a task and a variant, and how they compare with the published cell.

use std::collections::BTreeMap;

use typelift_kitchen::KitchenTask;

use crate::attempt::is_out_of_time;
use crate::published::{PublishedCell, published};
use crate::statistics::{mean_and_sd, median};
use crate::table::{TableRecord, TableRun};
use crate::variant::Variant;

/// The runs of a task and a variant.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The task.
    pub task: String,
    /// The variant.
    pub variant: Variant,
    /// The runs.
    pub runs: usize,
    /// How many of them were solved.
    pub solved: usize,
    /// How many were ended by the clock, and so depend on the machine.
    pub out_of_time: usize,
    /// The median number of proposals of the solved runs (`#p`).
    pub proposals: Option<f64>,
    /// The median length of the plans that succeeded (`|p|`).
    pub plan_length: Option<f64>,
    /// The median number of imagined steps in them.
    pub imagined_steps: Option<f64>,
    /// Mean and standard deviation of the planning time of all runs, in seconds, if it was measured.
    pub seconds: Option<(f64, f64)>,
    /// The median number of ground actions.
    pub ground_actions: f64,
    /// The median number of expansions.
    pub expansions: f64,
    /// The published cell; `None` where no plan succeeded.
    pub published: Option<PublishedCell>,
}

/// How a cell compares with the published one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// The same in solved or not, `#p` and `|p|`.
    Equal,
    /// Solved where the published one is not, or with fewer proposals or a shorter plan and more of neither.
    Better,
    /// Anything else.
    Worse,
}

impl Cell {
    /// Whether every run was solved, or none was; `None` if some were.
    pub fn is_solved(&self) -> Option<bool> {
        match self.solved {
            0 => Some(false),
            n if n == self.runs => Some(true),
            _ => None,
        }
    }

    /// How it compares with the published cell.
    pub fn comparison(&self) -> Comparison {
        let (Some(proposals), Some(length)) = (self.proposals, self.plan_length) else {
            return if self.published.is_none() { Comparison::Equal } else { Comparison::Worse };
        };
        let Some(published) = self.published else {
            return Comparison::Better;
        };
        if self.is_solved().is_none() {
            return Comparison::Worse;
        }
        let (p, l) = (published.proposals as f64, published.plan_length as f64);
        if (proposals, length) == (p, l) {
            Comparison::Equal
        } else if proposals <= p && length <= l {
            Comparison::Better
        } else {
            Comparison::Worse
        }
    }

    /// `#p/|p|`, with the solved runs in front if only some are; `-` if none is.
    pub fn text(&self) -> String {
        match (self.proposals, self.plan_length) {
            (Some(proposals), Some(length)) if self.is_solved().is_none() => {
                format!("{} of {}: {proposals}/{length}", self.solved, self.runs)
            }
            (Some(proposals), Some(length)) => format!("{proposals}/{length}"),
            _ => "-".to_owned(),
        }
    }

    /// The same of the published cell.
    pub fn published_text(&self) -> String {
        self.published.map_or("-".to_owned(), |cell| format!("{}/{}", cell.proposals, cell.plan_length))
    }
}

/// The cells of these tasks, from the records of their runs.
pub(super) fn cells(tasks: &[KitchenTask], records: &BTreeMap<TableRun, TableRecord>) -> Vec<Cell> {
    let published = published().table;
    let mut cells = Vec::with_capacity(tasks.len() * Variant::ALL.len());
    for task in tasks {
        for variant in Variant::ALL {
            let own = records.iter().filter(|(run, _)| run.task == task.name && run.variant == variant);
            let own: Vec<&TableRecord> = own.map(|(_, record)| record).collect();
            let solved: Vec<&TableRecord> = own.iter().copied().filter(|record| record.plan_length.is_some()).collect();
            let seconds: Vec<f64> = own.iter().filter_map(|record| record.seconds).collect();
            cells.push(Cell {
                task: task.name.clone(),
                variant,
                runs: own.len(),
                solved: solved.len(),
                out_of_time: own.iter().filter(|record| is_out_of_time(&record.ending)).count(),
                proposals: median(solved.iter().map(|record| record.proposals as f64)),
                plan_length: median(solved.iter().filter_map(|record| record.plan_length).map(|n| n as f64)),
                imagined_steps: median(solved.iter().filter_map(|record| record.imagined_steps).map(|n| n as f64)),
                seconds: mean_and_sd(&seconds),
                ground_actions: median(own.iter().map(|record| record.ground_actions as f64)).unwrap_or_default(),
                expansions: median(own.iter().map(|record| record.expansions as f64)).unwrap_or_default(),
                published: published.cell(&task.name, variant),
            });
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use typelift_kitchen::tasks;

    fn record(found: Found, seconds: f64) -> TableRecord {
        TableRecord {
            ending: if found.is_some() { "solved" } else { "no plan" }.to_owned(),
            proposals: found.map_or(1, |(proposals, _)| proposals),
            plan_length: found.map(|(_, length)| length),
            imagined_steps: found.map(|_| 0),
            expansions: 10,
            ground_actions: 20,
            seconds: Some(seconds),
        }
    }

    /// `#p` and `|p|` of a run.
    type Found = Option<(u64, usize)>;

    /// The cell of T4.3, individual+imagined, which is published as 8/15, from these runs.
    fn cell(runs: &[Found]) -> Cell {
        let task = tasks().into_iter().find(|task| task.name == "T4.3").expect("a task");
        let run = |seed| TableRun { task: "T4.3".to_owned(), variant: Variant::IndividualImagined, seed };
        let records =
            runs.iter().enumerate().map(|(seed, found)| (run(seed as u64), record(*found, seed as f64))).collect();
        let all = cells(&[task], &records);
        all.into_iter().find(|cell| cell.variant == Variant::IndividualImagined).expect("a cell")
    }

    #[test]
    fn cells_compare_with_published_ones() {
        let cases: [(&[Found], &str, Comparison); 6] = [
            (&[Some((8, 15)), Some((8, 15))], "8/15", Comparison::Equal),
            (&[Some((1, 15)), Some((3, 15)), Some((2, 15))], "2/15", Comparison::Better),
            (&[Some((8, 13)), Some((8, 15))], "8/14", Comparison::Better),
            (&[Some((1, 16)), Some((1, 16))], "1/16", Comparison::Worse),
            (&[Some((8, 15)), None], "1 of 2: 8/15", Comparison::Worse),
            (&[None, None], "-", Comparison::Worse),
        ];
        for (runs, text, verdict) in cases {
            let cell = cell(runs);
            assert_eq!((cell.text().as_str(), cell.comparison()), (text, verdict), "{runs:?}");
            assert_eq!(cell.published_text(), "8/15");
        }
        let (mean, sd) = cell(&[None, None, None]).seconds.expect("measured");
        assert_eq!((mean, sd), (1.0, 1.0), "of all runs, also if none is solved");
    }

    #[test]
    fn where_nothing_is_published_nothing_is_equal_and_something_better() {
        let mut cell = cell(&[None]);
        cell.published = None;
        assert_eq!((cell.comparison(), cell.published_text().as_str()), (Comparison::Equal, "-"));
        (cell.solved, cell.proposals, cell.plan_length) = (1, Some(1.0), Some(5.0));
        assert_eq!(cell.comparison(), Comparison::Better);
    }
}
