//! Which requirements a domain or a problem uses, whatever it says it requires.

use typelift_model::{ROOT, Symbol};

use crate::{Domain, Formula, PddlEffect, Problem, Typed};

/// In the order in which they are listed.
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

/// What requirements bring with them.
const BROUGHT: [(&str, &[&str]); 5] = [
    (":adl", ORDER.split_at(8).0),
    (":quantified-preconditions", &[":existential-preconditions", ":universal-preconditions"]),
    (":negation", &[":negative-preconditions"]),
    (":fluents", &[":action-costs"]),
    (":numeric-fluents", &[":action-costs"]),
];

/// The requirements that a domain uses, in the usual order; `:strips` always.
pub fn required_by_domain(domain: &Domain) -> Vec<&'static str> {
    let mut used = Used::default();
    let signatures = domain.predicates.iter().chain(&domain.functions);
    let lists = signatures.map(|signature| &signature.parameters).chain([&domain.constants]);
    lists.for_each(|list| used.typed(list));
    used.note(":typing", !domain.types.is_empty());
    used.note(":action-costs", !domain.functions.is_empty());
    for derived in &domain.derived {
        used.note(":derived-predicates", true);
        used.typed(&derived.head.parameters);
        used.formula(&derived.condition);
    }
    for action in &domain.actions {
        used.typed(&action.parameters);
        used.formula(&action.precondition);
        used.effect(&action.effect);
    }
    used.in_order()
}

/// The requirements that a problem uses by itself, in the usual order; `:strips` always.
pub fn required_by_problem(problem: &Problem) -> Vec<&'static str> {
    let mut used = Used::default();
    used.typed(&problem.objects);
    used.formula(&problem.goal);
    used.note(":action-costs", problem.minimizes_cost || !problem.values.is_empty());
    used.in_order()
}

/// The requirements that a domain and a problem for it use together, in the usual order.
pub(crate) fn required_by_both(domain: &Domain, problem: &Problem) -> Vec<&'static str> {
    let used = [required_by_domain(domain), required_by_problem(problem)].concat();
    Used(used).in_order()
}

/// Those of `used` that are not among `declared` and not brought by them. Where nothing is declared, `:strips` is.
pub fn undeclared_requirements(used: &[&'static str], declared: &[Symbol]) -> Vec<&'static str> {
    let is_declared = |name: &str| declared.iter().any(|other| other == name);
    let is_brought = |name: &str| BROUGHT.iter().any(|(by, brought)| brought.contains(&name) && is_declared(by));
    used.iter().copied().filter(|name| *name != ":strips" && !is_declared(name) && !is_brought(name)).collect()
}

#[derive(Debug, Default)]
struct Used(Vec<&'static str>);

impl Used {
    fn note(&mut self, name: &'static str, is_used: bool) {
        if is_used && !self.0.contains(&name) {
            self.0.push(name);
        }
    }

    fn in_order(&self) -> Vec<&'static str> {
        ORDER.into_iter().filter(|name| *name == ":strips" || self.0.contains(name)).collect()
    }

    fn typed(&mut self, list: &[Typed]) {
        self.note(":typing", list.iter().any(|typed| typed.types != [ROOT]));
    }

    fn formula(&mut self, formula: &Formula) {
        match formula {
            Formula::Atom(_) => {}
            Formula::Equal(..) => self.note(":equality", true),
            Formula::Not(negated) => {
                let literal = matches!(**negated, Formula::Atom(_) | Formula::Equal(..));
                self.note(if literal { ":negative-preconditions" } else { ":disjunctive-preconditions" }, true);
                self.formula(negated);
            }
            Formula::And(parts) => parts.iter().for_each(|part| self.formula(part)),
            Formula::Or(parts) => {
                self.note(":disjunctive-preconditions", true);
                parts.iter().for_each(|part| self.formula(part));
            }
            Formula::Imply(premise, conclusion) => {
                self.note(":disjunctive-preconditions", true);
                self.formula(premise);
                self.formula(conclusion);
            }
            Formula::Exists(variables, body) => {
                self.note(":existential-preconditions", true);
                self.typed(variables);
                self.formula(body);
            }
            Formula::Forall(variables, body) => {
                self.note(":universal-preconditions", true);
                self.typed(variables);
                self.formula(body);
            }
        }
    }

    fn effect(&mut self, effect: &PddlEffect) {
        match effect {
            PddlEffect::Add(_) | PddlEffect::Delete(_) => {}
            PddlEffect::And(parts) => parts.iter().for_each(|part| self.effect(part)),
            PddlEffect::Forall(variables, inner) => {
                self.note(":conditional-effects", true);
                self.typed(variables);
                self.effect(inner);
            }
            PddlEffect::When(condition, inner) => {
                self.note(":conditional-effects", true);
                self.formula(condition);
                self.effect(inner);
            }
            PddlEffect::Increase(_) => self.note(":action-costs", true),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read_domain;

    fn used(blocks: &str) -> String {
        let text = format!("(define (domain d) (:predicates (p ?x) (q)) {blocks})");
        required_by_domain(&read_domain(&text).expect(blocks)).join(" ")
    }

    #[test]
    fn what_is_used_is_required() {
        for (blocks, required) in [
            ("", ":strips"),
            ("(:types t)", ":strips :typing"),
            ("(:action a :effect (not (q)))", ":strips"),
            (
                "(:action a :parameters (?x) :effect (when (not (p ?x)) (q)))",
                ":strips :negative-preconditions :conditional-effects",
            ),
            ("(:action a :parameters (?x) :precondition (not (and (p ?x) (q))))", ":strips :disjunctive-preconditions"),
            (
                "(:action a :precondition (exists (?x) (forall (?y) (= ?x ?y))))",
                ":strips :equality :existential-preconditions :universal-preconditions",
            ),
            ("(:functions (total-cost))", ":strips :action-costs"),
            ("(:derived (q) (imply (q) (q)))", ":strips :disjunctive-preconditions :derived-predicates"),
        ] {
            assert_eq!(used(blocks), required, "{blocks}");
        }
    }

    #[test]
    fn requirements_bring_others() {
        let undeclared = |declared: &[&str]| {
            let declared: Vec<Symbol> = declared.iter().map(|name| Symbol::new(name)).collect();
            undeclared_requirements(&ORDER, &declared).join(" ")
        };
        assert_eq!(undeclared(&[":strips", ":adl"]), ":derived-predicates :action-costs");
        assert_eq!(undeclared(&ORDER[1..]), "");
        assert_eq!(
            undeclared(&[":typing", ":negation", ":quantified-preconditions", ":fluents"]),
            ":disjunctive-preconditions :equality :conditional-effects :derived-predicates"
        );
    }
}
