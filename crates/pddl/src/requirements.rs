//! What a domain says it requires, and what it does require.

use typelift_model::{Symbol, did_you_mean};

use crate::names::lower;
use crate::{PddlError, Sexpr};

/// The requirements that are honoured. `:fluents` and `:numeric-fluents` are as far as action costs go, which is
/// decided where numbers are used; `:negation` is the old name of `:negative-preconditions`.
const SUPPORTED: [&str; 16] = [
    ":strips",
    ":typing",
    ":negative-preconditions",
    ":disjunctive-preconditions",
    ":equality",
    ":existential-preconditions",
    ":universal-preconditions",
    ":quantified-preconditions",
    ":conditional-effects",
    ":adl",
    ":derived-predicates",
    ":action-costs",
    ":fluents",
    ":numeric-fluents",
    ":constants",
    ":negation",
];

/// Other requirements of some version of PDDL.
const UNSUPPORTED: [&str; 26] = [
    ":durative-actions",
    ":duration-inequalities",
    ":continuous-effects",
    ":timed-initial-literals",
    ":timed-initial-fluents",
    ":time",
    ":object-fluents",
    ":preferences",
    ":constraints",
    ":domain-axioms",
    ":goal-utilities",
    ":open-world",
    ":true-negation",
    ":safety-constraints",
    ":action-expansions",
    ":foreach-expansions",
    ":dag-expansions",
    ":subgoals-through-axioms",
    ":expression-evaluation",
    ":ucpop",
    ":htn",
    ":hierarchy",
    ":method-preconditions",
    ":probabilistic-effects",
    ":rewards",
    ":non-deterministic",
];

/// Reads `(:requirements …)`.
///
/// # Errors
/// [`PddlError`] at a requirement that is not honoured.
pub(crate) fn read_requirements(block: Option<Sexpr<'_>>) -> Result<Vec<Symbol>, PddlError> {
    let listed = block.into_iter().flat_map(|block| block.children().skip(1));
    listed.map(read_requirement).collect()
}

fn read_requirement(item: Sexpr<'_>) -> Result<Symbol, PddlError> {
    let Some(name) = item.atom() else {
        return Err(item.error("a requirement is a word such as `:strips`, not a list"));
    };
    let name = lower(name);
    if SUPPORTED.contains(&&*name) {
        return Ok(Symbol::new(&name));
    }
    if UNSUPPORTED.contains(&&*name) {
        let error = item.error(format!("requirement `{name}` is not supported")).as_unsupported();
        return Err(error.with_hint("If nothing in this file needs it, take it out."));
    }
    let error = item.error(format!("there is no requirement `{name}`"));
    let hint = did_you_mean(&name, &SUPPORTED.map(Symbol::new));
    Err(error.with_hint(hint.unwrap_or_else(|| format!("There are {}.", SUPPORTED.join(", ")))))
}
