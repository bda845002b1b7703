//! Trace files: demonstrations, one a file, one state or action a line.

use std::collections::BTreeSet;
use std::io::BufRead;
use std::path::Path;

use typelift_model::{GroundAtom, HashMap, State, Symbol, SymbolPool, TypeId, check_name, nearest};

use crate::{FileError, Parser, Scene, TRACE_FORMAT, Trace, TraceAction, TraceHeader, TraceItem, TraceReader, json};

/// Reads a trace file.
///
/// # Errors
/// [`FileError`] at the first line that is malformed, out of turn, or shows something impossible: an unknown type, an
/// entity whose type changes, an action on an entity that is not there.
pub fn read_trace(path: &Path, parser: &mut Parser) -> Result<Trace, FileError> {
    trace_from(path, TraceReader::open(path)?, parser)
}

/// Whether a text begins as a trace does: with its format.
pub fn is_trace(text: &str) -> bool {
    let first = text.lines().next().unwrap_or_default();
    json::format(first).is_ok_and(|found| found.as_deref() == Some(TRACE_FORMAT))
}

/// The file's name without its folders.
pub(crate) fn file_name(path: &Path) -> Option<Symbol> {
    path.file_name().map(|name| Symbol::from(name.to_string_lossy().into_owned()))
}

/// Reads the rest of a trace; errors call it `path`.
///
/// # Errors
/// As for [`read_trace`].
pub fn trace_from<R: BufRead>(
    path: &Path,
    mut reader: TraceReader<R>,
    parser: &mut Parser,
) -> Result<Trace, FileError> {
    let TraceHeader { task, goal } = reader.header().clone();
    let trace = Trace { file: file_name(path), task, goal, ..Trace::default() };
    let mut checked = Checked { path, parser, trace, names: SymbolPool::new(), types: HashMap::default() };
    let mut state_line = 0;
    while let Some(item) = reader.next() {
        let item = item?;
        // An action is in the line before the state after it.
        let line = reader.line();
        match item {
            TraceItem::Start(scene) => checked.state(&scene, line)?,
            TraceItem::Step(action, after) => {
                checked.action(action, line - 1, state_line)?;
                checked.state(&after, line)?;
            }
        }
        state_line = line;
    }
    Ok(Trace { warnings: reader.warnings(), source: Some(reader.source()), ..checked.trace })
}

/// What to do about an action that mentions what the state before it does not show.
pub(crate) const ON_DEMAND: &str = "Learning refuses an action on what the state before it does not show. What the action itself \
                                    makes needs an id beforehand: show a pool of ids from the start, with an attribute that \
                                    says which are there.";

/// A trace, checked as it grows.
struct Checked<'a> {
    path: &'a Path,
    parser: &'a mut Parser,
    trace: Trace,
    names: SymbolPool,
    /// The type of each entity, and the line where it is met first.
    types: HashMap<Symbol, (TypeId, usize)>,
}

impl Checked<'_> {
    fn state(&mut self, scene: &Scene, line: usize) -> Result<(), FileError> {
        let parsed = self.parser.parse(scene);
        let hierarchy = self.parser.hierarchy();
        let state = parsed.map_err(|e| FileError::from_parse(self.path, Some(line), &e, hierarchy))?;
        for (name, &ty) in &state.objects {
            let &mut (first, at) = self.types.entry(name.clone()).or_insert((ty, line));
            if first != ty {
                let (now, before) = (hierarchy.name(ty), hierarchy.name(first));
                let what = format!("entity {name} is of type `{now}` here and of type `{before}` in line {at}");
                let hint = "An entity is of one type; what becomes another thing needs another name.";
                return Err(FileError::at_line(self.path, line, what).with_hint(hint.to_owned()));
            }
        }
        self.trace.states.push(share(&state, &mut self.names));
        Ok(())
    }

    /// Adds an action after the state in line `state_line`.
    fn action(&mut self, action: TraceAction, line: usize, state_line: usize) -> Result<(), FileError> {
        check_name(action.call.name.as_str()).map_err(|error| {
            let hint = "An action is named by a word without white space and ( ) , ; \".";
            FileError::at_line(self.path, line, format!("the action's name: {error}")).with_hint(hint.to_owned())
        })?;
        let state = self.trace.states.last().map(|state| &state.objects);
        let expected = action.expected.iter().flat_map(|expected| &expected.args);
        let mut mentioned = action.call.args.iter().chain(expected);
        if let Some(missing) = mentioned.find(|arg| !state.is_some_and(|s| s.contains_key(*arg))) {
            let what = format!(
                "the action {} mentions `{missing}`, which is not in the state before it (line {state_line})",
                action.call
            );
            let unnumbered = |name: &str| name.trim_end_matches(|c: char| c.is_ascii_digit()).to_owned();
            let hint = match nearest(missing.as_str(), state.into_iter().flat_map(|s| s.keys())) {
                // A number that is new may be one that the action gives.
                Some(near) if unnumbered(near.as_str()) == unnumbered(missing.as_str()) => {
                    format!("Did you mean `{near}`? {ON_DEMAND}")
                }
                Some(near) => format!("Did you mean `{near}`?"),
                None => ON_DEMAND.to_owned(),
            };
            return Err(FileError::at_line(self.path, line, what).with_hint(hint));
        }
        self.trace.actions.push(action);
        Ok(())
    }
}

/// The same state, its names shared with those of the states before.
fn share(state: &State, names: &mut SymbolPool) -> State {
    let mut shared = |name: &Symbol| names.symbol(name.as_str());
    let mut atoms = |set: &BTreeSet<GroundAtom>| -> BTreeSet<GroundAtom> {
        let atom = |a: &GroundAtom| GroundAtom {
            predicate: shared(&a.predicate),
            args: a.args.iter().map(&mut shared).collect(),
        };
        set.iter().map(atom).collect()
    };
    let held = atoms(&state.atoms);
    let objects = state.objects.iter().map(|(name, ty)| (names.symbol(name.as_str()), *ty)).collect();
    State { objects, atoms: held, unknown: state.unknown.clone() }
}
