//! How two models differ, whatever their parameters are called.
//!
//! `matching.rs` finds which action of one is which of the other, and how its parameters are called there. What is left is
//! a comparison of what is said of both.

mod matching;

use std::collections::BTreeSet;

use serde::Serialize;
use typelift_model::{ActionModel, ActionSchema, Effect, Evidence, Literal, Parameter};

use crate::action::{Written, conditional, describe_axiom};
use crate::text::{Role, Text, count};
use matching::{Pair, matching};

/// What only one of two lists has, each in its order.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ListDifference {
    /// What only the first has.
    pub only_first: Vec<String>,
    /// What only the second has.
    pub only_second: Vec<String>,
}

/// How an action differs in two models; the second's parameters are called as the first's.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ActionDifference {
    /// Its name in the first model.
    pub first: String,
    /// Its name in the second.
    pub second: String,
    /// How its parameters' types differ.
    #[serde(skip_serializing_if = "ListDifference::is_empty")]
    #[cfg_attr(feature = "schema", schemars(default))]
    pub parameters: ListDifference,
    /// How its preconditions differ.
    #[serde(skip_serializing_if = "ListDifference::is_empty")]
    #[cfg_attr(feature = "schema", schemars(default))]
    pub needs: ListDifference,
    /// How its add effects differ.
    #[serde(skip_serializing_if = "ListDifference::is_empty")]
    #[cfg_attr(feature = "schema", schemars(default))]
    pub adds: ListDifference,
    /// How its delete effects differ.
    #[serde(skip_serializing_if = "ListDifference::is_empty")]
    #[cfg_attr(feature = "schema", schemars(default))]
    pub deletes: ListDifference,
    /// How its cost differs.
    #[serde(skip_serializing_if = "ListDifference::is_empty")]
    #[cfg_attr(feature = "schema", schemars(default))]
    pub costs: ListDifference,
}

/// How two models differ.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ModelDifference {
    /// Whether they act alike: then nothing differs, but perhaps of which types a predicate is known, and what follows from
    /// that for goals, and from how much they were learned.
    pub same: bool,
    /// Who acts by default, `none` if nobody does.
    pub actor: ListDifference,
    /// Types, each with a parent.
    pub types: ListDifference,
    /// Predicates, each with the types of its arguments.
    pub predicates: ListDifference,
    /// Derived predicates, each with what it follows from.
    pub axioms: ListDifference,
    /// Actions of which the other model has none alike.
    pub actions: ListDifference,
    /// Actions that both have, and that differ.
    pub changed: Vec<ActionDifference>,
    /// How much they were learned from, in words: only what differs. Models may be the same all the same.
    #[serde(skip_serializing_if = "ListDifference::is_empty")]
    #[cfg_attr(feature = "schema", schemars(default))]
    pub evidence: ListDifference,
}

/// Compares two models: actions of one skill are the same where their effects, renamed, have most in common. `beside_pddl`
/// takes names that differ in case only for the same, as PDDL does, and leaves out who acts, which PDDL does not say. The
/// time is quadratic in the actions of one skill, and factorial in the parameters that the call does not name, of which at
/// most six are renamed.
pub fn difference(first: &ActionModel, second: &ActionModel, beside_pddl: bool) -> ModelDifference {
    let fold = |text: String| if beside_pddl { text.to_lowercase() } else { text };
    let compare = |list: fn(&ActionModel) -> Vec<String>| {
        let set = |model| list(model).into_iter().map(fold).collect();
        ListDifference::of(&set(first), &set(second))
    };
    let pairs = matching(first, second, &fold);
    let alone = |actions: &[ActionSchema], matched: &BTreeSet<usize>| -> Vec<String> {
        let alone = actions.iter().enumerate().filter(|(i, _)| !matched.contains(i));
        let names: BTreeSet<String> = alone.map(|(_, action)| action.name.to_string()).collect();
        names.into_iter().collect()
    };
    let actions = ListDifference {
        only_first: alone(&first.actions, &pairs.iter().map(|pair| pair.first).collect()),
        only_second: alone(&second.actions, &pairs.iter().map(|pair| pair.second).collect()),
    };
    let mut found = ModelDifference {
        same: false,
        actor: if beside_pddl { ListDifference::default() } else { compare(actor) },
        types: compare(types),
        predicates: compare(predicates),
        axioms: compare(axioms),
        actions,
        changed: pairs.iter().map(|pair| changes(pair, first, second, &fold)).filter(|c| !c.is_empty(&fold)).collect(),
        evidence: ListDifference::default(),
    };
    let mut of_acting = ModelDifference { predicates: ListDifference::default(), ..found.clone() };
    if !found.predicates.is_empty() {
        of_acting.predicates = compare(arities);
    }
    found.same = of_acting == ModelDifference::default();
    found
}

