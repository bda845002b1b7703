//! The paper's claims, each with the number that the results give for it. They live in `data/claims.json`, in our words
//! and with the place where each stands.

use serde::{Deserialize, Serialize};

use super::results::{Cell, Demonstrations, Faults, Results, Scenario, Table};
use crate::variant::Variant;
use crate::variant::Variant::{Generalized, GeneralizedImagined, Individual, IndividualImagined};

/// A claim.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Claim {
    /// What it is called here.
    pub id: String,
    /// Where it stands in the paper.
    #[serde(rename = "where")]
    pub place: String,
    /// The claim.
    pub claim: String,
}

/// A claim held against the results.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Judged {
    /// The claim.
    #[serde(flatten)]
    pub claim: Claim,
    /// Our number in words, and whether the claim held; nothing if it was not measured.
    pub finding: Option<Finding>,
}

/// What the results say of a claim.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Our number, in words.
    pub ours: String,
    /// Whether the claim held.
    pub held: bool,
}

/// Tasks in a set, and in all sets.
const TASKS: (usize, usize) = (4, 24);
/// The steps of the longest demonstration.
const LONGEST: f64 = 15.0;

/// The claims.
///
/// # Panics
/// Never: the file is part of the program, and a test reads it.
pub fn claims() -> Vec<Claim> {
    serde_json::from_str(include_str!("../../data/claims.json")).expect("the file is part of the program")
}

/// Every claim with what the results say of it.
pub fn judge(results: &Results) -> Vec<Judged> {
    claims().into_iter().map(|claim| Judged { finding: finding(&claim.id, results), claim }).collect()
}

fn finding(id: &str, results: &Results) -> Option<Finding> {
    let Results { table, demonstrations, faults, hierarchy, .. } = results;
    match id {
        "cutting" => {
            let row = hierarchy.as_ref()?.parameters.iter().find(|p| p.action == "USE-cutboard-food" && p.risen())?;
            let ours = format!("{} of {}: from {}", row.parameter, row.action, row.observed.join(", "));
            Some(Finding { ours, held: row.observed == ["banana", "lettuce", "onion", "tomato"] && row.ty == "food" })
        }
        "broken" | "exception" | "repeat" => of_faults(id, faults.as_ref()?),
        "more-demonstrations" | "jump" | "complete" => of_demonstrations(id, demonstrations.as_ref()?),
        _ => of_learning(id, table.as_ref()?)
            .or_else(|| of_sets(id, table.as_ref()?))
            .or_else(|| of_all(id, table.as_ref()?)),
    }
}

fn of_learning(id: &str, table: &Table) -> Option<Finding> {
    let learned = |variant| table.actions.iter().find(|a| a.variant == variant).map(|a| a.learned);
    let (ours, paper) = match id {
        "transitions" => (table.transitions, 68),
        "individual" => (learned(Individual)?, 39),
        "generalized" => (learned(Generalized)?, 13),
        _ => return None,
    };
    Some(Finding { ours: ours.to_string(), held: ours == paper })
}

impl Table {
    /// The cells of a set of tasks, as `T2`, and a variant; nothing unless all were run.
    fn set(&self, set: &str, variant: Variant) -> Option<Vec<&Cell>> {
        let cells: Vec<&Cell> = self.cells.iter().filter(|c| c.variant == variant && c.task.starts_with(set)).collect();
        (cells.len() == if set == "T" { TASKS.1 } else { TASKS.0 }).then_some(cells)
    }

    fn solved(&self, set: &str, variant: Variant) -> Option<usize> {
        Some(self.set(set, variant)?.iter().filter(|cell| cell.is_solved()).count())
    }

    /// The mean of a number over the solved tasks of a set.
    fn mean(&self, set: &str, variant: Variant, of: fn(&Cell) -> Option<f64>) -> Option<f64> {
        let cells = self.set(set, variant)?;
        let values: Option<Vec<f64>> = cells.into_iter().filter(|cell| cell.is_solved()).map(of).collect();
        let values = values.filter(|values| !values.is_empty())?;
        Some(values.iter().sum::<f64>() / values.len() as f64)
    }
}

