//! Negation compiled away (Gazen and Knoblock 1997): for each predicate that may not hold somewhere, another one that
//! holds exactly where it does not. Every effect on the one has the opposite effect on the other, and the initial
//! state lists the other's cases, as far as the types of the negative uses let them matter. Inequality is the same
//! thing for equality, which nothing changes.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{
    ActionModel, ActionSchema, Atom, EQUALS, Effect, Goal, GroundAtom, Hierarchy, LiftedAtom, Literal, Parameter,
    Symbol, Task, Term, TypeId,
};

use super::argument_types::constants;
use super::names::{folded, predicates, unused};
use super::{ExportError, MOST_FACTS};

/// What may stand at an argument.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Place {
    /// An object of this type.
    Of(TypeId),
    /// This object.
    Object(Symbol),
    /// The same as at this earlier argument.
    Same(usize),
}

/// A predicate that stands for literals of another one.
struct Complement {
    name: Symbol,
    uses: BTreeSet<Vec<Place>>,
}

/// The predicates that stand for literals: for the negation of a predicate, and for equality.
pub(super) struct Complements {
    /// By the literals' predicate, and whether they are positive.
    of: BTreeMap<(Symbol, bool), Complement>,
    constants: BTreeMap<Symbol, TypeId>,
}

impl Complements {
    /// What the preconditions and the goal need.
    pub(super) fn of(model: &ActionModel, task: Option<&Task>) -> Self {
        let mut used: BTreeSet<Symbol> = predicates(model, task).into_keys().map(folded).collect();
        let mut of: BTreeMap<(Symbol, bool), Complement> = BTreeMap::new();
        let mut need = |predicate: &Symbol, positive: bool, places: Vec<Place>| {
            let complement = of.entry((predicate.clone(), positive)).or_insert_with(|| {
                let base = match (predicate.as_str(), positive) {
                    (EQUALS, true) => "same".to_owned(),
                    (EQUALS, false) => "differ".to_owned(),
                    (name, _) => format!("not-{name}"),
                };
                Complement { name: unused(&base, &mut used), uses: BTreeSet::new() }
            });
            complement.uses.insert(places);
        };
        for action in &model.actions {
            for literal in action.preconditions.iter().filter(|literal| is_replaced(literal)) {
                need(&literal.atom.predicate, literal.positive, places(&literal.atom, &action.parameters));
            }
        }
        for (atom, positive) in task.iter().flat_map(|task| task.goal.literals()) {
            if !positive || atom.is_equality() {
                need(&atom.predicate, positive, atom.args.iter().cloned().map(Place::Object).collect());
            }
        }
        Self { of, constants: constants(model, task) }
    }

    /// What stands for what.
    pub(super) fn notes(&self) -> impl Iterator<Item = String> + '_ {
        self.of.iter().map(|((predicate, positive), complement)| match (predicate.as_str(), positive) {
            (EQUALS, true) => format!("{} holds of things that are the same", complement.name),
            (EQUALS, false) => format!("{} holds of things that are not the same", complement.name),
            (name, _) => format!("{} holds where {name} does not", complement.name),
        })
    }

    /// Declares them, and replaces what they stand for. Of the preconditions only those are written that are in
    /// `lean`; all of them tell what the effects come to.
    pub(super) fn in_model(&self, model: &mut ActionModel, lean: &ActionModel) -> Result<(), ExportError> {
        for ((predicate, _), complement) in &self.of {
            let of_use = |places: &Vec<Place>| places.iter().map(|place| self.ty(place, places, model)).collect();
            let types = model.predicates.get(predicate).cloned();
            let types = types.or_else(|| complement.uses.first().map(of_use)).unwrap_or_default();
            model.predicates.insert(complement.name.clone(), types);
        }
        let hierarchy = &model.hierarchy;
        for (action, lean) in model.actions.iter_mut().zip(&lean.actions) {
            let opposites = self.opposite_effects(action, hierarchy)?;
            action.effects.extend(opposites);
            action.preconditions.clone_from(&lean.preconditions);
            for literal in action.preconditions.iter_mut().filter(|literal| is_replaced(literal)) {
                if let Some(complement) = self.of.get(&(literal.atom.predicate.clone(), literal.positive)) {
                    *literal = Literal::positive(Atom::new(complement.name.clone(), literal.atom.args.clone()));
                }
            }
        }
        Ok(())
    }

    fn ty(&self, place: &Place, places: &[Place], model: &ActionModel) -> TypeId {
        match place {
            Place::Of(ty) => *ty,
            Place::Object(name) => self.constants.get(name).copied().unwrap_or(model.hierarchy.root()),
            Place::Same(earlier) => self.ty(&places[*earlier], places, model),
        }
    }

    /// The effects on complements that go with an action's effects.
    fn opposite_effects(&self, action: &ActionSchema, hierarchy: &Hierarchy) -> Result<Vec<Effect>, ExportError> {
        let mut opposites = Vec::new();
        for Effect { literal, .. } in &action.effects {
            let Some(complement) = self.of.get(&(literal.atom.predicate.clone(), false)) else { continue };
            let places = places(&literal.atom, &action.parameters);
            if !complement.uses.iter().any(|used| self.may_overlap(used, &places, hierarchy)) {
                continue;
            }
            if !literal.positive {
                // What is added as well is not deleted.
                if action.adds().any(|added| *added == literal.atom) {
                    continue;
                }
                let same = |added: &&LiftedAtom| may_be_same(action, added, &literal.atom, hierarchy);
                if action.adds().any(|added| same(&added)) {
                    let feature = "may add what it deletes, where another action needs it not to hold";
                    return Err(ExportError::Unsupported { subject: action.name.clone(), feature });
                }
            }
            let atom = Atom::new(complement.name.clone(), literal.atom.args.clone());
            opposites.push(Effect::always(Literal { atom, positive: !literal.positive }));
        }
        Ok(opposites)
    }

    /// Whether some objects fit both.
    fn may_overlap(&self, used: &[Place], places: &[Place], hierarchy: &Hierarchy) -> bool {
        let ty = |place: &Place| match place {
            Place::Of(ty) => Some(*ty),
            Place::Object(name) => self.constants.get(name).copied(),
            Place::Same(_) => None,
        };
        used.len() == places.len()
            && used.iter().zip(places).all(|(a, b)| match (a, b) {
                (Place::Object(a), Place::Object(b)) => a == b,
                // An object of the task alone is of no type known here.
                _ => ty(a).zip(ty(b)).is_none_or(|(a, b)| !hierarchy.disjoint(a, b)),
            })
    }

    /// The task with the cases in which each complement holds.
    pub(super) fn in_task(&self, model: &ActionModel, task: &Task) -> Result<Task, ExportError> {
        let mut objects = self.constants.clone();
        objects.extend(task.init.objects.clone());
        let mut compiled = task.clone();
        let mut room = MOST_FACTS;
        for ((predicate, positive), complement) in &self.of {
            for places in &complement.uses {
                let choices = choices(places, &objects, &model.hierarchy);
                let size = |fitting: &Vec<&Symbol>| fitting.len() as u64;
                let facts = choices.iter().map(size).fold(1_u64, u64::saturating_mul);
                room = room
                    .checked_sub(facts)
                    .ok_or_else(|| ExportError::TooManyFacts { predicate: predicate.clone(), facts })?;
                for_each_tuple(places, &choices, &mut Vec::new(), &mut |args| {
                    let mut atom = GroundAtom::new(predicate.clone(), args.to_vec());
                    if task.init.holds(&atom) == *positive {
                        atom.predicate = complement.name.clone();
                        compiled.init.atoms.insert(atom);
                    }
                });
            }
        }
        compiled.goal = Goal::default();
        for (atom, positive) in task.goal.literals() {
            let complement = self.of.get(&(atom.predicate.clone(), positive));
            let predicate = complement.map_or(&atom.predicate, |complement| &complement.name);
            compiled.goal.required.push(Atom::new(predicate.clone(), atom.args.clone()));
        }
        Ok(compiled)
    }
}

