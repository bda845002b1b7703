//! Actions and axioms in words, as labelled rows.

use std::collections::BTreeSet;

use serde::Serialize;
use typelift_model::{
    ActionModel, ActionSchema, Axiom, Cost, Effect, Evidence, Hierarchy, LiftedAtom, Literal, Parameter, Provenance,
    Support, Symbol, Term, TypeId, describe_replacements, schema_name,
};

use crate::text::{count, places};

/// A labelled row of a description.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Row {
    /// What the row is about: of an action `parameters`, `call`, `needs`, `adds`, `deletes`, `costs`, `merged`, `because`,
    /// `seen`; of an axiom `for all`, `if`.
    pub label: &'static str,
    /// Words, to be broken into lines between them; never empty.
    pub words: Vec<String>,
}

/// An action or an axiom, described.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Description {
    /// Its name; of an axiom the atom that it derives.
    pub name: String,
    /// Where it comes from, in one line.
    pub origin: String,
    /// What it needs and does, and what it rests on.
    pub rows: Vec<Row>,
}

impl Description {
    /// Adds a row; none if there are no words.
    fn row(&mut self, label: &'static str, words: impl IntoIterator<Item = String>) {
        let words: Vec<String> = words.into_iter().collect();
        if !words.is_empty() {
            self.rows.push(Row { label, words });
        }
    }
}

/// An action of a model in words: parameters, what the environment is told, preconditions, effects, what it rests on; with
/// the evidence, also where that was seen.
pub fn describe_action(action: &ActionSchema, model: &ActionModel, evidence: Option<&Evidence>) -> Description {
    let h = &model.hierarchy;
    let mut text = Description { name: action.name.to_string(), origin: origin(action, h), rows: Vec::new() };
    text.row("parameters", action.parameters.iter().map(|p| format!("?{} - {}", p.name, h.name(p.ty))));
    let written = Written { parameters: action.parameters.iter().collect() };
    let args: Vec<String> = action.call.args.iter().map(|term| written.term(term)).collect();
    text.row("call", [format!("{}({})", action.call.name, args.join(", "))]);
    let mut needs: Vec<String> = action.preconditions.iter().map(|l| written.literal(l)).collect();
    // Of learned actions all parameters differ.
    if action.provenance == Provenance::Given {
        let term = |i: u32| written.term(&Term::Param(i));
        needs.extend(action.distinct.iter().map(|&(a, b)| format!("{}≠{}", term(a), term(b))));
    }
    text.row("needs", needs);
    for (label, adds) in [("adds", true), ("deletes", false)] {
        let effects = action.effects.iter().filter(|e| e.literal.positive == adds);
        let (plain, other): (Vec<&Effect>, Vec<&Effect>) = effects.partition(|effect| effect.is_unconditional());
        text.row(label, plain.into_iter().map(|e| written.literal(&Literal::positive(e.literal.atom.clone()))));
        for effect in other {
            text.row(label, conditional(effect, action, h));
        }
    }
    // Where some action costs something else, that one costs 1 is worth saying too.
    if model.actions.iter().any(|any| any.cost != Cost::UNIT) {
        let fixed = (action.cost.fixed > 0 || action.cost.functions.is_empty()).then(|| action.cost.fixed.to_string());
        let functions = action.cost.functions.iter().map(|f| written.atom(f));
        text.row("costs", [fixed.into_iter().chain(functions).collect::<Vec<_>>().join(" + ")]);
    }
    text.add_support(action, model, evidence);
    text
}

impl Description {
    /// What an action rests on and, with the evidence, where that was seen.
    fn add_support(&mut self, action: &ActionSchema, model: &ActionModel, evidence: Option<&Evidence>) {
        let support = action.provenance.support();
        if support.len() > 1 {
            self.row("merged", support.iter().map(|s| format!("{} {}", individual_name(s, model), s.observations)));
            self.row("because", because(action, model));
        }
        let Some(total) = evidence.map(Evidence::total) else { return };
        for support in support {
            let cluster = total.clusters.get(&*support.cluster);
            let places = cluster.map(|cluster| places(&cluster.witnesses, cluster.count)).unwrap_or_default();
            self.row("seen", [format!("{}: {places}", individual_name(support, model))]);
        }
    }
}

/// Lifted things with the names of their parameters.
pub(crate) struct Written<'a> {
    pub(crate) parameters: Vec<&'a Parameter>,
}

impl Written<'_> {
    fn term(&self, term: &Term) -> String {
        match term {
            Term::Param(i) => format!("?{}", self.parameters[*i as usize].name),
            Term::Const(name) => name.to_string(),
        }
    }

    pub(crate) fn atom(&self, atom: &LiftedAtom) -> String {
        let args: Vec<String> = atom.args.iter().map(|term| self.term(term)).collect();
        match args.as_slice() {
            [a, b] if atom.is_equality() => format!("{a}={b}"),
            _ => format!("{}({})", atom.predicate, args.join(",")),
        }
    }

    pub(crate) fn literal(&self, literal: &Literal) -> String {
        format!("{}{}", if literal.positive { "" } else { "not " }, self.atom(&literal.atom))
    }
}

