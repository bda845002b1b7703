//! Trajectory files of the field as traces. Their objects get their types from elsewhere.
//!
//! A trajectory without `(not …)` has closed states: what is not listed is false. If any of its states lists something as
//! false, all of them are open: what is listed neither way is unknown. [`Unlisted`] says otherwise.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use typelift_model::{GroundAtom, Hierarchy, Symbol, Unknown, did_you_mean};
use typelift_pddl::{PddlError, Span, Trajectory, TrajectoryState};

use crate::source::SourceHasher;
use crate::text_file::text_of;
use crate::trace_file::file_name;
use crate::{FileError, ObjectTypes, ParseError, ParseErrorKind, Parser, Trace, TraceAction};

/// What trajectory files do not say themselves.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TrajectoryContext {
    /// The types of their objects.
    pub types: ObjectTypes,
    /// What is not listed.
    pub unlisted: Unlisted,
}

impl From<ObjectTypes> for TrajectoryContext {
    fn from(types: ObjectTypes) -> Self {
        Self { types, ..Self::default() }
    }
}

/// What the states of trajectories say of an atom that they do not list.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Unlisted {
    /// That it is unknown, if any state of the trajectory lists an atom as false; else, that it is false.
    #[default]
    AsListed,
    /// That it is false.
    False,
    /// Nothing.
    Unknown,
}

/// Reads a trajectory file of either dialect. Every state has the objects that the trajectory mentions anywhere.
///
/// # Errors
/// [`FileError`] if it is malformed, or an object's type is not given or not in the hierarchy.
pub fn read_trajectory(path: &Path, context: &TrajectoryContext, parser: &mut Parser) -> Result<Trace, FileError> {
    let file = File::open(path).map_err(|error| FileError::from_io(path, &error))?;
    trajectory_from(path, file, context, parser)
}

pub(crate) fn trajectory_from(
    path: &Path,
    mut input: impl Read,
    context: &TrajectoryContext,
    parser: &mut Parser,
) -> Result<Trace, FileError> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes).map_err(|error| FileError::from_io(path, &error))?;
    let mut hasher = SourceHasher::default();
    hasher.update(&bytes);
    let source = hasher.finish();
    let text = &text_of(path, bytes)?;
    let located = |error: PddlError| FileError::from_pddl(path, text, error);
    let trajectory = typelift_pddl::read_trajectory(text).map_err(located)?;
    let given = context.types.of_trajectory(path)?;
    let objects = typed_objects(text, &trajectory, &given, parser.hierarchy()).map_err(located)?;
    let mut trace = Trace { file: file_name(path), source: Some(source), ..Trace::default() };
    let open = match context.unlisted {
        Unlisted::AsListed => trajectory.states.iter().any(|state| !state.negated.is_empty()),
        Unlisted::False => false,
        Unlisted::Unknown => true,
    };
    for state in &trajectory.states {
        let atoms = |listed: &[(GroundAtom, Span)]| listed.iter().map(|(atom, _)| atom.clone()).collect();
        let unknown = if open { Unknown::AllBut(atoms(&state.negated)) } else { Unknown::default() };
        let state = parser.parse_symbolic(&objects, &atoms(&state.atoms), unknown).map_err(|error| {
            let span = offending_span(&error, state).unwrap_or(state.span);
            located(PddlError::new(text, span, error.to_string()))
        })?;
        trace.states.push(state);
    }
    trace.actions = trajectory
        .actions
        .into_iter()
        .map(|action| TraceAction { executed: action.executed, ..TraceAction::from(action.call) })
        .collect();
    Ok(trace)
}

fn offending_span(error: &ParseError, state: &TrajectoryState) -> Option<Span> {
    match &error.kind {
        ParseErrorKind::TooManyArguments { predicate, arity } => {
            let mut listed = state.atoms.iter().chain(&state.negated);
            let found = listed.find(|(atom, _)| atom.predicate == *predicate && atom.arity() == *arity);
            found.map(|(_, span)| *span)
        }
        _ => None,
    }
}

/// Every object that the trajectory mentions, with its type as the hierarchy spells it.
fn typed_objects(
    text: &str,
    trajectory: &Trajectory,
    given: &BTreeMap<Symbol, Symbol>,
    hierarchy: &Hierarchy,
) -> Result<BTreeMap<Symbol, Symbol>, PddlError> {
    let mut spelling: BTreeMap<String, &Symbol> = BTreeMap::new();
    for ty in hierarchy.types() {
        spelling.entry(hierarchy.name(ty).as_str().to_ascii_lowercase()).or_insert_with(|| hierarchy.name(ty));
    }
    let in_states =
        trajectory.states.iter().flat_map(|s| s.atoms.iter().chain(&s.negated)).map(|(atom, span)| (&atom.args, *span));
    let in_actions = trajectory.actions.iter().map(|a| (&a.call.args, a.span));
    let mut objects = BTreeMap::new();
    for (args, span) in in_states.chain(in_actions) {
        for name in args {
            if objects.contains_key(name) {
                continue;
            }
            let Some(ty) = given.get(name) else {
                let error = PddlError::new(text, span, format!("the type of object `{name}` is not given"));
                let options = "Give it by a problem file (--problems DIR), by a list (--objects FILE), or, if it is a \
                               constant, by its domain (--types FILE).";
                return Err(error.with_hint(match did_you_mean(name.as_str(), given.keys()) {
                    Some(question) => format!("{question} {options}"),
                    None => options.to_owned(),
                }));
            };
            let Some(spelled) = spelling.get(ty.as_str()) else {
                let error = PddlError::new(text, span, format!("object {name}: unknown type `{ty}`"));
                let add = "Add it to the hierarchy.";
                return Err(error.with_hint(match did_you_mean(ty.as_str(), spelling.values().copied()) {
                    Some(question) => format!("{question} {add}"),
                    None => add.to_owned(),
                }));
            };
            objects.insert(name.clone(), (*spelled).clone());
        }
    }
    Ok(objects)
}