/// Whether another predicate stands for this literal.
fn is_replaced(literal: &Literal) -> bool {
    !literal.positive || literal.atom.is_equality()
}

fn places(atom: &LiftedAtom, parameters: &[Parameter]) -> Vec<Place> {
    let place = |(position, term): (usize, &Term)| match term {
        Term::Const(name) => Place::Object(name.clone()),
        Term::Param(index) => match atom.args[..position].iter().position(|earlier| earlier == term) {
            Some(earlier) => Place::Same(earlier),
            None => Place::Of(parameters[*index as usize].ty),
        },
    };
    atom.args.iter().enumerate().map(place).collect()
}

/// The objects that fit each place; none are listed for one that repeats another.
pub(super) fn choices<'o>(
    places: &[Place],
    objects: &'o BTreeMap<Symbol, TypeId>,
    hierarchy: &Hierarchy,
) -> Vec<Vec<&'o Symbol>> {
    let fitting = |place: &Place| match place {
        Place::Of(ty) => objects.iter().filter(|(_, of)| hierarchy.is_a(**of, *ty)).map(|(name, _)| name).collect(),
        Place::Object(name) => objects.get_key_value(name).into_iter().map(|(name, _)| name).collect(),
        // A placeholder: the earlier argument decides.
        Place::Same(_) => objects.keys().take(1).collect(),
    };
    places.iter().map(fitting).collect()
}

/// Calls `each` with every choice of these.
pub(super) fn for_each_tuple(
    places: &[Place],
    choices: &[Vec<&Symbol>],
    chosen: &mut Vec<Symbol>,
    each: &mut impl FnMut(&[Symbol]),
) {
    let Some(fitting) = choices.get(chosen.len()) else { return each(chosen) };
    for object in fitting {
        let object = match places[chosen.len()] {
            Place::Same(earlier) => chosen[earlier].clone(),
            _ => (*object).clone(),
        };
        chosen.push(object);
        for_each_tuple(places, choices, chosen, each);
        chosen.pop();
    }
}

/// Whether an applicable instance of the action may add and delete the same atom.
fn may_be_same(action: &ActionSchema, added: &LiftedAtom, deleted: &LiftedAtom, hierarchy: &Hierarchy) -> bool {
    let differ = |a: &Term, b: &Term| {
        action.preconditions.iter().any(|literal| {
            !literal.positive
                && literal.atom.is_equality()
                && matches!(&literal.atom.args[..], [c, d] if (a, b) == (c, d) || (b, a) == (c, d))
        })
    };
    let may = |(a, b): (&Term, &Term)| match (a, b) {
        (Term::Param(i), Term::Param(j)) => {
            let [i_type, j_type] = [i, j].map(|index| action.parameters[*index as usize].ty);
            i == j || !hierarchy.disjoint(i_type, j_type) && !differ(a, b)
        }
        (Term::Const(a), Term::Const(b)) => a == b,
        _ => !differ(a, b),
    };
    // What must hold before cannot be the same as what must not.
    let needs = |atom: &LiftedAtom, positive: bool| {
        action.preconditions.iter().any(|literal| literal.positive == positive && literal.atom == *atom)
    };
    let excluded = needs(deleted, true) && needs(added, false) || needs(deleted, false) && needs(added, true);
    added.predicate == deleted.predicate
        && added.args.len() == deleted.args.len()
        && added.args.iter().zip(&deleted.args).all(may)
        && !excluded
}
