//! `run --confirm`: the person at the terminal is asked before a plan is executed.

use std::io::IsTerminal;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use clap::ValueEnum;
use typelift::agent::{Confirmation, Objection, Person, Shown};
use typelift::model::{
    ActionModel, GoalErrorKind, GroundAtom, GroundCall, OtherNotation, Plan, State, Step, Symbol, did_you_mean,
};
use typelift::words::numbered_steps;

use crate::failure::printable_lines;
use crate::limits::Interrupt;
use crate::style::painted;

/// How often it is looked whether Ctrl-C was pressed while an answer is waited for.
const ANSWER_INTERVAL: Duration = Duration::from_millis(50);

const QUESTION: &str =
    "execute? [y]es, [n]o [STEP] [broken|kind|while ATOM|now|instead OBJECT], [a]nother plan, s[h]ow, [s]top: ";

const NEXT_STEP: &str = "what is done next? A call, or `done`: ";

/// What can be answered.
const HELP: &str = "  y                  execute it
  n                  no, because of the imagined step if there is one, else the first
  n 3                no, because of step 3
  n 3 broken cup_1   no: cup_1 is broken, or, if nothing is named, what the step is about
  n 3 kind cup_1     no: such things do not go there; if nothing is named, those imagined
  n 3 while on(a,b)  no: not while this holds
  n 3 now            no: not in this task
  n 3 instead cup_2  no: in this task with cup_2, in place of what is most of its kind,
                     or of what is named after `for`: n 3 instead cup_2 for cup_1
  a                  another plan; nothing speaks against this one
  h                  show what to do: call after call, from here, until `done`
  s                  stop";

/// Which plans are to be confirmed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Which {
    // Those with imagined steps.
    Imagined,
    All,
}

/// The person at the terminal.
pub(crate) struct Asked<'a> {
    /// About which plans they are asked; about none if nothing is to be confirmed.
    pub(crate) which: Option<Which>,
    pub(crate) model: &'a ActionModel,
    pub(crate) interrupt: &'a Interrupt,
}

impl Person for Asked<'_> {
    fn confirm(&mut self, plan: &Plan, state: &State) -> Confirmation {
        let imagined = plan.steps.iter().position(|step| step.imagined.is_some());
        let ask = match self.which {
            None => false,
            Some(Which::Imagined) => imagined.is_some(),
            Some(Which::All) => true,
        };
        if !ask {
            return Confirmation::Approve;
        }
        for line in numbered_steps(plan, &self.model.hierarchy) {
            anstream::eprintln!("  {}", painted(&line));
        }
        loop {
            let Some(answer) = self.answer(QUESTION) else {
                anstream::eprintln!("no answer: stopped");
                return Confirmation::Stop;
            };
            match read(&answer, plan, state, self.model, imagined.unwrap_or(0) + 1) {
                Ok(confirmation) => return confirmation,
                Err(why) => anstream::eprintln!("{}", printable_lines(&why)),
            }
        }
    }

    fn show(&mut self, state: &State, last: Option<&Shown>) -> Option<GroundCall> {
        if let Some(last) = last {
            anstream::eprintln!("  {}", printable_lines(&came_of(last)));
        }
        loop {
            let Some(answer) = self.answer(NEXT_STEP) else {
                anstream::eprintln!("no answer: done");
                return None;
            };
            match read_call(&answer, state) {
                Ok(call) => return call,
                Err(why) => anstream::eprintln!("{}", printable_lines(&why)),
            }
        }
    }
}

impl Asked<'_> {
    /// What is answered to a question. What does not come from a terminal is repeated.
    fn answer(&self, question: &str) -> Option<String> {
        anstream::eprint!("{question}");
        let answer = answer(self.interrupt)?;
        if !std::io::stdin().is_terminal() {
            anstream::eprintln!("{}", answer.trim());
        }
        Some(answer)
    }
}