/// Compares how much two models were learned from. In time of the evidence.
pub fn evidence_difference(first: &Evidence, second: &Evidence) -> ListDifference {
    let amounts = |evidence: &Evidence| {
        let total = evidence.total();
        [
            count(evidence.sources().len() as u64, "demonstration"),
            count(total.transitions, "transition"),
            count(total.failures(), "failure"),
        ]
    };
    let (of_first, of_second) = (amounts(first), amounts(second));
    let differing = of_first.into_iter().zip(of_second).filter(|(one, other)| one != other);
    let (only_first, only_second) = differing.unzip();
    ListDifference { only_first, only_second }
}

impl ListDifference {
    fn of(first: &BTreeSet<String>, second: &BTreeSet<String>) -> Self {
        Self {
            only_first: first.difference(second).cloned().collect(),
            only_second: second.difference(first).cloned().collect(),
        }
    }

    /// Whether nothing differs.
    pub fn is_empty(&self) -> bool {
        self.only_first.is_empty() && self.only_second.is_empty()
    }

    /// How much differs.
    pub fn len(&self) -> usize {
        self.only_first.len() + self.only_second.len()
    }
}

impl ActionDifference {
    fn is_empty(&self, fold: &impl Fn(String) -> String) -> bool {
        let parts = [&self.parameters, &self.needs, &self.adds, &self.deletes, &self.costs];
        parts.iter().all(|part| part.is_empty()) && fold(self.first.clone()) == fold(self.second.clone())
    }
}

fn actor(model: &ActionModel) -> Vec<String> {
    vec![model.actor.map_or_else(|| "none".to_owned(), |ty| model.hierarchy.name(ty).to_string())]
}

fn types(model: &ActionModel) -> Vec<String> {
    model.hierarchy.edges().map(|(child, parent)| format!("{child} - {parent}")).collect()
}

fn predicates(model: &ActionModel) -> Vec<String> {
    let said = model.predicates.iter().map(|(name, types)| {
        let types: Vec<&str> = types.iter().map(|ty| model.hierarchy.name(*ty).as_str()).collect();
        format!("{name}({})", types.join(", "))
    });
    said.collect()
}

/// Predicates, each with the number of its arguments.
fn arities(model: &ActionModel) -> Vec<String> {
    model.predicates.iter().map(|(name, types)| format!("{name}/{}", types.len())).collect()
}

fn axioms(model: &ActionModel) -> Vec<String> {
    let said = model.axioms.iter().map(|axiom| {
        let description = describe_axiom(axiom, model);
        let rows = description.rows.iter().map(|row| format!("{} {}", row.label, row.words.join(" ")));
        format!("{} {}", description.name, rows.collect::<Vec<_>>().join(" "))
    });
    said.collect()
}

/// An action in words, its parameters called as another calls its own.
struct ActionText {
    parameters: BTreeSet<String>,
    needs: BTreeSet<String>,
    adds: BTreeSet<String>,
    deletes: BTreeSet<String>,
    costs: BTreeSet<String>,
}

impl ActionText {
    /// Of an action of this model; `names[i]` is what its parameter `i` is called.
    fn of(action: &ActionSchema, model: &ActionModel, names: &[Parameter], fold: &impl Fn(String) -> String) -> Self {
        let h = &model.hierarchy;
        let written = Written { parameters: names.iter().collect() };
        let typed = names.iter().zip(&action.parameters).map(|(name, p)| format!("?{} - {}", name.name, h.name(p.ty)));
        // Things of types that exclude each other differ anyway, said or not.
        let may_be_one =
            |&&(a, b): &&(u32, u32)| !h.disjoint(action.parameters[a as usize].ty, action.parameters[b as usize].ty);
        let distinct = action.distinct.iter().filter(may_be_one).map(|&(a, b)| {
            let mut pair = [&names[a as usize].name, &names[b as usize].name];
            pair.sort();
            format!("?{}≠?{}", pair[0], pair[1])
        });
        let effects = |adds: bool| {
            let effects = action.effects.iter().filter(move |effect| effect.literal.positive == adds);
            effects.map(|effect| fold(effect_in_words(effect, action, names, model))).collect()
        };
        let functions = action.cost.functions.iter().map(|function| written.atom(function));
        Self {
            parameters: typed.map(fold).collect(),
            needs: action.preconditions.iter().map(|l| written.literal(l)).chain(distinct).map(fold).collect(),
            adds: effects(true),
            deletes: effects(false),
            costs: functions.chain([action.cost.fixed.to_string()]).map(fold).collect(),
        }
    }
}

