//! The sections of the report, each from the results of one experiment.

use super::html::{figures, paragraph, table, wide_figure};
use super::results::{Cell, Demonstrations, Faults, Lifelong, Results, Table};
use crate::figure::{Column, Violins, violin};
use crate::growth::GrowthResult;
use crate::hierarchy::TypeHierarchy;
use crate::variant::Variant;

/// The experiment, its heading, and what there is to show; nothing if it was not run.
pub(super) fn sections(results: &Results) -> Vec<(&'static str, &'static str, Option<String>)> {
    vec![
        ("table", "Table I", results.table.as_ref().map(of_table)),
        ("demonstrations", "The number of demonstrations", results.demonstrations.as_ref().map(of_demonstrations)),
        ("faults", "Broken tools and exceptions", results.faults.as_ref().map(of_faults)),
        ("hierarchy", "The hierarchy", results.hierarchy.as_ref().map(of_hierarchy)),
        ("growth", "Growth", results.growth.as_ref().map(of_growth)),
        ("lifelong", "Learning along a life", results.lifelong.as_ref().map(of_lifelong)),
    ]
}

/// `1 run`, `5 runs`.
fn runs(count: u64) -> String {
    format!("{count} run{}", if count == 1 { "" } else { "s" })
}

fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// `1/16`, and the published cell where it differs.
fn cell_text(cell: &Cell) -> String {
    let shown = |proposals: Option<f64>, length: Option<f64>| match proposals.zip(length) {
        Some((proposals, length)) => format!("{}/{}", number(proposals), number(length)),
        None => "-".to_owned(),
    };
    let ours = if cell.solved == 0 { "-".to_owned() } else { shown(cell.proposals, cell.plan_length) };
    let some = if cell.solved == 0 || cell.is_solved() {
        String::new()
    } else {
        format!(", {} of {} runs", cell.solved, cell.runs)
    };
    let paper = cell.paper.as_ref();
    if cell.is_as_published() {
        ours
    } else {
        let published = shown(paper.map(|p| p.proposals), paper.map(|p| p.plan_length));
        format!("{ours}{some} ({published})")
    }
}

/// `3.1 (1270)`: milliseconds, ours and the published ones.
fn time_text(cell: &Cell) -> String {
    let of = |seconds: Option<f64>| seconds.map_or("-".to_owned(), |s| format!("{:.1}", s * 1e3));
    let paper = cell.paper.as_ref().map_or("-".to_owned(), |paper| format!("{:.0}", paper.seconds_mean * 1e3));
    format!("{} ({paper})", of(cell.seconds_mean))
}

fn of_table(result: &Table) -> String {
    let head: Vec<&str> = std::iter::once("task").chain(Variant::ALL.map(Variant::name)).collect();
    let rows = |text: fn(&Cell) -> String| -> Vec<Vec<String>> {
        let mut tasks: Vec<&str> = result.cells.iter().map(|cell| cell.task.as_str()).collect();
        tasks.dedup();
        let row = |task: &str| {
            let of = |variant| result.cells.iter().find(|c| c.task == task && c.variant == variant).map(text);
            let cells = Variant::ALL.map(|variant| of(variant).unwrap_or_default());
            std::iter::once(task.to_owned()).chain(cells).collect()
        };
        tasks.into_iter().map(row).collect()
    };
    let mut html = paragraph(&format!(
        "Plans proposed until one succeeded / its length, medians of {} in rooms from seed {} on; in brackets the \
         published cell where ours differs; - where no plan succeeded.",
        runs(result.runs),
        result.seed
    ));
    html += &table("", &head, &[1, 2, 3, 4], &rows(cell_text));
    if result.cells.iter().any(|cell| cell.seconds_mean.is_some()) {
        html += &paragraph("Planning time in milliseconds, mean of all runs, and the published one in brackets.");
        html += &table("", &head, &[1, 2, 3, 4], &rows(time_text));
    }
    html
}

/// The violins of a variant, a panel each.
pub(super) fn panels(result: &Demonstrations) -> Vec<Violins> {
    let of = |variant: &super::results::OfVariant| {
        let column = |size: &super::results::Size| Column {
            label: size.demonstrations.to_string(),
            values: size.solved.iter().map(|solved| *solved as f64 / result.tasks.max(1) as f64).collect(),
        };
        Violins { title: variant.variant.to_string(), columns: variant.sizes.iter().map(column).collect() }
    };
    result.variants.iter().map(of).collect()
}

fn of_demonstrations(result: &Demonstrations) -> String {
    let vertical = format!("fraction of {} tasks solved", result.tasks);
    let mut html = paragraph(&format!(
        "A model from every subset of the demonstrations, tested on {} tasks; seed {}.",
        result.tasks, result.seed
    ));
    html += &figures(panels(result).iter().map(|panel| violin(panel, "demonstrations", &vertical)));
    let row = |variant: Variant, size: &super::results::Size| {
        vec![
            variant.to_string(),
            size.demonstrations.to_string(),
            size.solved.len().to_string(),
            size.solved_min.to_string(),
            number(size.solved_median),
            size.solved_max.to_string(),
            size.complete.to_string(),
        ]
    };
    let rows: Vec<Vec<String>> =
        result.variants.iter().flat_map(|v| v.sizes.iter().map(move |size| row(v.variant, size))).collect();
    let head = ["variant", "demonstrations", "subsets", "least solved", "median", "most", "subsets that solve all"];
    html += &table("", &head, &[1, 2, 3, 4, 5, 6], &rows);
    html
}