/// What came of a step that a person showed.
fn came_of(Shown { executed, reason, added, deleted, .. }: &Shown) -> String {
    let changes = added.iter().map(ToString::to_string).chain(deleted.iter().map(|atom| format!("not {atom}")));
    let changes: Vec<String> = changes.collect();
    let changes = if changes.is_empty() { "nothing changed".to_owned() } else { changes.join(" ") };
    match (executed, reason) {
        (Some(false), Some(reason)) => format!("refused: {reason}"),
        (Some(false), None) => "refused".to_owned(),
        (Some(true), _) => format!("ok: {changes}"),
        (None, _) => format!("not finished in time: {changes}"),
    }
}

/// The call that a person makes next, none if they are done; or what is said if it is none.
fn read_call(answer: &str, state: &State) -> Result<Option<GroundCall>, String> {
    let answer = answer.trim();
    if answer == "done" {
        return Ok(None);
    }
    let call = GroundAtom::parse(answer).map_err(|error| format!("{error}; or `done`"))?;
    match call.args.iter().find(|object| !state.objects.contains_key(*object)) {
        Some(object) => Err(not_here(object.as_str(), state)),
        None => Ok(Some(GroundCall { name: call.predicate, args: call.args })),
    }
}

/// That there is no such object, and which one may be meant.
fn not_here(object: &str, state: &State) -> String {
    let near = did_you_mean(object, state.objects.keys()).map(|near| format!(". {near}")).unwrap_or_default();
    format!("{object} is not here{near}")
}

/// What an answer means, without a number it is about the step `usual`; or what is said if it means nothing.
fn read(answer: &str, plan: &Plan, state: &State, model: &ActionModel, usual: usize) -> Result<Confirmation, String> {
    let words: Vec<&str> = answer.split_whitespace().collect();
    let (step, reason) = match *words {
        ["y" | "yes"] => return Ok(Confirmation::Agree),
        ["a" | "another"] => return Ok(Confirmation::AnotherPlan),
        ["h" | "show"] => return Ok(Confirmation::Show),
        ["s" | "stop"] => return Ok(Confirmation::Stop),
        ["?" | "help"] => return Err(HELP.to_owned()),
        [] => return Err("answer y, n, a, h or s; `?` says what can be answered".to_owned()),
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
    let (objection, reason) = match reason {
        [] => (None, String::new()),
        ["broken", names @ ..] => {
            (Some(Objection::Broken { objects: objects(names, step, planned)? }), "broken".to_owned())
        }
        ["kind", names @ ..] => {
            (Some(Objection::WrongKind { objects: objects(names, step, planned)? }), "wrong kind".to_owned())
        }
        ["while", atom @ ..] => {
            let atom = atom_of(&atom.join(" "), model)?;
            let because = format!("not while {atom}");
            (Some(Objection::While { atom }), because)
        }
        ["now"] => (Some(Objection::NotNow), "not now".to_owned()),
        ["instead"] => return Err("instead with what? Write an object after it".to_owned()),
        ["instead", with] => instead(with, None, step, planned, state)?,
        ["instead", with, "for", object] => instead(with, Some(object), step, planned, state)?,
        _ => return Err(not_understood(answer)),
    };
    Ok(Confirmation::Reject { step, objection, reason })
}

/// These objects, if they are in the step.
fn objects(names: &[&str], step: usize, planned: &Step) -> Result<Vec<Symbol>, String> {
    let named = |name: &&str| match planned.objects.iter().find(|object| **object == **name) {
        Some(object) => Ok(object.clone()),
        None => Err(format!("{name} is not in step {step}; in it are {}", listed(&planned.objects))),
    };
    names.iter().map(named).collect()
}

/// That another object is wanted, if it is there and not in the step.
fn instead(
    with: &str,
    object: Option<&str>,
    step: usize,
    planned: &Step,
    state: &State,
) -> Result<(Option<Objection>, String), String> {
    if planned.objects.iter().any(|object| *object == *with) {
        return Err(format!("{with} is in step {step} already"));
    }
    let Some((with, _)) = state.objects.get_key_value(with) else { return Err(not_here(with, state)) };
    let object = object.map(|object| objects(&[object], step, planned)).transpose()?;
    let object = object.and_then(|objects| objects.into_iter().next());
    let reason = format!("instead with {with}");
    Ok((Some(Objection::Instead { object, with: with.clone() }), reason))
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