#[cfg(test)]
mod tests {
    use typelift_model::ParseConfig;

    use super::*;

    fn read_as(unlisted: Unlisted, types: &str, trajectory: &str) -> Result<Trace, FileError> {
        let folder = tempfile::tempdir().expect("a folder");
        let (list, path) = (folder.path().join("objects"), folder.path().join("a.trajectory"));
        crate::write_file(&list, types.as_bytes()).expect("written");
        crate::write_file(&path, trajectory.as_bytes()).expect("written");
        let hierarchy = Hierarchy::from_edges([("Block", "object"), ("Arm", "object")]).expect("a tree");
        let context = TrajectoryContext { types: ObjectTypes::from_file(&list).expect("types"), unlisted };
        let mut parser = Parser::new(hierarchy, ParseConfig::default());
        read_trajectory(&path, &context, &mut parser).map_err(|e| FileError { file: "a.trajectory".to_owned(), ..e })
    }

    fn read(types: &str, trajectory: &str) -> Result<Trace, FileError> {
        read_as(Unlisted::AsListed, types, trajectory)
    }

    #[test]
    fn one_negation_opens_every_state() {
        let (plain, open) = (
            "((:init (p a)) (operator: (do a)) (:state (q a)))",
            "((:init (p a) (not (q a))) (operator: (do a)) (:state (q a)))",
        );
        let known = |unlisted, text| {
            let trace = read_as(unlisted, "(:objects a - block)", text).expect("a trace");
            let unknown = |atom: &str| {
                trace.states.iter().map(|s| s.is_unknown(&GroundAtom::parse(atom).expect(atom))).collect::<Vec<_>>()
            };
            [unknown("p(a)"), unknown("q(a)"), unknown("r(a)")]
        };
        let nothing = vec![vec![false, false]; 3];
        assert_eq!(known(Unlisted::AsListed, plain).to_vec(), nothing);
        assert_eq!(known(Unlisted::False, open).to_vec(), nothing);
        assert_eq!(known(Unlisted::AsListed, open), [vec![false, true], vec![false, false], vec![true, true]]);
        assert_eq!(known(Unlisted::Unknown, plain), [vec![false, true], vec![true, false], vec![true, true]]);
    }

    #[test]
    fn objects_get_their_types_whatever_the_case() {
        let text = "((:init (on a b))\n(operator: (grasp ARM a))\n(:transition_status (failure))\n(:state (on a b)))";
        let trace = read("(:objects a B - BLOCK arm - arm unused - block)", text).expect("a trace");
        let objects: Vec<&str> = trace.states[0].objects.keys().map(Symbol::as_str).collect();
        assert_eq!(objects, ["a", "arm", "b"]);
        assert_eq!(trace.states[0].objects, trace.states[1].objects);
        assert_eq!(trace.actions[0].call.to_string(), "grasp(arm, a)");
        assert_eq!((trace.actions[0].executed, trace.file), (Some(false), Some(Symbol::new("a.trajectory"))));
    }

    #[test]
    fn what_is_refused() {
        let untyped = read("(:objects block1 - block)", "((:init (p block1)\n (p blok1)))").expect_err("untyped");
        assert_eq!(untyped.to_string(), "a.trajectory:2:2: the type of object `blok1` is not given");
        assert_eq!(
            untyped.hint.as_deref(),
            Some(
                "Did you mean `block1`? Give it by a problem file (--problems DIR), by a list (--objects FILE), or, if \
                 it is a constant, by its domain (--types FILE)."
            )
        );
        assert_eq!(untyped.excerpt.as_deref(), Some("  |\n2 |  (p blok1)))\n  |  ^^^^^^^^^\n"));
        let unknown = read("(:objects a - blocks)", "((:init (p a)))").expect_err("unknown");
        assert_eq!(unknown.to_string(), "a.trajectory:1:9: object a: unknown type `blocks`");
        assert_eq!(unknown.hint.as_deref(), Some("Did you mean `Block`? Add it to the hierarchy."));
        let large = format!("((:init (p a)\n (p{})))", " a".repeat(257));
        let large = read("(:objects a - block)", &large).expect_err("too many arguments");
        assert_eq!(
            large.to_string(),
            "a.trajectory:2:2: the predicate `p` is used with 257 arguments, and may have 256"
        );
        let malformed = read("(:objects a - block)", "((:init (p a))").expect_err("malformed");
        assert_eq!(malformed.to_string(), "a.trajectory:1:1: this `(` is never closed");
    }
}
