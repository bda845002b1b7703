//! The page itself.

use std::fmt::Write;

use super::claims::{Judged, judge};
use super::environment::Environment;
use super::results::Results;
use super::sections::sections;
use crate::figure::{STYLE, escape};
use crate::published::published;

/// The report as one HTML page. What is missing is said to be, with the command that makes it; `folder` is where it
/// would write.
pub fn report_page(results: &Results, environment: &Environment, folder: &str) -> String {
    let judged = judge(results);
    let sections = sections(results);
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
         <title>typelift: the paper's experiments</title>\n<style>\n{}{STYLE}</style>\n</head>\n<body>\n\
         <h1>The paper's experiments, run again</h1>\n<p class=\"mute\">{}</p>\n",
        include_str!("page.css"),
        escape(&published().paper)
    );
    html += "<nav><ul><li><a href=\"#claims\">Claims</a></li>";
    for (id, heading, _) in &sections {
        let _ = write!(html, "<li><a href=\"#{id}\">{heading}</a></li>");
    }
    html += "<li><a href=\"#environment\">Environment</a></li></ul></nav>\n";
    html += &claims(&judged);
    for (id, heading, content) in sections {
        let _ = writeln!(html, "<section id=\"{id}\">\n<h2>{heading}</h2>");
        html += &content.unwrap_or_else(|| missing(id, folder));
        html += "</section>\n";
    }
    html += &machine(environment, results);
    html += "</body>\n</html>\n";
    html
}

/// `typelift lab table -o results/table`.
fn missing(experiment: &str, folder: &str) -> String {
    let command = escape(&format!("typelift lab {experiment} -o {folder}/{experiment}"));
    format!("<p class=\"missing\">Not run yet: <code>{command}</code> makes this section.</p>\n")
}

fn claims(judged: &[Judged]) -> String {
    let measured: Vec<_> = judged.iter().filter_map(|judged| judged.finding.as_ref()).collect();
    let held = measured.iter().filter(|finding| finding.held).count();
    let mut html = format!(
        "<section id=\"claims\">\n<h2>The paper's claims</h2>\n<p>{held} of {} claims that were measured held; {} of {} were \
         measured.</p>\n<div class=\"wide\"><table class=\"claims\"><thead><tr><th>claim</th><th>in the paper</th>\
         <th>our number</th><th>held</th></tr></thead><tbody>\n",
        measured.len(),
        measured.len(),
        judged.len()
    );
    for Judged { claim, finding } in judged {
        let (ours, verdict) = match finding {
            Some(finding) if finding.held => (finding.ours.as_str(), "<span class=\"yes\">✓ held</span>"),
            Some(finding) => (finding.ours.as_str(), "<span class=\"no\">✗ not held</span>"),
            None => ("", "<span class=\"mute\">not measured</span>"),
        };
        let _ = writeln!(
            html,
            "<tr><td>{}</td><td class=\"mute\">{}</td><td data-name=\"ours\">{}</td><td class=\"verdict\">{verdict}</td></tr>",
            escape(&claim.claim),
            escape(&claim.place),
            escape(ours)
        );
    }
    html += "</tbody></table></div>\n</section>\n";
    html
}

fn machine(environment: &Environment, results: &Results) -> String {
    let Environment { version, commit, cpu, system } = environment;
    let mut seeds = Vec::new();
    if let Some(table) = &results.table {
        seeds.push(format!("table {} to {}", table.seed, table.seed + table.runs.saturating_sub(1)));
    }
    if let Some(demonstrations) = &results.demonstrations {
        seeds.push(format!("demonstrations {}", demonstrations.seed));
    }
    if let Some(faults) = &results.faults {
        seeds.push(format!("faults {} to {}", faults.seed, faults.seed + faults.runs.saturating_sub(1)));
    }
    if let Some(lifelong) = &results.lifelong {
        seeds.push(format!("lifelong {} to {}", lifelong.seed, lifelong.seed + lifelong.runs.saturating_sub(1)));
    }
    if results.growth.is_some() {
        seeds.push("growth 0".to_owned());
    }
    let rows = [
        ("typelift", version.clone()),
        ("commit", commit.clone().unwrap_or_else(|| "unknown".to_owned())),
        ("processor", cpu.clone()),
        ("system", system.clone()),
        ("seeds", seeds.join("; ")),
    ];
    let rows: String =
        rows.iter().map(|(name, value)| format!("<dt>{name}</dt><dd>{}</dd>\n", escape(value))).collect();
    format!(
        "<section id=\"environment\">\n<h2>Environment</h2>\n<p class=\"mute\">Of this page; times were measured where the \
             experiments were run.</p>\n<dl>\n{rows}</dl>\n</section>\n"
    )
}
