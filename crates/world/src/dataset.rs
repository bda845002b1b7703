//! Demonstrations as sequences of states and actions.

use std::collections::BTreeMap;

use typelift_model::{Goal, GroundCall, Hierarchy, ParseConfig, SourceId, State, Symbol, Unknown, Witness};

use crate::{Expected, FileError, LeftOut, MixedRelation, Parser, Verdict};

/// The first line of a trace.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TraceHeader {
    /// What is done, in words.
    pub task: String,
    /// What is to hold in the end, and what is not, if it is said.
    pub goal: Goal,
}

/// One action of a trace.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceAction {
    /// What the environment was told.
    pub call: GroundCall,
    /// Whether it says that it did it; the states decide what is believed.
    pub executed: Option<bool>,
    /// Why not, if it says so.
    pub reason: Option<String>,
    /// When, in seconds, if recorded.
    pub time: Option<f64>,
    /// What the agent meant to do, if an agent with a model acted.
    pub expected: Option<Expected>,
    /// What that agent judged to have come of it; the learner sees the states themselves.
    pub verdict: Option<Verdict>,
}

/// An action of which nothing but the call is known.
impl From<GroundCall> for TraceAction {
    fn from(call: GroundCall) -> Self {
        Self { call, executed: None, reason: None, time: None, expected: None, verdict: None }
    }
}

/// A demonstration: states and the actions between them; there is one state more than there are actions.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trace {
    /// The file's name, without its folders.
    pub file: Option<Symbol>,
    /// The file as a source, if it was read from one; [`source_id`](Self::source_id) always gives one.
    pub source: Option<SourceId>,
    /// What was done, in words.
    pub task: String,
    /// What was to hold in the end, and what was not, if it was said.
    pub goal: Goal,
    /// The states.
    pub states: Vec<State>,
    /// The actions.
    pub actions: Vec<TraceAction>,
    /// What is probably not meant in the file.
    pub warnings: Vec<FileError>,
}

/// One observed step (paper: (s, a_d, s')).
#[derive(Debug, Clone, Copy)]
pub struct Transition<'a> {
    /// The state before.
    pub before: &'a State,
    /// The action.
    pub action: &'a TraceAction,
    /// The state after.
    pub after: &'a State,
    /// The file's name, if there is one.
    pub file: Option<&'a Symbol>,
    /// Its number in the trace, from 1.
    pub step: u64,
}

impl Transition<'_> {
    /// The place where it was observed.
    pub fn witness(&self) -> Witness {
        Witness { file: self.file.cloned().unwrap_or_else(|| Symbol::new("-")), step: self.step }
    }
}

impl Trace {
    /// Its transitions, in order.
    pub fn transitions(&self) -> impl Iterator<Item = Transition<'_>> {
        self.states.windows(2).zip(&self.actions).zip(1..).map(|((states, action), step)| Transition {
            before: &states[0],
            action,
            after: &states[1],
            file: self.file.as_ref(),
            step,
        })
    }
}

/// What happened at one step: the one value that an agent gives out, and a learner takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// What it belongs to, as the name of a trace; none while it happens.
    pub source: Option<Symbol>,
    /// Its number there, from 1.
    pub step: u64,
    /// The state before.
    pub before: State,
    /// What was done: the call, what was expected of it, whether it was executed, why not, and the verdict.
    pub action: TraceAction,
    /// The state after.
    pub after: State,
}

impl Record {
    /// The step as a learner takes it.
    pub fn transition(&self) -> Transition<'_> {
        let Self { source, step, before, action, after } = self;
        Transition { before, action, after, file: source.as_ref(), step: *step }
    }
}

/// Demonstrations read against one hierarchy in one way (paper: 𝒟).
#[derive(Debug, Clone, Default)]
pub struct Dataset {
    /// The types that the states refer to.
    pub hierarchy: Hierarchy,
    /// How snapshots were read.
    pub parse: ParseConfig,
    /// The attribute or relation that each predicate met comes from.
    pub attributes: BTreeMap<Symbol, Symbol>,
    /// What was to be ignored and was never met.
    pub unmatched_ignores: Vec<Symbol>,
    /// Attributes and relations that snapshots have at times only.
    pub left_out: Vec<LeftOut>,
    /// Relations that snapshots write as lists at times only.
    pub mixed: Vec<MixedRelation>,
    /// The demonstrations.
    pub traces: Vec<Trace>,
    /// Files that were the same, byte for byte, as one read before, and are not among the traces.
    pub repeated: Vec<Repeated>,
}

/// A file that is the same as another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Repeated {
    /// Its name, without folders.
    pub file: Symbol,
    /// The name of the first one.
    pub first: Symbol,
    /// What both are.
    pub source: SourceId,
}

impl Dataset {
    /// The dataset of traces that a parser read. Of files that are the same the first is kept, under the name that comes
    /// first in the alphabet, so that their order does not matter.
    pub fn new(parser: &Parser, traces: Vec<Trace>) -> Self {
        let mut once: Vec<Trace> = Vec::with_capacity(traces.len());
        let mut repeated = Vec::new();
        let mut places: BTreeMap<SourceId, usize> = BTreeMap::new();
        for trace in traces {
            let Some(source) = trace.source else {
                once.push(trace);
                continue;
            };
            let place = *places.entry(source).or_insert(once.len());
            match once.get_mut(place) {
                None => once.push(trace),
                Some(known) => {
                    let named = |trace: &Trace| trace.file.clone().unwrap_or_default();
                    repeated.push(Repeated { file: named(&trace), first: named(known), source });
                    known.file = known.file.take().min(trace.file);
                }
            }
        }
        Self {
            hierarchy: parser.hierarchy().clone(),
            parse: parser.config().clone(),
            attributes: parser.attributes(),
            unmatched_ignores: parser.unmatched_ignores().cloned().collect(),
            left_out: parser.left_out(),
            mixed: parser.mixed(),
            traces: once,
            repeated,
        }
    }

    /// Whether some state lists what it knows, and all else is unknown.
    pub fn has_open_states(&self) -> bool {
        let mut states = self.traces.iter().flat_map(|trace| &trace.states);
        states.any(|state| matches!(state.unknown, Unknown::AllBut(_)))
    }

    /// All transitions of all traces.
    pub fn transitions(&self) -> impl Iterator<Item = Transition<'_>> {
        self.traces.iter().flat_map(Trace::transitions)
    }
}