/// `p(?x) for all ?x - t if q(?x) r(?x)`, in words.
pub(crate) fn conditional(effect: &Effect, action: &ActionSchema, hierarchy: &Hierarchy) -> Vec<String> {
    let written = Written { parameters: action.parameters.iter().chain(&effect.parameters).collect() };
    let mut words = vec![written.atom(&effect.literal.atom)];
    if !effect.parameters.is_empty() {
        words.push("for all".to_owned());
        words.extend(effect.parameters.iter().map(|p| format!("?{} - {}", p.name, hierarchy.name(p.ty))));
    }
    if !effect.condition.is_empty() {
        words.push("if".to_owned());
        words.extend(effect.condition.iter().map(|literal| written.literal(literal)));
    }
    words
}

/// How a derived predicate follows, in words.
pub fn describe_axiom(axiom: &Axiom, model: &ActionModel) -> Description {
    let written = Written { parameters: axiom.parameters.iter().collect() };
    let mut text = Description { name: written.atom(&axiom.head), origin: "derived".to_owned(), rows: Vec::new() };
    text.row("for all", axiom.parameters.iter().map(|p| format!("?{} - {}", p.name, model.hierarchy.name(p.ty))));
    // What can never follow is written as following from itself, so that it is derived nevertheless.
    let is_own = axiom.body.iter().any(|literal| literal.positive && literal.atom == axiom.head);
    let never = is_own.then(|| "(which is itself: this never makes it hold)".to_owned());
    text.row("if", axiom.body.iter().map(|literal| written.literal(literal)).chain(never));
    text
}

/// Where an action comes from, in one line.
fn origin(action: &ActionSchema, hierarchy: &Hierarchy) -> String {
    let observations = count(action.provenance.observations(), "observation");
    match &action.provenance {
        Provenance::Given => "given".to_owned(),
        Provenance::Demonstrated(_) => observations,
        Provenance::Generalized(support) => {
            format!("{observations} of {}", count(support.len() as u64, "individual action"))
        }
        Provenance::Imagined { from, replaced, goal, positive, .. } => {
            let not = if *positive { "" } else { "not " };
            format!(
                "imagined for {not}{goal}: {}, from {from}, {observations}",
                describe_replacements(replaced, hierarchy)
            )
        }
        Provenance::Substituted { from, replaced, following, .. } => {
            format!("follows {following}: {}, from {from}, {observations}", describe_replacements(replaced, hierarchy))
        }
        Provenance::Loosened { from, without, .. } => {
            let written = Written { parameters: action.parameters.iter().collect() };
            let without: Vec<String> = without.iter().map(|atom| written.atom(atom)).collect();
            format!("imagined: without {}, which always held, from {from}, {observations}", without.join(" and "))
        }
    }
}

/// The name that an individual action over this cluster has.
pub fn individual_name(support: &Support, model: &ActionModel) -> String {
    let key = &support.cluster;
    let is_actor = |name: &Symbol| model.hierarchy.id(name.as_str()).is_some_and(|ty| model.is_actor(ty));
    schema_name(&key.action, key.types.iter().map(|name| (name, is_actor(name))))
}

/// The types that cover these as well and are as low, where there are several: `, which covers no more than tool would`.
fn rather_than(hierarchy: &Hierarchy, met: impl Iterator<Item = TypeId>, taken: TypeId) -> String {
    let met: Vec<TypeId> = met.collect();
    let covers = |ty: TypeId| met.iter().all(|&met| hierarchy.is_a(met, ty));
    let common: Vec<TypeId> = hierarchy.types().filter(|&ty| covers(ty)).collect();
    let is_lowest = |ty: TypeId| !common.iter().any(|&other| other != ty && hierarchy.is_a(other, ty));
    let others = common.iter().filter(|&&ty| ty != taken && is_lowest(ty)).map(|&ty| hierarchy.name(ty).as_str());
    let others: Vec<&str> = others.collect();
    if others.is_empty() { String::new() } else { format!(", which covers no more than {} would", others.join(" or ")) }
}

/// The types that the individual actions behind an action have for this parameter.
pub(crate) fn types_met(action: &ActionSchema, parameter: usize) -> BTreeSet<&Symbol> {
    let own = |support: &Support| support.map.iter().position(|&p| p as usize == parameter);
    let supports = action.provenance.support().iter();
    supports.filter_map(|support| Some(&support.cluster.types[own(support)?])).collect()
}

/// Why individual actions were merged: the same effect, and where their types meet.
fn because(action: &ActionSchema, model: &ActionModel) -> Vec<String> {
    let mut reasons = vec!["all have this effect;".to_owned()];
    for (i, parameter) in action.parameters.iter().enumerate() {
        let met = types_met(action, i);
        if met.len() > 1 {
            let names: Vec<&str> = met.iter().map(|name| name.as_str()).collect();
            let hierarchy = &model.hierarchy;
            let of_others =
                rather_than(hierarchy, met.iter().filter_map(|name| hierarchy.id(name.as_str())), parameter.ty);
            reasons.push(format!("{} meet in {}{of_others};", names.join(", "), hierarchy.name(parameter.ty)));
        }
    }
    if let Some(last) = reasons.last_mut() {
        last.pop();
    }
    reasons
}
