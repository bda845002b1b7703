//! `run --confirm`: the person at the terminal is asked before a plan is executed.

use std::io::IsTerminal;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use clap::ValueEnum;
use typelift::agent::{Confirmation, Objection};
use typelift::model::{ActionModel, GoalErrorKind, GroundAtom, OtherNotation, Plan, Symbol};
use typelift::words::numbered_steps;

use crate::failure::printable_lines;
use crate::limits::Interrupt;
use crate::style::painted;

/// How often it is looked whether Ctrl-C was pressed while an answer is waited for.
const ANSWER_INTERVAL: Duration = Duration::from_millis(50);

const QUESTION: &str = "execute? [y]es, [n]o [STEP] [broken|kind|while ATOM|now], [a]nother plan, [s]top: ";

/// What can be answered.
const HELP: &str = "  y                  execute it
  n                  no, because of the imagined step if there is one, else the first
  n 3                no, because of step 3
  n 3 broken cup_1   no: cup_1 is broken, or, if nothing is named, what the step is about
  n 3 kind cup_1     no: such things do not go there; if nothing is named, those imagined
  n 3 while on(a,b)  no: not while this holds
  n 3 now            no: not in this task
  a                  another plan; nothing speaks against this one
  s                  stop";

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
        anstream::eprintln!("  {}", painted(&line));
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
        match read(&answer, plan, model, imagined.unwrap_or(0) + 1) {
            Ok(confirmation) => return confirmation,
            Err(why) => anstream::eprintln!("{}", printable_lines(&why)),
        }
    }
}

/// What an answer means, without a number it is about the step `usual`; or what is said if it means nothing.
fn read(answer: &str, plan: &Plan, model: &ActionModel, usual: usize) -> Result<Confirmation, String> {
    let words: Vec<&str> = answer.split_whitespace().collect();
    let (step, reason) = match *words {
        ["y" | "yes"] => return Ok(Confirmation::Agree),
        ["a" | "another"] => return Ok(Confirmation::AnotherPlan),
        ["s" | "stop"] => return Ok(Confirmation::Stop),
        ["?" | "h" | "help"] => return Err(HELP.to_owned()),
        [] => return Err("answer y, n, a or s; `?` says what can be answered".to_owned()),
        ["n" | "no", ref rest @ ..] => match rest.split_first() {
            Some((number, reason)) if number.starts_with(|c: char| c.is_ascii_digit()) => (number.parse().ok(), reason),
            _ => (Some(usual), rest),
        },
        _ => return Err(not_understood(answer)),
    };
    let planned = step.and_then(|step: usize| Some((step, plan.steps.get(step.checked_sub(1)?)?)));
    let Some((step, planned)) = planned else {
        let (number, last) = (words.get(1).unwrap_or(&"1"), plan.len());
        return Err(format!("there is no step {number}: they are numbered from 1 to {last}"));
    };
    let objects = |names: &[&str]| -> Result<Vec<Symbol>, String> {
        let named = |name: &&str| match planned.objects.iter().find(|object| **object == **name) {
            Some(object) => Ok(object.clone()),
            None => Err(format!("{name} is not in step {step}; in it are {}", listed(&planned.objects))),
        };
        names.iter().map(named).collect()
    };
    let (objection, because) = match reason {
        [] => (None, String::new()),
        ["broken", names @ ..] => (Some(Objection::Broken { objects: objects(names)? }), "broken".to_owned()),
        ["kind", names @ ..] => (Some(Objection::WrongKind { objects: objects(names)? }), "wrong kind".to_owned()),
        ["while", atom @ ..] => {
            let atom = atom_of(&atom.join(" "), model)?;
            let because = format!("not while {atom}");
            (Some(Objection::While { atom }), because)
        }
        ["now"] => (Some(Objection::NotNow), "not now".to_owned()),
        _ => return Err(not_understood(answer)),
    };
    Ok(Confirmation::Reject { step, objection, reason: because })
}

/// An atom over a predicate of the model, or why this is none.
fn atom_of(text: &str, model: &ActionModel) -> Result<GroundAtom, String> {
    if text.is_empty() {
        return Err("while what? Write an atom after it, such as `on(cup_1,table_1)`".to_owned());
    }
    let with_hint = |said: String, hint: Option<String>| match hint {
        Some(hint) => format!("{said}. {hint}"),
        None => said,
    };
    let atom = GroundAtom::parse(text)
        .map_err(|error| {
            let meant = OtherNotation::of(text).filter(|other| match other {
                OtherNotation::Literals(literals) => matches!(literals[..], [(_, true)]),
                OtherNotation::BeyondLiterals(_) => false,
            });
            with_hint(error.to_string(), meant.map(|other| other.hint()))
        })?
        .named_as_in(&model.predicates);
    match GoalErrorKind::of_predicate(&atom, &model.predicates) {
        None => Ok(atom),
        Some(wrong) => Err(with_hint(wrong.said_of(&atom), wrong.hint(&atom, true))),
    }
}

fn not_understood(answer: &str) -> String {
    format!("not understood: {}; `?` says what can be answered", answer.trim())
}

fn listed(names: &[Symbol]) -> String {
    names.iter().map(Symbol::as_str).collect::<Vec<_>>().join(", ")
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