fn effect_in_words(effect: &Effect, action: &ActionSchema, names: &[Parameter], model: &ActionModel) -> String {
    if effect.is_unconditional() {
        let written = Written { parameters: names.iter().collect() };
        return written.literal(&Literal::positive(effect.literal.atom.clone()));
    }
    let renamed = ActionSchema { parameters: names.to_vec(), ..action.clone() };
    conditional(effect, &renamed, &model.hierarchy).join(" ")
}

fn changes(
    pair: &Pair,
    first: &ActionModel,
    second: &ActionModel,
    fold: &impl Fn(String) -> String,
) -> ActionDifference {
    let (a, b) = (&first.actions[pair.first], &second.actions[pair.second]);
    let said_of_a = ActionText::of(a, first, &a.parameters, fold);
    let names: Vec<Parameter> = pair.renaming.iter().map(|&of_a| a.parameters[of_a].clone()).collect();
    let said_of_b = ActionText::of(b, second, &names, fold);
    ActionDifference {
        first: a.name.to_string(),
        second: b.name.to_string(),
        parameters: ListDifference::of(&said_of_a.parameters, &said_of_b.parameters),
        needs: ListDifference::of(&said_of_a.needs, &said_of_b.needs),
        adds: ListDifference::of(&said_of_a.adds, &said_of_b.adds),
        deletes: ListDifference::of(&said_of_a.deletes, &said_of_b.deletes),
        costs: ListDifference::of(&said_of_a.costs, &said_of_b.costs),
    }
}

/// The difference in lines: `-` before what only the first has, `+` before what only the second has, and first of all
/// before the `names` of the two.
pub fn difference_lines(found: &ModelDifference, names: [&str; 2]) -> Vec<Text> {
    let mut lines = Vec::new();
    if *found != (ModelDifference { same: true, ..ModelDifference::default() }) {
        lines.push(Text::new().with(Role::Bad, format!("- {}", names[0])));
        lines.push(Text::new().with(Role::Good, format!("+ {}", names[1])));
    }
    if found.same {
        let as_known =
            if found.predicates.is_empty() { "" } else { ", but for the types of which predicates are known" };
        lines.push(Text::new().with(Role::Good, "the same").plain(as_known));
    }
    let parts = [
        ("actor", &found.actor),
        ("types", &found.types),
        ("predicates", &found.predicates),
        ("axioms", &found.axioms),
        ("actions", &found.actions),
    ];
    for (what, list) in parts {
        push_list(&mut lines, 0, what, list);
    }
    for action in &found.changed {
        let renamed = if action.first == action.second { String::new() } else { format!(" / {}", action.second) };
        lines.push(Text::new().with(Role::Heading, action.first.as_str()).plain(renamed));
        let parts = [
            ("parameters", &action.parameters),
            ("needs", &action.needs),
            ("adds", &action.adds),
            ("deletes", &action.deletes),
            ("costs", &action.costs),
        ];
        if parts.iter().all(|(_, list)| list.is_empty()) {
            lines.push(Text::new().plain("  ").with(Role::Aside, "only the name differs"));
        }
        for (what, list) in parts {
            push_list(&mut lines, 2, what, list);
        }
    }
    push_list(&mut lines, 0, "learned from", &found.evidence);
    lines
}

fn push_list(lines: &mut Vec<Text>, indent: usize, what: &str, list: &ListDifference) {
    if list.is_empty() {
        return;
    }
    let space = " ".repeat(indent);
    let role = if indent == 0 { Role::Heading } else { Role::Aside };
    lines.push(Text::new().plain(space.clone()).with(role, what));
    lines.extend(list.only_first.iter().map(|said| Text::new().with(Role::Bad, format!("{space}  - {said}"))));
    lines.extend(list.only_second.iter().map(|said| Text::new().with(Role::Good, format!("{space}  + {said}"))));
}
