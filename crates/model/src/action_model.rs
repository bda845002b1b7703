//! What plans are made with: types, predicates, actions and axioms.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;

use crate::{
    ActionSchema, ArgumentTypes, Atom, Axiom, Hierarchy, LiftedAtom, NameCollision, Parameter, PddlNames, Replacement,
    Symbol, Term, TypeId, Wording, cover,
};

/// A symbolic action model (paper: 𝒜 with 𝓗): everything that planning needs, and nothing of what it was learned from,
/// which a [`LearnedModel`](crate::LearnedModel) has.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ActionModel {
    /// The type hierarchy.
    pub hierarchy: Hierarchy,
    /// Every predicate with the types of its arguments: as declared, or the lowest that cover all that it was seen of. An
    /// imagined action or a task may go beyond.
    pub predicates: ArgumentTypes,
    /// The type of the actor, if there is one: it is not blamed when a step fails.
    pub actor: Option<TypeId>,
    /// The objects that every task has, with their types: those that actions and axioms mention by name, and the constants
    /// of the domain that declares the types.
    pub constants: BTreeMap<Symbol, TypeId>,
    /// The actions, with unique names, sorted by name.
    pub actions: Vec<ActionSchema>,
    /// How derived predicates follow; learned models have none.
    pub axioms: Vec<Axiom>,
    /// How the text that the model was made from puts what predicates stand for that it does not have. Learned models
    /// have none, and a model's file holds none.
    pub wordings: BTreeMap<Symbol, Wording>,
    /// The actions of that text that can never be used, whatever the state, which are none of the model's; each with the
    /// predicates that it would add. Learned models have none, and a model's file holds none.
    pub never_used: BTreeMap<Symbol, BTreeSet<Symbol>>,
}

/// The PDDL names of everything that a model names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModelPddlNames {
    /// Of its types.
    pub types: PddlNames,
    /// Of its predicates.
    pub predicates: PddlNames,
    /// Of its actions.
    pub actions: PddlNames,
    /// Of the calls of the actions that plan files name by them.
    pub calls: PddlNames,
}

impl ModelPddlNames {
    /// How plan files name this action of the model: by what its [signature](ActionSchema::signature) is called.
    pub fn in_plans<'a>(&'a self, action: &'a ActionSchema) -> &'a Symbol {
        let (names, name) = match action.named_by_call {
            true => (&self.calls, &action.call.name),
            false => (&self.actions, &action.name),
        };
        names.pddl(name.as_str()).unwrap_or(name)
    }
}

impl ActionModel {
    /// The action of this name.
    pub fn action(&self, name: &str) -> Option<&ActionSchema> {
        self.actions.iter().find(|action| action.name == *name)
    }

    /// An atom, or its negation, in the words of the text that the model was made from.
    pub fn in_words<T: Display>(&self, atom: &Atom<T>, positive: bool) -> String {
        if let Some(wording) = self.wordings.get(&atom.predicate) {
            return wording.say(&atom.args, positive);
        }
        let text = atom.map(ToString::to_string).to_string();
        if positive { text } else { format!("not {text}") }
    }

    /// Whether an object of this type is an actor.
    pub fn is_actor(&self, ty: TypeId) -> bool {
        self.actor.is_some_and(|actor| self.hierarchy.is_a(ty, actor))
    }

    /// Calls `each` with every lifted atom of the actions and axioms, the placeholders that it is over, and whether it is
    /// a function.
    pub fn for_each_atom(&self, each: &mut impl FnMut(&LiftedAtom, &[Parameter], bool)) {
        for action in &self.actions {
            for literal in &action.preconditions {
                each(&literal.atom, &action.parameters, false);
            }
            for effect in &action.effects {
                let parameters = [&action.parameters[..], &effect.parameters].concat();
                for literal in effect.condition.iter().chain([&effect.literal]) {
                    each(&literal.atom, &parameters, false);
                }
            }
            for function in &action.cost.functions {
                each(function, &action.parameters, true);
            }
        }
        for axiom in &self.axioms {
            for atom in axiom.body.iter().map(|literal| &literal.atom).chain([&axiom.head]) {
                each(atom, &axiom.parameters, false);
            }
        }
    }

    /// The lowest types that cover how actions and axioms use the predicates; a constant without a type is of the root's.
    pub fn argument_uses(&self) -> ArgumentTypes {
        let mut uses = ArgumentTypes::new();
        self.for_each_atom(&mut |atom, parameters, is_function| {
            let ty = |term: &Term| match term {
                Term::Param(index) => parameters[*index as usize].ty,
                Term::Const(name) => self.constants.get(name).copied().unwrap_or(self.hierarchy.root()),
            };
            if !is_function && !atom.is_equality() {
                cover(&mut uses, &self.hierarchy, &atom.predicate, atom.args.iter().map(ty));
            }
        });
        uses
    }

    /// The reversible mapping of its names to PDDL's.
    ///
    /// # Errors
    /// [`NameCollision`] if two names differ only in what PDDL does not tell apart.
    pub fn pddl_names(&self) -> Result<ModelPddlNames, NameCollision> {
        let by_call = self.actions.iter().filter(|action| action.named_by_call);
        Ok(ModelPddlNames {
            types: PddlNames::fold("type", self.hierarchy.types().map(|t| self.hierarchy.name(t)))?,
            predicates: PddlNames::fold("predicate", self.predicates.keys())?,
            actions: PddlNames::fold("action", self.actions.iter().map(|a| &a.name))?,
            calls: PddlNames::fold("action", by_call.map(|a| &a.call.name))?,
        })
    }
}

/// The readable name of an action: its call's name and its parameters' types, without the actor's.
/// Names that come out equal are told apart by [`UniqueNames`].
pub fn schema_name<'a>(call: &Symbol, types: impl IntoIterator<Item = (&'a Symbol, bool)>) -> String {
    let mut name = call.as_str().to_owned();
    for (ty, is_actor) in types {
        if !is_actor {
            name.push('-');
            name.push_str(ty.as_str());
        }
    }
    name
}

/// Gives actions readable names, each once.
#[derive(Debug, Clone, Default)]
pub struct UniqueNames(BTreeSet<Symbol>);

impl UniqueNames {
    /// With names that are in use already.
    pub fn new(used: impl IntoIterator<Item = Symbol>) -> Self {
        Self(used.into_iter().collect())
    }

    /// The [readable name](schema_name) of an action of this model, numbered if it is in use.
    pub fn of_action(&mut self, action: &ActionSchema, model: &ActionModel) -> Symbol {
        let types = action.parameters.iter().map(|p| (model.hierarchy.name(p.ty), model.is_actor(p.ty)));
        let base = schema_name(&action.call.name, types);
        let mut name = Symbol::new(&base);
        for number in 2.. {
            if !self.0.contains(&name) {
                break;
            }
            name = Symbol::from(format!("{base}-{number}"));
        }
        self.0.insert(name.clone());
        name
    }
}

/// `cuttingtool for cutboard, fruit for carrot`: what was put in place of what, each pair once.
pub fn describe_replacements(replaced: &[Replacement], hierarchy: &Hierarchy) -> String {
    let mut pairs: Vec<String> =
        replaced.iter().map(|r| format!("{} for {}", hierarchy.name(r.to), hierarchy.name(r.from))).collect();
    pairs.dedup();
    pairs.join(", ")
}
