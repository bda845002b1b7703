//! `run --confirm`: the person at the terminal is asked before a plan is executed.

use std::io::IsTerminal;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use clap::ValueEnum;
use typelift::agent::{Confirmation, Objection};
use typelift::model::{ActionModel, GroundAtom, Plan, Symbol};
use typelift::words::numbered_steps;

use crate::limits::Interrupt;
use crate::style::painted;

/// How often it is looked whether Ctrl-C was pressed while an answer is waited for.
const ANSWER_INTERVAL: Duration = Duration::from_millis(50);

const QUESTION: &str = "execute? [y]es, [n]o [STEP] [broken|kind|while ATOM|now], [a]nother plan, [s]top: ";

/// Which plans are to be confirmed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Which {
    // Those with imagined steps.
    Imagined,
    All,
}

/// Asks about a plan, if it is one of those.
pub(crate) fn confirm(which: Option<Which>, plan: &Plan, model: &ActionModel, interrupt: &Interrupt) -> Confirmation {
    let imagined = plan.steps.iter().position(|step| step.imagined.is_some());
    let ask = match which {
        None => false,
        Some(Which::Imagined) => imagined.is_some(),
        Some(Which::All) => true,
    };
    if !ask {
        return Confirmation::Approve;
    }
    for line in numbered_steps(plan, &model.hierarchy) {
        anstream::eprintln!("{}", painted(&line));
    }
    loop {
        anstream::eprint!("{QUESTION}");
        let Some(answer) = answer(interrupt) else {
            anstream::eprintln!("no answer: stopped");
            return Confirmation::Stop;
        };
        if !std::io::stdin().is_terminal() {
            anstream::eprintln!("{}", answer.trim());
        }
        if let Some(confirmation) = read(&answer, plan, model, imagined.unwrap_or(0) + 1) {
            return confirmation;
        }
    }
}

/// What an answer means; without a number it is about the step `usual`. None if it means nothing.
fn read(answer: &str, plan: &Plan, model: &ActionModel, usual: usize) -> Option<Confirmation> {
    let words: Vec<&str> = answer.split_whitespace().collect();
    let (first, mut rest) = words.split_first()?;
    match (*first, rest) {
        ("y" | "yes", []) => return Some(Confirmation::Approve),
        ("a" | "another", []) => return Some(Confirmation::AnotherPlan),
        ("s" | "stop", []) => return Some(Confirmation::Stop),
        ("n" | "no", _) => {}
        _ => return None,
    }
    let mut step = usual;
    if let Some((number, others)) = rest.split_first()
        && let Ok(number) = number.parse()
    {
        (step, rest) = (number, others);
    }
    let objects_of_step = &plan.steps.get(step.checked_sub(1)?)?.objects;
    let objects = |names: &[&str]| -> Option<Vec<Symbol>> {
        let named = |name: &&str| objects_of_step.iter().find(|object| **object == **name).cloned();
        names.iter().map(named).collect()
    };
    let (objection, because) = match rest {
        [] => (None, String::new()),
        ["broken", names @ ..] => (Some(Objection::Broken { objects: objects(names)? }), ": broken".to_owned()),
        ["kind", names @ ..] => (Some(Objection::WrongKind { objects: objects(names)? }), ": wrong kind".to_owned()),
        ["while", atom @ ..] => {
            let atom = GroundAtom::parse(&atom.concat()).ok()?;
            if model.predicates.get(&atom.predicate).map(Vec::len) != Some(atom.arity()) {
                return None;
            }
            let because = format!(": not while {atom}");
            (Some(Objection::While { atom }), because)
        }
        ["now"] => (Some(Objection::NotNow), ": not now".to_owned()),
        _ => return None,
    };
    Some(Confirmation::Reject { step, objection, reason: format!("rejected by a person{because}") })
}

/// A line from the person at the terminal. None at its end, or as soon as Ctrl-C is pressed: a line is waited for in
/// another thread, since nothing else ends that.
fn answer(interrupt: &Interrupt) -> Option<String> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let mut line = String::new();
        let read = std::io::stdin().read_line(&mut line);
        // After Ctrl-C the answer is no longer awaited.
        let _ = sender.send(read.is_ok_and(|bytes| bytes > 0).then_some(line));
    });
    loop {
        match receiver.recv_timeout(ANSWER_INTERVAL) {
            _ if interrupt.is_set() => return None,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return None,
            Ok(line) => return line,
        }
    }
}
