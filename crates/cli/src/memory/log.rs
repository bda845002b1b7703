//! `typelift memory log`: each entry in words.

use std::collections::BTreeMap;
use std::io::Write;

use typelift::words::count;
use typelift::world::{Reply, Said, TraceAction, Verdict};
use typelift_memory::{Logged, Memory, ProposedStep, What};

use crate::exit::Exit;
use crate::failure::{Failure, printable_lines};

pub(crate) fn list(memory: &Memory, times: bool) -> Result<Exit, Failure> {
    let mut out = anstream::stdout().lock();
    let mut tasks: BTreeMap<i64, String> = BTreeMap::new();
    for Logged { number, written, episode, what } in memory.entries()? {
        if let What::Begun { header, .. } = &what {
            tasks.insert(number, header.task.clone());
        }
        let task = episode.and_then(|begun| tasks.get(&begun)).map_or("", String::as_str);
        let time = if times { format!("{written}  ") } else { String::new() };
        writeln!(out, "{number:>6}  {time}{}", printable_lines(&said(what, task)))?;
    }
    Ok(Exit::Success)
}

/// What an entry of an episode of a task says.
fn said(what: What, task: &str) -> String {
    match what {
        What::Evidence { model, sources } => format!("{} of {model}", count(sources as u64, "demonstration")),
        What::Begun { environment, instance, header } => {
            let place = if instance.as_str().is_empty() { environment } else { instance.to_string() };
            format!("{} begins in {place}", header.task)
        }
        What::Stepped(action) => step(&action),
        What::Ended { how, source } => format!("{task} ends: {} ({})", how.replace('_', " "), source.short()),
        What::Proposed { task, steps } => proposed(&task, &steps),
        What::Said { task, said } => word(&task, &said),
        What::Forgotten { source, entries, object } => {
            let entries: Vec<String> = entries.iter().map(|entry| format!("entry {entry}")).collect();
            let what = match source {
                Some(source) if object.is_none() => source.short(),
                _ => entries.join(", "),
            };
            let with = object.map(|object| format!(" with {object}")).unwrap_or_default();
            format!("{what} is taken back{with}")
        }
    }
}

fn proposed(task: &str, steps: &[ProposedStep]) -> String {
    let imagined = steps.iter().filter(|step| step.imagined).count();
    let imagined = if imagined == 0 { String::new() } else { format!(", {imagined} imagined") };
    format!("{task}: a plan of {} is proposed{imagined}", count(steps.len() as u64, "step"))
}

fn word(task: &str, said: &Said) -> String {
    format!("{task}: a person says {}", in_words(said))
}

/// What a person said.
pub(super) fn in_words(Said { reply, call, because, .. }: &Said) -> String {
    let call = call.as_ref().map(|call| format!(" to {call}")).unwrap_or_default();
    let because = if because.is_empty() { String::new() } else { format!(": {because}") };
    let reply = match reply {
        Reply::Yes => "yes",
        Reply::No => "no",
        Reply::Another => "another plan is wanted",
        Reply::Shown => "let me show you",
    };
    format!("{reply}{call}{because}")
}

fn step(TraceAction { call, executed, reason, verdict, .. }: &TraceAction) -> String {
    // What a person does is not judged.
    let shown = if *executed == Some(false) { "shown, refused" } else { "shown" };
    let verdict = verdict.map_or(shown, Verdict::word).replace('-', " ");
    let reason = reason.as_ref().map(|reason| format!(" ({reason})")).unwrap_or_default();
    format!("  {call}: {verdict}{reason}")
}
