//! Recorded trajectories, in both dialects of the field.
//!
//! AMLGym writes `(:trajectory (:state (on a b) …) (:action (pick a)) (:state …) …)`, SAM
//! `((:init (on a b) …) (operator: (pick a)) (:state …) …)`, where each operator may be followed by
//! `(:transition_status (success))` or `(failure)`. Either form of each entry is accepted in both. A state lists what
//! holds and, as `(not (p a))`, what does not; numeric fluents `(= (f a) 3)` are passed over.

use std::collections::BTreeSet;

use typelift_model::{GroundAtom, GroundCall, Symbol, SymbolPool, check_name};

use crate::{Document, PddlError, Sexpr, Span};

/// One state of a trajectory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TrajectoryState {
    /// The atoms that hold, in lower case, each with its place.
    pub atoms: Vec<(GroundAtom, Span)>,
    /// The atoms that are said not to hold, in lower case, each with its place.
    pub negated: Vec<(GroundAtom, Span)>,
    /// Where the state is.
    pub span: Span,
}

/// One action of a trajectory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TrajectoryAction {
    /// The action, in lower case.
    pub call: GroundCall,
    /// Whether it was carried out, if the file says so.
    pub executed: Option<bool>,
    /// Where the action is.
    pub span: Span,
}

/// States and the actions between them; there is one state more than there are actions.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Trajectory {
    /// The states.
    pub states: Vec<TrajectoryState>,
    /// The actions.
    pub actions: Vec<TrajectoryAction>,
}

/// Reads a trajectory of either dialect.
///
/// # Errors
/// [`PddlError`] at an entry that is unknown, malformed or out of turn.
pub fn read_trajectory(text: &str) -> Result<Trajectory, PddlError> {
    let document = Document::read(text)?;
    let root = document.only_root()?;
    let mut entries = root.children();
    if root.has_head(":trajectory") {
        entries.next();
    } else if !root.children().next().is_some_and(Sexpr::is_list) {
        return Err(root.error("neither `(:trajectory …)` nor `((:init …) …)`"));
    }
    let mut names = SymbolPool::new();
    let mut trajectory = Trajectory::default();
    let mut last = None;
    for entry in entries {
        match entry.head().map(str::to_ascii_lowercase).as_deref() {
            Some(":state" | ":init") => trajectory.add_state(entry, last, &mut names)?,
            Some(":action" | "operator:") => trajectory.add_action(entry, last, &mut names)?,
            Some(":transition_status") => trajectory.add_status(entry)?,
            Some("operators:") => {
                let error = entry.error("joint actions of several agents are not supported");
                return Err(error.as_unsupported());
            }
            Some(other) => return Err(entry.error(format!("unknown entry `{other}` in a trajectory"))),
            None => return Err(entry.error("an entry such as `(:state …)` or `(:action …)` is expected here")),
        }
        if !entry.has_head(":transition_status") {
            last = Some(entry);
        }
    }
    match last {
        None => Err(root.error("the trajectory has no states")),
        Some(last) if trajectory.actions.len() == trajectory.states.len() => {
            Err(last.error("there is no state after the last action"))
        }
        Some(_) => Ok(trajectory),
    }
}

impl Trajectory {
    fn add_state(
        &mut self,
        entry: Sexpr<'_>,
        last: Option<Sexpr<'_>>,
        names: &mut SymbolPool,
    ) -> Result<(), PddlError> {
        if let Some(last) = last.filter(|_| self.states.len() > self.actions.len()) {
            let error = entry.error("there is no action between this state and the one before");
            return Err(error.with_related(entry.document_text(), last.span(), "the state before"));
        }
        if entry.has_head(":init") && !self.states.is_empty() {
            return Err(entry.error("`:init` can only be the first state"));
        }
        let (mut atoms, mut negated) = (Vec::new(), Vec::new());
        for item in entry.children().skip(1) {
            if item.has_head("=") {
                continue;
            }
            if item.has_head("not") {
                match (item.children().nth(1), item.children().nth(2)) {
                    (Some(atom), None) => negated.push((read_atom(atom, names)?, item.span())),
                    _ => return Err(item.error("`not` takes one atom")),
                };
                continue;
            }
            atoms.push((read_atom(item, names)?, item.span()));
        }
        let held: BTreeSet<&GroundAtom> = atoms.iter().map(|(atom, _)| atom).collect();
        if let Some((atom, span)) = negated.iter().find(|(atom, _)| held.contains(atom)) {
            let text = entry.document_text();
            return Err(PddlError::new(text, *span, format!("{atom} is listed both as true and as false")));
        }
        self.states.push(TrajectoryState { atoms, negated, span: entry.span() });
        Ok(())
    }

    fn add_action(
        &mut self,
        entry: Sexpr<'_>,
        last: Option<Sexpr<'_>>,
        names: &mut SymbolPool,
    ) -> Result<(), PddlError> {
        let Some(last) = last else {
            return Err(entry.error("there is no state before the first action"));
        };
        if self.actions.len() == self.states.len() {
            let error = entry.error("there is no state between this action and the one before");
            return Err(error.with_related(entry.document_text(), last.span(), "the action before"));
        }
        let call = match (entry.children().nth(1), entry.children().nth(2)) {
            (Some(call), None) => read_atom(call, names)?,
            _ => return Err(entry.error("one action `(name object …)` is expected in here")),
        };
        let call = GroundCall { name: call.predicate, args: call.args };
        self.actions.push(TrajectoryAction { call, executed: None, span: entry.span() });
        Ok(())
    }

