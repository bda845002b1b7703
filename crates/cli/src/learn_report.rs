//! What `learn` says of what was learned.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;

use serde::Serialize;
use typelift::learn;
use typelift::model::{LearnedModel, Observations, RefusedMerges, Symbol, WITNESS_BOUND, Witness};
use typelift::words::{TypeNote, count, places, why_unexplained};

use crate::failure::Failure;
use crate::style::wrapped;

/// Notes about types that are printed; of a flat hierarchy there may be one for every parameter.
const MOST_NOTES: usize = 5;

/// Pairs of actions that were not merged and are named.
const MOST_PAIRS: usize = 6;

/// Calls whose failures are placed.
const MOST_CALLS: usize = 6;

/// What is printed with `--json`.
#[derive(Serialize)]
pub(crate) struct Report<'l> {
    traces: usize,
    transitions: u64,
    individual_actions: usize,
    generalized_actions: usize,
    failures: u64,
    failed: BTreeMap<Symbol, Failed>,
    refused_merges: usize,
    failures_against_merges: u64,
    not_merged: BTreeMap<Symbol, Vec<Witness>>,
    not_merged_pairs: &'l [[Symbol; 2]],
    unexplained: u64,
    single_support: usize,
    predicates: BTreeMap<Symbol, usize>,
    actions: Vec<Symbol>,
    notes: &'l [TypeNote],
}

/// How often a call was not executed or changed nothing, and some places where.
#[derive(Default, Serialize)]
struct Failed {
    times: u64,
    places: BTreeSet<Witness>,
}

/// What failed, by call.
fn failed(observations: &Observations) -> BTreeMap<Symbol, Failed> {
    let mut failed: BTreeMap<Symbol, Failed> = BTreeMap::new();
    for (key, seen) in &observations.negatives {
        let of_call = failed.entry(key.action.clone()).or_default();
        of_call.times += seen.count;
        of_call.places.extend(seen.witnesses.iter().cloned());
    }
    for of_call in failed.values_mut() {
        of_call.places = std::mem::take(&mut of_call.places).into_iter().take(WITNESS_BOUND).collect();
    }
    failed
}

fn listed(against: &BTreeMap<Symbol, learn::FailuresAgainst>) -> BTreeMap<Symbol, Vec<Witness>> {
    against.iter().map(|(call, failures)| (call.clone(), failures.places.iter().cloned().collect())).collect()
}

/// `open-box and open-chest, open-box and open-safe`; of many pairs the first.
fn pairs(pairs: &[[Symbol; 2]]) -> String {
    let named = pairs.iter().take(MOST_PAIRS).map(|[one, other]| format!("{one} and {other}"));
    let more = pairs.len().saturating_sub(MOST_PAIRS);
    named.chain((more > 0).then(|| format!("{more} more"))).collect::<Vec<_>>().join(", ")
}

/// `open a.jsonl step 3; press b.jsonl step 1 and 4 more`; of many calls the first.
fn by_call<'f>(failed: impl ExactSizeIterator<Item = (&'f Symbol, String)>) -> String {
    let more = failed.len().saturating_sub(MOST_CALLS);
    let mut calls: Vec<String> = failed.take(MOST_CALLS).map(|(call, places)| format!("{call} {places}")).collect();
    if more > 0 {
        calls.push(format!("and {} more", count(more as u64, "action")));
    }
    calls.join("; ")
}

impl<'l> Report<'l> {
    pub(crate) fn of(model: &'l LearnedModel, report: &'l learn::Report, notes: &'l [TypeNote]) -> Self {
        Self {
            traces: model.evidence.sources().len(),
            transitions: report.transitions,
            individual_actions: report.individual,
            generalized_actions: report.generalized,
            failures: report.failures,
            failed: failed(&model.evidence.total()),
            refused_merges: report.refused.pairs,
            failures_against_merges: report.refused.failures,
            not_merged: listed(&report.against_merges),
            not_merged_pairs: &report.not_merged,
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
        let against = report.against_merges.iter();
        let against = by_call(against.map(|(call, failures)| (call, places(&failures.places, failures.times))));
        writeln!(out, "{line}: {against}")?;
        writeln!(out, "  {}", wrapped(pairs(&report.not_merged).split(' '), 2, 80))?;
    }
    if report.failures > 0 {
        let failed = failed(&model.evidence.total());
        let by_call = by_call(failed.iter().map(|(call, Failed { times, places: seen })| (call, places(seen, *times))));
        writeln!(out, "{} not executed, or changed nothing: {by_call}", count(report.failures, "transition"))?;
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