/// `generalized 4, individual 2 of 4`.
fn counts(solved: &[(Variant, usize)], of: usize) -> String {
    let words: Vec<String> = solved.iter().map(|(variant, n)| format!("{variant} {n}")).collect();
    format!("{} of {of}", words.join(", "))
}

fn of_sets(id: &str, table: &Table) -> Option<Finding> {
    let solved = |set: &str| -> Option<[usize; 4]> {
        let [a, b, c, d] = Variant::ALL.map(|variant| table.solved(set, variant));
        Some([a?, b?, c?, d?])
    };
    let set = |set: &str, held: fn([usize; 4]) -> bool| {
        let solved = solved(set)?;
        let named: Vec<(Variant, usize)> = Variant::ALL.into_iter().zip(solved).collect();
        Some(Finding { ours: counts(&named, TASKS.0), held: held(solved) })
    };
    match id {
        "s1-all" => set("T1", |solved| solved == [4; 4]),
        "s2" => set("T2", |[gi, g, _, i]| gi == 4 && g == 4 && i < 4),
        "s2-imagine" => set("T2", |[_, _, ii, i]| ii == i),
        "s3" => set("T3", |[gi, g, ii, i]| gi == 4 && g == 4 && ii == 0 && i == 0),
        "s4" => set("T4", |[gi, g, _, i]| gi == 4 && g == 0 && i == 0),
        "s5" => set("T5", |[gi, g, _, _]| gi == 4 && g == 4),
        "s6" => set("T6", |solved| solved == [4, 0, 0, 0]),
        "s1-time" => {
            let [g, i] = [Generalized, Individual].map(|v| table.mean("T1", v, |cell| cell.seconds_mean));
            let (g, i) = (g?, i?);
            Some(Finding { ours: format!("individual {:.2} ms, generalized {:.2} ms", i * 1e3, g * 1e3), held: i < g })
        }
        "s1-ground" => {
            let [g, i] = [Generalized, Individual].map(|v| table.mean("T1", v, |cell| Some(cell.ground_actions)));
            let (g, i) = (g?, i?);
            let learned = |variant| table.actions.iter().find(|a| a.variant == variant).map(|a| a.learned);
            let (of_g, of_i) = (learned(Generalized)?, learned(Individual)?);
            let ours = format!("individual {i:.0} ground of {of_i} learned, generalized {g:.0} of {of_g}");
            Some(Finding { ours, held: i < g && of_i > of_g })
        }
        "s2-longer" => longer(table),
        "s3-length" => {
            let longest = |cells: Vec<&Cell>| cells.iter().filter_map(|cell| cell.plan_length).fold(0.0, f64::max);
            let longest = longest(table.set("T3", Generalized)?);
            Some(Finding { ours: format!("up to {longest} steps"), held: longest > LONGEST })
        }
        "s4-proposals" => {
            let cells = table.set("T4", IndividualImagined)?;
            let most = cells.iter().filter_map(|cell| cell.proposals).fold(0.0, f64::max);
            Some(Finding { ours: format!("individual+imagined up to {most}"), held: most > 1.0 })
        }
        "s5-cost" => {
            let of = |variant| {
                Some((table.mean("T5", variant, |c| c.seconds_mean)?, table.mean("T5", variant, |c| c.proposals)?))
            };
            let ((g, g_p), (ii, ii_p)) = (of(Generalized)?, of(IndividualImagined)?);
            let ours =
                format!("generalized {:.1} ms, #p {g_p}; individual+imagined {:.1} ms, #p {ii_p}", g * 1e3, ii * 1e3);
            Some(Finding { ours, held: g < ii && g_p < ii_p })
        }
        _ => None,
    }
}

/// On S2 the plans of individual actions beside those of generalized ones.
fn longer(table: &Table) -> Option<Finding> {
    let (own, others) = (table.set("T2", Individual)?, table.set("T2", Generalized)?);
    let both = own.iter().zip(others).filter(|(own, other)| own.is_solved() && other.is_solved());
    let pairs: Vec<(f64, f64)> = both.filter_map(|(own, other)| own.plan_length.zip(other.plan_length)).collect();
    let words: Vec<String> = pairs.iter().map(|(own, other)| format!("{own} to {other}")).collect();
    let held = !pairs.is_empty() && pairs.iter().all(|(own, other)| own > other);
    Some(Finding { ours: format!("{} steps", words.join(", ")), held })
}