    fn add_status(&mut self, entry: Sexpr<'_>) -> Result<(), PddlError> {
        let follows_action = self.actions.len() == self.states.len();
        let Some(action) = self.actions.last_mut().filter(|a| follows_action && a.executed.is_none()) else {
            return Err(entry.error("`:transition_status` can only follow an action"));
        };
        let status = entry.children().nth(1);
        action.executed = match status.and_then(|s| s.atom().or(s.head())).map(str::to_ascii_lowercase).as_deref() {
            Some("success") => Some(true),
            Some("failure") => Some(false),
            _ => return Err(entry.error("`(success)` or `(failure)` is expected in here")),
        };
        Ok(())
    }
}

/// An atom over objects, or an action, `(name object …)`, in lower case.
pub(crate) fn read_atom(item: Sexpr<'_>, names: &mut SymbolPool) -> Result<GroundAtom, PddlError> {
    if !item.is_list() || item.head().is_none() {
        return Err(item.error("an atom `(name object …)` is expected here"));
    }
    let mut symbols = item.children().map(|part| {
        let text = part.atom().ok_or_else(|| part.error("a name is expected here, not a list"))?;
        let name = names.symbol(&text.to_ascii_lowercase());
        check_name(name.as_str()).map_err(|e| part.error(e.to_string()))?;
        Ok(name)
    });
    let predicate = symbols.next().unwrap_or_else(|| Err(item.error("an atom needs a name")))?;
    let args: Vec<Symbol> = symbols.collect::<Result<_, PddlError>>()?;
    Ok(GroundAtom { predicate, args })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> String {
        let trajectory = read_trajectory(text).expect(text);
        let state = |s: &TrajectoryState| {
            let held = s.atoms.iter().map(|(a, _)| a.to_string());
            held.chain(s.negated.iter().map(|(a, _)| format!("!{a}"))).collect::<Vec<_>>().join(" ")
        };
        let mut out = state(&trajectory.states[0]);
        for (action, after) in trajectory.actions.iter().zip(&trajectory.states[1..]) {
            let status = action.executed.map(|e| format!("={e}")).unwrap_or_default();
            out.push_str(&format!(" | {}{status} | {}", action.call, state(after)));
        }
        out
    }

    #[test]
    fn both_dialects() {
        let amlgym = "(:trajectory\n\n(:state (Clear b) (handempty))\n(:action (Pick_Up B))\n(:state (holding b))\n)";
        assert_eq!(shown(amlgym), "clear(b) handempty() | pick_up(b) | holding(b)");
        let sam = "((:init (clear b) (moving ) (= (weight b) 2.0))\n(operator: (pick b ))\n(:transition_status (failure))\n\
                   (:state (clear b) (not (holding b)))\n(operator: (nop))\n(:transition_status (success))\n(:state))";
        assert_eq!(shown(sam), "clear(b) moving() | pick(b)=false | clear(b) !holding(b) | nop()=true | ");
        assert_eq!(shown("((:state (p)))"), "p()");
    }

    #[test]
    fn what_is_refused() {
        for (text, message) in [
            ("(:trajectory)", "line 1, column 1: the trajectory has no states"),
            ("(:states)", "line 1, column 1: neither `(:trajectory …)` nor `((:init …) …)`"),
            ("()", "line 1, column 1: neither `(:trajectory …)` nor `((:init …) …)`"),
            ("(:trajectory (:action (a)))", "line 1, column 14: there is no state before the first action"),
            ("(:trajectory (:state) (:action (a)))", "line 1, column 23: there is no state after the last action"),
            (
                "(:trajectory (:state)\n(:action (a))\n(:action (b))\n(:state))",
                "line 3, column 1: there is no state between this action and the one before",
            ),
            ("((:init)\n(:state))", "line 2, column 1: there is no action between this state and the one before"),
            ("((:init) (operator: (a)) (:init))", "line 1, column 26: `:init` can only be the first state"),
            ("((:init) (:observed (p)))", "line 1, column 10: unknown entry `:observed` in a trajectory"),
            (
                "((:init) operator:)",
                "line 1, column 10: an entry such as `(:state …)` or `(:action …)` is expected here",
            ),
            ("((:init) (operators: (a) (b)))", "line 1, column 10: joint actions of several agents are not supported"),
            ("((:init) (operator: a b))", "line 1, column 10: one action `(name object …)` is expected in here"),
            ("((:init) (operator: a))", "line 1, column 21: an atom `(name object …)` is expected here"),
            ("((:init p))", "line 1, column 9: an atom `(name object …)` is expected here"),
            ("((:init (on (a))))", "line 1, column 13: a name is expected here, not a list"),
            (
                "((:init (on ?a)))",
                "line 1, column 13: `?a` cannot be a name: it starts with `?`, which marks a parameter",
            ),
            ("((:init (not (p) (q))))", "line 1, column 9: `not` takes one atom"),
            ("((:init (p a) (not (p A))))", "line 1, column 15: p(a) is listed both as true and as false"),
            (
                "((:init) (:transition_status (success)))",
                "line 1, column 10: `:transition_status` can only follow an action",
            ),
            (
                "((:init) (operator: (a)) (:transition_status (maybe)) (:state))",
                "line 1, column 26: `(success)` or `(failure)` is expected in here",
            ),
        ] {
            assert_eq!(read_trajectory(text).expect_err(text).to_string(), message, "{text}");
        }
    }
}
