//! The compiler's rules, one by one: domains in a few words, models as lines of text.

mod actions;
mod axioms;
mod effects;
mod goals;

use typelift_model::{ActionModel, LearnedModel, Literal, Parameter, Symbol, Task};

use super::limits::Limits;
use super::{CompileError, compile_domain, compile_problem, domain_within};
use crate::{Action, Amount, Derived, Domain, Formula, PddlAtom, PddlEffect, PddlTerm, Problem, Signature, Typed};

/// `x y - truck z - place|depot`: names with their types.
fn typed(text: &str) -> Vec<Typed> {
    let mut list: Vec<Typed> = Vec::new();
    let mut words = text.split_whitespace();
    while let Some(word) = words.next() {
        if word == "-" {
            let types: Vec<Symbol> = words.next().expect("a type").split('|').map(Symbol::new).collect();
            list.iter_mut().filter(|typed| typed.types.is_empty()).for_each(|typed| typed.types.clone_from(&types));
        } else {
            list.push(Typed { name: Symbol::new(word), types: Vec::new() });
        }
    }
    list.iter_mut().filter(|typed| typed.types.is_empty()).for_each(|typed| typed.types.push(Symbol::new("object")));
    list
}

fn term(word: &str) -> PddlTerm {
    match word.strip_prefix('?') {
        Some(name) => PddlTerm::Variable(Symbol::new(name)),
        None => PddlTerm::Object(Symbol::new(word)),
    }
}

/// `at ?x depot`.
fn atom(text: &str) -> PddlAtom {
    let mut words = text.split_whitespace();
    PddlAtom::new(words.next().expect("a predicate"), words.map(term).collect())
}

fn is(text: &str) -> Formula {
    Formula::Atom(atom(text))
}

fn equal(a: &str, b: &str) -> Formula {
    Formula::Equal(term(a), term(b))
}

fn not(formula: Formula) -> Formula {
    Formula::Not(Box::new(formula))
}

fn and<const N: usize>(parts: [Formula; N]) -> Formula {
    Formula::And(parts.into())
}

fn or<const N: usize>(parts: [Formula; N]) -> Formula {
    Formula::Or(parts.into())
}

fn exists(variables: &str, body: Formula) -> Formula {
    Formula::Exists(typed(variables), Box::new(body))
}

fn forall(variables: &str, body: Formula) -> Formula {
    Formula::Forall(typed(variables), Box::new(body))
}

fn add(text: &str) -> PddlEffect {
    PddlEffect::Add(atom(text))
}

fn delete(text: &str) -> PddlEffect {
    PddlEffect::Delete(atom(text))
}

fn when(condition: Formula, effect: PddlEffect) -> PddlEffect {
    PddlEffect::When(condition, Box::new(effect))
}

fn each(variables: &str, effect: PddlEffect) -> PddlEffect {
    PddlEffect::Forall(typed(variables), Box::new(effect))
}

fn both(a: PddlEffect, b: PddlEffect) -> PddlEffect {
    PddlEffect::And(vec![a, b])
}

fn signature(text: &str) -> Signature {
    let (name, parameters) = text.split_once(' ').unwrap_or((text, ""));
    Signature { name: Symbol::new(name), parameters: typed(parameters) }
}

fn action(name: &str, parameters: &str, precondition: Formula, effect: PddlEffect) -> Action {
    Action { name: Symbol::new(name), parameters: typed(parameters), precondition, effect, comment: Vec::new() }
}

fn derived(head: &str, condition: Formula) -> Derived {
    Derived { head: signature(head), condition, comment: Vec::new() }
}

/// Trucks and boats, which are vehicles, and places.
fn domain(actions: Vec<Action>) -> Domain {
    let types = [("vehicle", "object"), ("truck", "vehicle"), ("boat", "vehicle"), ("place", "object")];
    let predicates =
        ["at v - vehicle p - place", "road p q - place", "clean v - vehicle", "wet", "reach p - place", "ok"];
    Domain {
        types: types.map(|(child, parent)| (Symbol::new(child), Symbol::new(parent))).into(),
        constants: typed("depot - place van - truck"),
        predicates: predicates.map(signature).into(),
        functions: ["total-cost", "length p q - place"].map(signature).into(),
        actions,
        ..Domain::default()
    }
}

fn with_derived(actions: Vec<Action>, derived: Vec<Derived>) -> Domain {
    Domain { derived, ..domain(actions) }
}

