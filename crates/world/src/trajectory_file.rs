//! Trajectory files of the field as traces. Their objects get their types from elsewhere.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use typelift_model::{GroundAtom, Hierarchy, Symbol, did_you_mean};
use typelift_pddl::{PddlError, Span, Trajectory};

use crate::trace_file::file_name;
use crate::{FileError, ObjectTypes, ParseError, ParseErrorKind, Parser, Scene, Trace, TraceAction, read_text};

/// Reads a trajectory file of either dialect. Every state has the objects that the trajectory mentions anywhere.
///
/// # Errors
/// [`FileError`] if it is malformed, or an object's type is not given or not in the hierarchy.
pub fn read_trajectory(path: &Path, types: &ObjectTypes, parser: &mut Parser) -> Result<Trace, FileError> {
    trajectory_from(path, &read_text(path)?, types, parser)
}

pub(crate) fn trajectory_from(
    path: &Path,
    text: &str,
    types: &ObjectTypes,
    parser: &mut Parser,
) -> Result<Trace, FileError> {
    let located = |error: PddlError| FileError::from_pddl(path, text, error);
    let trajectory = typelift_pddl::read_trajectory(text).map_err(located)?;
    let given = types.of_trajectory(path)?;
    let objects = typed_objects(text, &trajectory, &given, parser.hierarchy()).map_err(located)?;
    let mut trace = Trace { file: file_name(path), ..Trace::default() };
    for state in &trajectory.states {
        let atoms: BTreeSet<GroundAtom> = state.atoms.iter().map(|(atom, _)| atom.clone()).collect();
        let scene = Scene::Symbolic { objects: objects.clone(), atoms, unknown: BTreeSet::new() };
        let state = parser.parse(&scene).map_err(|error| {
            let span = offending_span(&error, &state.atoms).unwrap_or(state.span);
            located(PddlError::new(text, span, error.to_string()))
        })?;
        trace.states.push(state);
    }
    trace.actions = trajectory
        .actions
        .into_iter()
        .map(|action| TraceAction { call: action.call, executed: action.executed, reason: None, time: None })
        .collect();
    Ok(trace)
}

fn offending_span(error: &ParseError, atoms: &[(GroundAtom, Span)]) -> Option<Span> {
    match &error.kind {
        ParseErrorKind::TwoArities { predicate, second, .. } => {
            let mut found = atoms.iter().filter(|(atom, _)| atom.predicate == *predicate && atom.arity() == *second);
            found.next().map(|(_, span)| *span)
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
    let in_states = trajectory.states.iter().flat_map(|s| &s.atoms).map(|(atom, span)| (&atom.args, *span));
    let in_actions = trajectory.actions.iter().map(|a| (&a.call.args, a.span));
    let mut objects = BTreeMap::new();
    for (args, span) in in_states.chain(in_actions) {
        for name in args {
            if objects.contains_key(name) {
                continue;
            }
            let Some(ty) = given.get(name) else {
                let error = PddlError::new(text, span, format!("the type of object `{name}` is not given"));
                let options = "Give it by a problem file, or a domain file if it is a constant \
                               (--problems DIR), or by a list (--objects FILE).";
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

    fn read(types: &str, trajectory: &str) -> Result<Trace, FileError> {
        let folder = tempfile::tempdir().expect("a folder");
        let (list, path) = (folder.path().join("objects"), folder.path().join("a.trajectory"));
        crate::write_file(&list, types.as_bytes()).expect("written");
        crate::write_file(&path, trajectory.as_bytes()).expect("written");
        let hierarchy = Hierarchy::from_edges([("Block", "object"), ("Arm", "object")]).expect("a tree");
        let types = ObjectTypes::from_file(&list).expect("types");
        let mut parser = Parser::new(hierarchy, ParseConfig::default());
        read_trajectory(&path, &types, &mut parser).map_err(|e| FileError { file: "a.trajectory".to_owned(), ..e })
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
                "Did you mean `block1`? Give it by a problem file, or a domain file if it is a constant \
                 (--problems DIR), or by a list (--objects FILE)."
            )
        );
        assert_eq!(untyped.excerpt.as_deref(), Some("  |\n2 |  (p blok1)))\n  |  ^^^^^^^^^\n"));
        let unknown = read("(:objects a - blocks)", "((:init (p a)))").expect_err("unknown");
        assert_eq!(unknown.to_string(), "a.trajectory:1:9: object a: unknown type `blocks`");
        assert_eq!(unknown.hint.as_deref(), Some("Did you mean `Block`? Add it to the hierarchy."));
        let arities = read("(:objects a - block)", "((:init (p a)\n (p)))").expect_err("arities");
        assert_eq!(arities.to_string(), "a.trajectory:1:9: the predicate `p` is used with 0 and with 1 arguments");
        let malformed = read("(:objects a - block)", "((:init (p a))").expect_err("malformed");
        assert_eq!(malformed.to_string(), "a.trajectory:1:1: this `(` is never closed");
    }
}