fn of_faults(result: &Faults) -> String {
    let row = |scenario: &super::results::Scenario| {
        vec![
            scenario.scenario.clone(),
            if scenario.restart { "yes" } else { "no" }.to_owned(),
            if scenario.possible { "yes" } else { "no" }.to_owned(),
            format!("{} of {}", scenario.solved, result.runs),
            number(scenario.proposals),
            scenario.plan_length.map(number).unwrap_or_default(),
            scenario.excluded.join(", "),
            scenario.repeated_mistakes.to_string(),
        ]
    };
    let rows: Vec<Vec<String>> = result.scenarios.iter().map(row).collect();
    let head = ["scenario", "restart", "a way is left", "solved", "#p", "|p|", "excluded", "repeated mistakes"];
    paragraph(&result.summary) + &table("", &head, &[3, 4, 5, 7], &rows)
}

fn of_hierarchy(result: &TypeHierarchy) -> String {
    wide_figure(&result.matrix()) + &wide_figure(&result.tree())
}

fn of_growth(result: &GrowthResult) -> String {
    let mut html = paragraph(&format!(
        "Each point in a process of its own; time is that on a processor, memory the peak of the process, the program \
         included. Planning is with imagination, the shortest of up to five times. A hollow mark is a point that was cut at \
         {} s, or at {} MiB of ground actions and nodes; it is no part of a fit. Larger kitchens than the simulator's room \
         are snapshots without geometry, in the room's proportions.",
        result.seconds_allowed,
        result.bytes_allowed >> 20
    ));
    html += &figures(result.figures().into_iter().map(|(_, svg)| svg));
    let row = |fit: &crate::growth::SeriesFit| {
        let (exponent, r_squared) = (format!("{:.2}", fit.exponent), format!("{:.3}", fit.r_squared));
        vec![fit.series.name().to_owned(), fit.quantity.clone(), exponent, r_squared, fit.points.to_string()]
    };
    let rows: Vec<Vec<String>> = result.fits.iter().map(row).collect();
    html += &table("", &["series", "quantity", "exponent", "R²", "points"], &[2, 3, 4], &rows);
    html
}

fn of_lifelong(result: &Lifelong) -> String {
    let Lifelong { tasks, window, agents, goals, .. } = result;
    let mut html = paragraph(&format!(
        "{} of {tasks} tasks, from seed {} on, in a kitchen in which tools break and are mended, foods do not go with tools, \
         and one rule is hidden. Failed steps a task, retries included, in successive parts of {window} tasks.",
        if result.runs == 1 { "1 life".to_owned() } else { format!("{} lives", result.runs) },
        result.seed
    ));
    let parts = agents.first().map(|agent| agent.failed_over_time.len()).unwrap_or_default();
    let ends: Vec<String> = (1..=parts).map(|part| format!("to {}", (part * window).min(*tasks))).collect();
    let head: Vec<&str> =
        ["agent", "solved", "plans a task"].into_iter().chain(ends.iter().map(String::as_str)).collect();
    let numbers: Vec<usize> = (1..head.len()).collect();
    let rows: Vec<Vec<String>> = agents
        .iter()
        .map(|agent| {
            let solved = format!("{} of {}", agent.solved, agent.tasks);
            let failed = agent.failed_over_time.iter().map(|failed| number(*failed));
            [agent.agent.clone(), solved, number(agent.proposals)].into_iter().chain(failed).collect()
        })
        .collect();
    html += &table("", &head, &numbers, &rows);
    html += &paragraph("Failed steps by their true cause, in the first part, in the last part, and in all.");
    let causes = agents.iter().flat_map(|agent| agent.causes.iter().map(move |(cause, counts)| (agent, cause, counts)));
    let rows: Vec<Vec<String>> = causes
        .map(|(agent, cause, counts)| {
            let counts = counts.iter().map(u64::to_string);
            [agent.agent.clone(), cause.clone()].into_iter().chain(counts).collect()
        })
        .collect();
    html += &table("", &["agent", "cause", "first", "last", "all"], &[2, 3, 4], &rows);
    let goal = |goal: &crate::lifelong::Goal| {
        let met = if goal.met() { "yes" } else { "no" };
        vec![goal.what.clone(), format!("{:.3}", goal.at_most), format!("{:.3}", goal.reached), met.to_owned()]
    };
    let rows: Vec<Vec<String>> = goals.iter().map(goal).collect();
    html + &table("", &["what was to be reached", "at most", "is", "reached"], &[1, 2], &rows)
}