fn problem(goal: Formula) -> Problem {
    Problem {
        name: Symbol::new("p"),
        domain: Symbol::new("d"),
        requirements: Vec::new(),
        objects: typed("t - truck b - boat home - place"),
        init: vec![typelift_model::Atom::new("road", vec![Symbol::new("depot"), Symbol::new("home")])],
        values: Vec::new(),
        goal,
        minimizes_cost: false,
        comment: Vec::new(),
    }
}

fn shown(parameters: &[Parameter], model: &ActionModel) -> String {
    let one = |p: &Parameter| format!("{}:{}", p.name, model.hierarchy.name(p.ty));
    parameters.iter().map(one).collect::<Vec<_>>().join(" ")
}

fn conjunction(literals: &[Literal]) -> String {
    literals.iter().map(ToString::to_string).collect::<Vec<_>>().join(" & ")
}

/// Each action on a line: `name call(args) [parameters] preconditions; distinct; effects`.
fn actions(model: &ActionModel) -> Vec<String> {
    let shown_action = |a: &typelift_model::ActionSchema| {
        let args = typelift_model::Atom::new(a.call.name.clone(), a.call.args.clone());
        let effects: Vec<String> = a.effects.iter().map(|e| shown_effect(e, model)).collect();
        let distinct: String = a.distinct.iter().map(|(i, j)| format!(" ?{i}!=?{j}")).collect();
        let parameters = shown(&a.parameters, model);
        format!(
            "{} {args} [{parameters}] {}{distinct} => {}",
            a.name,
            conjunction(&a.preconditions),
            effects.join(", ")
        )
    };
    model.actions.iter().map(shown_action).collect()
}

fn shown_effect(effect: &typelift_model::Effect, model: &ActionModel) -> String {
    let parameters = shown(&effect.parameters, model);
    match (parameters.is_empty(), effect.condition.is_empty()) {
        (true, true) => effect.literal.to_string(),
        _ => format!("[{parameters}] {} > {}", conjunction(&effect.condition), effect.literal),
    }
}

/// Each axiom on a line: `stratum head [parameters] body`.
fn axioms(model: &ActionModel) -> Vec<String> {
    let shown_axiom = |a: &typelift_model::Axiom| {
        format!("{} {} [{}] {}", a.stratum, a.head, shown(&a.parameters, model), conjunction(&a.body))
    };
    model.axioms.iter().map(shown_axiom).collect()
}

/// The model, written to its file and read again; with the wordings, which the file does not hold.
pub(super) fn written_and_read(model: &ActionModel) -> ActionModel {
    let text = LearnedModel::from(model.clone()).to_json().expect("it is written");
    ActionModel {
        wordings: model.wordings.clone(),
        never_used: model.never_used.clone(),
        ..LearnedModel::from_json(&text).expect("it is read").model
    }
}

fn compiled(domain: &Domain) -> ActionModel {
    let model = compile_domain(domain).expect("it compiles");
    let read = written_and_read(&model);
    assert_eq!(read, model);
    model
}

/// The actions that come from `go` with this precondition and the effect `wet`.
fn go(parameters: &str, precondition: Formula) -> Vec<String> {
    actions(&compiled(&domain(vec![action("go", parameters, precondition, add("wet"))])))
}

/// The effects of `go` on a vehicle v and a place p.
fn effects(effect: PddlEffect) -> Vec<String> {
    let model = compiled(&domain(vec![action("go", "v - vehicle p - place", and([]), effect)]));
    model.actions[0].effects.iter().map(|effect| shown_effect(effect, &model)).collect()
}

/// The goal's literals and its axioms.
fn goal(formula: Formula) -> (String, Vec<String>) {
    let mut model = compiled(&domain(vec![action(
        "go",
        "v - vehicle p - place",
        and([]),
        both(add("at ?v ?p"), both(delete("clean ?v"), add("wet"))),
    )]));
    let task = compile_problem(&problem(formula), &mut model).expect("it compiles");
    (shown_goal(&task), axioms(&model))
}

fn shown_goal(task: &Task) -> String {
    let one =
        |(atom, positive): (&typelift_model::GroundAtom, bool)| format!("{}{atom}", if positive { "" } else { "not " });
    task.goal.literals().map(one).collect::<Vec<_>>().join(" & ")
}

fn refused(domain: &Domain) -> CompileError {
    compile_domain(domain).expect_err("it is refused")
}
