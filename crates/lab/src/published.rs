//! The published numbers. They live in `data/published.json`, each with the place where it stands in the paper.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::variant::Variant;

/// The paper's numbers.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Published {
    /// The paper.
    pub paper: String,
    /// What is learned from the eight demonstrations.
    pub learning: Learning,
    /// Table I.
    pub table: Table,
    /// The figure on the number of demonstrations.
    pub demonstrations: Demonstrations,
}

/// What is learned from the eight demonstrations.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct Learning {
    /// Where it stands.
    #[serde(rename = "where")]
    pub place: String,
    /// Transitions.
    pub transitions: u64,
    /// Individual actions.
    pub individual: usize,
    /// Generalized actions.
    pub generalized: usize,
}

/// Table I.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Table {
    /// Where it stands.
    #[serde(rename = "where")]
    pub place: String,
    /// What the four numbers of a cell are.
    pub columns: [String; 4],
    rows: Vec<Row>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Row {
    task: String,
    #[serde(flatten)]
    cells: BTreeMap<Variant, Option<(u64, f64, f64, usize)>>,
}

/// A cell of Table I in which a plan succeeded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PublishedCell {
    /// Plans proposed until one succeeded (`#p`).
    pub proposals: u64,
    /// The mean planning time in seconds.
    pub seconds_mean: f64,
    /// The standard deviation of the planning time in seconds.
    pub seconds_sd: f64,
    /// The length of the plan that succeeded (`|p|`).
    pub plan_length: usize,
}

/// What the paper's text says of the figure on the number of demonstrations.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct Demonstrations {
    /// Where it stands.
    #[serde(rename = "where")]
    pub place: String,
    /// The smallest and the largest number of demonstrations.
    pub sizes: [usize; 2],
    /// The numbers of demonstrations between which there is a big jump in performance.
    pub jump: [usize; 2],
    /// The number of demonstrations from which some subsets solve every task.
    pub complete_from: usize,
}

impl Table {
    /// The published cell; `None` where no plan succeeded.
    ///
    /// # Panics
    /// If the paper has no such task.
    pub fn cell(&self, task: &str, variant: Variant) -> Option<PublishedCell> {
        let row = self.rows.iter().find(|row| row.task == task).unwrap_or_else(|| panic!("{task} is not in Table I"));
        row.cells.get(&variant).copied().flatten().map(|(proposals, seconds_mean, seconds_sd, plan_length)| {
            PublishedCell { proposals, seconds_mean, seconds_sd, plan_length }
        })
    }
}

/// The paper's numbers.
///
/// # Panics
/// Never: the file is part of the program, and a test reads it.
pub fn published() -> Published {
    serde_json::from_str(include_str!("../data/published.json")).expect("the file is part of the program")
}

#[cfg(test)]
mod tests {
    use super::*;
    use typelift_kitchen::tasks;

    #[test]
    fn the_numbers_are_those_of_the_paper() {
        let published = published();
        let Learning { transitions, individual, generalized, .. } = published.learning;
        assert_eq!((transitions, individual, generalized), (68, 39, 13));
        let names: Vec<String> = tasks().into_iter().map(|task| task.name).collect();
        assert_eq!(published.table.rows.iter().map(|row| row.task.clone()).collect::<Vec<_>>(), names);
        assert!(published.table.rows.iter().all(|row| row.cells.len() == 4), "a cell for each variant");
        let solved = Variant::ALL
            .map(|variant| names.iter().filter(|task| published.table.cell(task, variant).is_some()).count());
        assert_eq!(solved, [24, 16, 13, 6]);
        let cell = published.table.cell("T5.4", Variant::IndividualImagined);
        let expected = PublishedCell { proposals: 9, seconds_mean: 46.45, seconds_sd: 0.40, plan_length: 15 };
        assert_eq!(cell, Some(expected));
    }
}
