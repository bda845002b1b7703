//! What `learn` says of what was learned.

use std::collections::BTreeMap;
use std::io::Write;

use serde::Serialize;
use typelift::learn;
use typelift::model::{LearnedModel, RefusedMerges, Symbol};
use typelift::words::{TypeNote, count, places, why_unexplained};

use crate::failure::Failure;
use crate::style::wrapped;

/// Notes about types that are printed; of a flat hierarchy there may be one for every parameter.
const MOST_NOTES: usize = 5;

/// What is printed with `--json`.
#[derive(Serialize)]
pub(crate) struct Report<'l> {
    traces: usize,
    transitions: u64,
    individual_actions: usize,
    generalized_actions: usize,
    failures: u64,
    refused_merges: usize,
    failures_against_merges: u64,
    unexplained: u64,
    single_support: usize,
    predicates: BTreeMap<Symbol, usize>,
    actions: Vec<Symbol>,
    notes: &'l [TypeNote],
}

impl<'l> Report<'l> {
    pub(crate) fn of(model: &'l LearnedModel, report: &learn::Report, notes: &'l [TypeNote]) -> Self {
        Self {
            traces: model.evidence.sources().len(),
            transitions: report.transitions,
            individual_actions: report.individual,
            generalized_actions: report.generalized,
            failures: report.failures,
            refused_merges: report.refused.pairs,
            failures_against_merges: report.refused.failures,
            unexplained: report.unexplained,
            single_support: report.single_support,
            predicates: model.model.predicates.iter().map(|(name, types)| (name.clone(), types.len())).collect(),
            actions: model.model.actions.iter().map(|action| action.name.clone()).collect(),
            notes,
        }
    }
}

/// What to say of pairs of actions that were not merged, if there are any.
pub(crate) fn refused_merges(refused: RefusedMerges) -> Option<String> {
    let RefusedMerges { pairs, failures } = refused;
    let speak = if failures == 1 { "speaks" } else { "speak" };
    (!refused.is_none()).then(|| {
        format!("{} not merged: {} {speak} against it", count(pairs as u64, "pair"), count(failures, "failure"))
    })
}

/// What was learned, in numbers and names, and what of it may not be meant.
pub(crate) fn print_counts(
    out: &mut impl Write,
    model: &LearnedModel,
    report: &learn::Report,
    notes: &[TypeNote],
) -> Result<(), Failure> {
    let traces = count(model.evidence.sources().len() as u64, "demonstration");
    writeln!(out, "{}, from {traces}", count(report.transitions, "transition"))?;
    writeln!(out, "{}", count(report.individual as u64, "individual action"))?;
    let generalized = count(report.generalized as u64, "generalized action");
    if report.generalized != report.individual {
        let names = model.model.actions.iter().map(|action| action.name.as_str());
        writeln!(out, "{generalized}:\n  {}", wrapped(names, 2, 80))?;
    }
    if let Some(line) = refused_merges(report.refused) {
        writeln!(out, "{line}")?;
    }
    if report.failures > 0 {
        writeln!(out, "{} not executed, or changed nothing", count(report.failures, "transition"))?;
    }
    for (reason, (times, witnesses)) in &model.evidence.total().unexplained {
        let places = places(witnesses, *times);
        let (transitions, reason) = (count(*times, "transition"), why_unexplained(*reason));
        writeln!(out, "{transitions} unexplained, {reason}: {places}")?;
    }
    for note in notes.iter().take(MOST_NOTES) {
        writeln!(out, "{}", note.text)?;
    }
    if notes.len() > MOST_NOTES {
        writeln!(out, "{} more like these", notes.len() - MOST_NOTES)?;
    }
    Ok(())
}