fn of_all(id: &str, table: &Table) -> Option<Finding> {
    let best = table.set("T", GeneralizedImagined)?;
    let all: Vec<&Cell> = Variant::ALL.into_iter().filter_map(|variant| table.set("T", variant)).flatten().collect();
    let (count, of) = match id {
        "cells" => (all.iter().filter(|cell| cell.is_solved_as_published()).count(), TASKS.1 * 4),
        "numbers" => (all.iter().filter(|cell| cell.is_as_published()).count(), TASKS.1 * 4),
        "all" => (best.iter().filter(|cell| cell.is_solved()).count(), TASKS.1),
        "first" => (best.iter().filter(|cell| cell.is_solved() && cell.proposals == Some(1.0)).count(), TASKS.1),
        "time" => {
            let times: Option<Vec<f64>> = best.iter().map(|cell| cell.seconds_mean).collect();
            let longest = times?.into_iter().fold(0.0, f64::max);
            return Some(Finding {
                ours: format!("at most {:.1} ms on average", longest * 1e3),
                held: longest < 120.0,
            });
        }
        _ => return None,
    };
    Some(Finding { ours: format!("{count} of {of}"), held: count == of })
}

fn of_demonstrations(id: &str, demonstrations: &Demonstrations) -> Option<Finding> {
    let of_best = demonstrations.variants.iter().find(|v| v.variant == GeneralizedImagined)?;
    let sizes: Vec<_> =
        (2..=8).map(|n| of_best.sizes.iter().find(|size| size.demonstrations == n)).collect::<Option<_>>()?;
    let medians: Vec<f64> = sizes.iter().map(|size| size.solved_median).collect();
    let list = |numbers: &[f64]| numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    match id {
        "more-demonstrations" => {
            let rises = |numbers: &[f64]| numbers.windows(2).all(|pair| pair[0] <= pair[1]);
            let [least, most] = [
                sizes.iter().map(|size| size.solved_min as f64).collect::<Vec<_>>(),
                sizes.iter().map(|size| size.solved_max as f64).collect::<Vec<_>>(),
            ];
            let ours = format!("2 to 8: median {}; least {}; most {}", list(&medians), list(&least), list(&most));
            Some(Finding { ours, held: rises(&medians) && rises(&least) && rises(&most) })
        }
        "jump" => {
            let steps: Vec<f64> = medians.windows(2).map(|pair| pair[1] - pair[0]).collect();
            let biggest = (0..steps.len()).max_by(|&a, &b| steps[a].total_cmp(&steps[b]).then(b.cmp(&a)))?;
            let ours =
                format!("from {} to {}: {} to {}", biggest + 2, biggest + 3, medians[biggest], medians[biggest + 1]);
            Some(Finding { ours, held: biggest == 2 })
        }
        "complete" => {
            let first = sizes.iter().find(|size| size.complete > 0);
            let ours = first.map_or("no subset does".to_owned(), |size| {
                format!("from {}: {} of {} subsets", size.demonstrations, size.complete, size.solved.len())
            });
            Some(Finding { ours, held: sizes[3].complete > 0 })
        }
        _ => None,
    }
}

/// The paper sets the world back after a failure. Where no healthy tool of the kind is left, nothing can be proposed.
fn of_faults(id: &str, faults: &Faults) -> Option<Finding> {
    if id == "repeat" {
        let repeated: u64 = faults.scenarios.iter().map(|scenario| scenario.repeated_mistakes).sum();
        let ours = format!("{repeated} known mistakes made again in later tasks");
        return Some(Finding { ours, held: repeated == 0 });
    }
    let mine = |s: &&Scenario| s.broken.is_empty() == (id == "exception") && s.restart && s.possible;
    let scenarios: Vec<&Scenario> = faults.scenarios.iter().filter(mine).collect();
    let solved = scenarios.iter().filter(|scenario| scenario.solved == faults.runs).count();
    let count = scenarios.len();
    (count > 0)
        .then(|| Finding { ours: format!("{solved} of {count} scenarios with a way left"), held: solved == count })
}
