//! What a domain and a problem require: what they use, and nothing else.

use std::collections::BTreeSet;

use typelift_model::Symbol;

use crate::{Domain, Formula, PddlEffect, Problem};

/// The requirements, in the order in which PDDL lists them. What the problem uses counts too: planners look for it in
/// the domain.
pub(super) fn requirements(domain: &Domain, problem: Option<&Problem>) -> Vec<Symbol> {
    let mut used = BTreeSet::from([":strips"]);
    let mut require = |requirement: &'static str, used_at_all: bool| {
        if used_at_all {
            used.insert(requirement);
        }
    };
    require(":typing", !domain.types.is_empty());
    require(":derived-predicates", !domain.derived.is_empty());
    require(":action-costs", domain.functions.iter().any(|function| function.name == *"total-cost"));
    for action in &domain.actions {
        of_formula(&action.precondition, &mut require);
        of_effect(&action.effect, &mut require);
    }
    for derived in &domain.derived {
        of_formula(&derived.condition, &mut require);
    }
    if let Some(problem) = problem {
        of_formula(&problem.goal, &mut require);
    }
    const ORDER: [&str; 10] = [
        ":strips",
        ":typing",
        ":negative-preconditions",
        ":disjunctive-preconditions",
        ":equality",
        ":existential-preconditions",
        ":universal-preconditions",
        ":conditional-effects",
        ":derived-predicates",
        ":action-costs",
    ];
    ORDER.into_iter().filter(|requirement| used.contains(requirement)).map(Symbol::new).collect()
}

fn of_formula(formula: &Formula, require: &mut impl FnMut(&'static str, bool)) {
    match formula {
        Formula::Atom(_) => {}
        Formula::Equal(..) => require(":equality", true),
        Formula::Not(part) => {
            // `(not (= …))` is a negative precondition too.
            require(":negative-preconditions", true);
            of_formula(part, require);
        }
        Formula::And(parts) => parts.iter().for_each(|part| of_formula(part, require)),
        Formula::Or(parts) => {
            require(":disjunctive-preconditions", true);
            parts.iter().for_each(|part| of_formula(part, require));
        }
        Formula::Imply(condition, consequence) => {
            require(":disjunctive-preconditions", true);
            of_formula(condition, require);
            of_formula(consequence, require);
        }
        Formula::Exists(_, part) => {
            require(":existential-preconditions", true);
            of_formula(part, require);
        }
        Formula::Forall(_, part) => {
            require(":universal-preconditions", true);
            of_formula(part, require);
        }
    }
}

fn of_effect(effect: &PddlEffect, require: &mut impl FnMut(&'static str, bool)) {
    match effect {
        PddlEffect::And(parts) => parts.iter().for_each(|part| of_effect(part, require)),
        PddlEffect::Add(_) | PddlEffect::Delete(_) | PddlEffect::Increase(_) => {}
        PddlEffect::Forall(_, part) => {
            require(":conditional-effects", true);
            of_effect(part, require);
        }
        PddlEffect::When(condition, part) => {
            require(":conditional-effects", true);
            of_formula(condition, require);
            of_effect(part, require);
        }
    }
}
