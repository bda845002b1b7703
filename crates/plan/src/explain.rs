//! Why there is no plan.
//!
//! Nothing is said that is not known. That an atom is not reached even if nothing is ever deleted means that it never holds;
//! that it is reached so means nothing. An action that is never used has no schema, and one with alternatives has several, so
//! "no action can add it" is true where "no action adds it" may not be, and what the nearest schema needs is said of one case.

use std::collections::BTreeSet;

use typelift_model::{
    ActionModel, ActionSchema, Axiom, Effect, GroundAtom, HashMap, LiftedAtom, Parameter, Symbol, Task, Term, TypeId,
};

use crate::Restrictions;
use crate::explanation::{UndeletedGoal, UnreachableGoal, Unreached};
use crate::obstacle::{Nearest, Need, Obstacle, Root};
use crate::reach::Reachable;

/// For each unreachable goal atom, why it is not reached.
pub(crate) fn unreachable(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    reachable: &Reachable,
) -> Vec<UnreachableGoal> {
    let context = Context { model, task, restrictions, reached: reachable.atoms_by_predicate() };
    let goals = reachable.unreached_goals().iter();
    goals.map(|atom| UnreachableGoal { atom: atom.clone(), why: context.why(atom) }).collect()
}

/// For each of these atoms, which nothing that can be reached deletes, what comes nearest to it.
pub(crate) fn undeleted(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    reachable: &Reachable,
    atoms: &[GroundAtom],
) -> Vec<UndeletedGoal> {
    let context = Context { model, task, restrictions, reached: reachable.atoms_by_predicate() };
    let goal = |atom: &GroundAtom| {
        // What stands for a formula is deleted by no action as it is written.
        let nearest = context.nearest(model.deleting(atom)).filter(|_| !model.wordings.contains_key(&atom.predicate));
        UndeletedGoal { atom: atom.clone(), nearest }
    };
    atoms.iter().map(goal).collect()
}

struct Context<'a> {
    model: &'a ActionModel,
    task: &'a Task,
    restrictions: &'a Restrictions,
    /// The reachable atoms of each predicate.
    reached: HashMap<Symbol, Vec<GroundAtom>>,
}

impl Context<'_> {
    /// Why an atom is not reached.
    fn why(&self, atom: &GroundAtom) -> Unreached {
        let rules = || self.model.axioms.iter().filter(|axiom| axiom.head.predicate == atom.predicate);
        if rules().next().is_some() {
            return Unreached::Derived(self.needed(atom, rules()));
        }
        if self.model.wordings.contains_key(&atom.predicate) {
            return Unreached::Impossible;
        }
        match self.nearest(self.model.adding(atom)) {
            Some(nearest) => Unreached::Nearest(nearest),
            None => {
                let mut never_used = self.model.never_used.iter();
                let of_predicate = never_used.find(|(_, added)| added.contains(&atom.predicate));
                of_predicate.map_or(Unreached::NoAction, |(action, _)| Unreached::NeverUsed(action.clone()))
            }
        }
    }

    /// The nearest of the actions that may change an atom so, each with its effect and what that binds.
    fn nearest<'e>(
        &self,
        effects: impl Iterator<Item = (&'e ActionSchema, &'e Effect, Vec<Option<&'e Symbol>>)>,
    ) -> Option<Nearest> {
        let (nearest, need) = self.nearest_way(effects)?;
        Some(Nearest { root: need.and_then(|need| self.root(need)), ..nearest })
    }

    /// The same, with what it needs and cannot be reached, if that is what keeps it from it.
    fn nearest_way<'e>(
        &self,
        effects: impl Iterator<Item = (&'e ActionSchema, &'e Effect, Vec<Option<&'e Symbol>>)>,
    ) -> Option<(Nearest, Option<Need>)> {
        let ways: Vec<(Nearest, Option<Need>)> =
            effects.map(|(schema, effect, binding)| self.obstructed(schema, effect, &binding)).collect();
        // Of several that are as near, one that was shown, which whoever reads this can look up.
        let (nearest, need) = ways.iter().min_by_key(|(way, _)| (way.obstacles.len(), way.imagined))?;
        let of_same = ways.iter().filter(|(way, _)| way.action == nearest.action).count();
        Some((Nearest { one_of_several: of_same > 1, ..nearest.clone() }, need.clone()))
    }

    /// For want of what this cannot be reached, in the end: down from what the nearest action needs to what the nearest
    /// action to that needs, as long as that is something new. Each is known not to be reached.
    fn root(&self, need: Need) -> Option<Root> {
        let mut root = None;
        let mut needs = vec![need];
        while let Some((way, Some(next))) = needs.last().and_then(|last| self.nearest_way(self.adding_some(last))) {
            // What another case of the action does without is not needed.
            if way.one_of_several {
                break;
            }
            // What needs a thing of its kind to begin with is missing for want of the kind, and anything else in a circle for
            // want of what stands in it.
            let is_of_kind = needs.len() == 1 && next != needs[0];
            let is_known = needs.iter().any(|known| next.covers(known) || known.covers(&next));
            if !is_known || is_of_kind {
                root = Some(Root { action: way.action, needs: next.text.clone() });
            }
            if is_known {
                break;
            }
            needs.push(next);
        }
        root
    }

    /// The effects that may add some atom like this, each with the objects that this puts in the place of its parameters.
    fn adding_some<'e>(
        &'e self,
        need: &'e Need,
    ) -> impl Iterator<Item = (&'e ActionSchema, &'e Effect, Vec<Option<&'e Symbol>>)> {
        let is_given = |predicate: &Symbol| {
            self.model.wordings.contains_key(predicate)
                || self.model.axioms.iter().any(|axiom| axiom.head.predicate == *predicate)
        };
        let schemas = self.model.actions.iter().filter(move |_| !is_given(&need.predicate));
        let effects = schemas.flat_map(|schema| schema.effects.iter().map(move |effect| (schema, effect)));
        effects.filter_map(|(schema, effect)| {
            let atom = &effect.literal.atom;
            if !effect.literal.positive || atom.predicate != need.predicate || atom.args.len() != need.args.len() {
                return None;
            }
            let mut binding = vec![None; schema.parameters.len() + effect.parameters.len()];
            for (term, object) in atom.args.iter().zip(&need.args) {
                let Some(object) = object else { continue };
                match term {
                    Term::Const(name) if name != object => return None,
                    Term::Const(_) => {}
                    Term::Param(p) => match binding[*p as usize].replace(object) {
                        Some(other) if other != object => return None,
                        _ => {}
                    },
                }
            }
            Some((schema, effect, binding))
        })
    }

    /// For each rule by which an atom could follow, something that it needs and that cannot be reached; nothing if one of
    /// them has no such thing.
    fn needed<'r>(&self, atom: &GroundAtom, rules: impl Iterator<Item = &'r Axiom>) -> Vec<String> {
        let mut needed = Vec::new();
        for axiom in rules {
            let mut binding = vec![None; axiom.parameters.len()];
            if axiom.head.bind(atom, &mut binding, |_, _, _| true).is_none() {
                continue;
            }
            let body = axiom.body.iter().filter(|literal| literal.positive && !literal.atom.is_equality());
            let missing = body.map(|l| &l.atom).find(|need| !self.reachable_somehow(&axiom.parameters, need, &binding));
            let Some(missing) = missing else { return Vec::new() };
            let text = self.written(&axiom.parameters, missing, &binding);
            if !needed.contains(&text) {
                needed.push(text);
            }
        }
        needed
    }

    /// What keeps an effect of `schema` from changing an atom that puts these objects in the place of its parameters.
    fn obstructed(
        &self,
        schema: &ActionSchema,
        effect: &Effect,
        binding: &[Option<&Symbol>],
    ) -> (Nearest, Option<Need>) {
        let mut obstacles = self.unfit(schema, effect, binding);
        let parameters = [&schema.parameters[..], &effect.parameters].concat();
        let missing = |need: &&LiftedAtom| !self.reachable_somehow(&parameters, need, binding);
        let needed = |need: &LiftedAtom| self.need(&parameters, need, binding);
        let mut need = None;
        if obstacles.is_empty() {
            let precondition = schema.positive_preconditions().find(missing);
            need = precondition.map(needed);
            obstacles.extend(need.iter().map(|need| Obstacle::Precondition(need.text.clone())));
        }
        if obstacles.is_empty() {
            let condition = effect.condition.iter().filter(|l| l.positive && !l.atom.is_equality());
            need = condition.map(|l| &l.atom).find(missing).map(needed);
            obstacles.extend(need.iter().map(|need| Obstacle::Condition(need.text.clone())));
        }
        let is_banned = || {
            let mut calls = self.restrictions.banned.iter().map(|ban| &ban.call).chain(&self.restrictions.calls);
            calls.any(|call| call.name == schema.call.name)
        };
        let may_not_meet = || self.restrictions.types.iter().any(|exclusion| exclusion.concerns(schema));
        if obstacles.is_empty() && (is_banned() || may_not_meet()) {
            obstacles.push(Obstacle::Banned);
        }
        let imagined = schema.provenance.imagined().is_some();
        (Nearest { action: schema.signature().name, one_of_several: false, imagined, obstacles, root: None }, need)
    }

    /// The objects that do not fit the parameters of an action and of its effect.
    fn unfit(&self, schema: &ActionSchema, effect: &Effect, binding: &[Option<&Symbol>]) -> Vec<Obstacle> {
        let hierarchy = &self.model.hierarchy;
        let mut obstacles = Vec::new();
        for (index, (parameter, object)) in schema.parameters.iter().chain(&effect.parameters).zip(binding).enumerate()
        {
            // Restrictions are about what an action is told.
            let allowed = |name: &Symbol, ty: TypeId| {
                index >= schema.parameters.len()
                    || self.restrictions.allows(name, &schema.call.name) && self.allows_type(schema, index, ty)
            };
            let Some(object) = object else {
                let usable = |(name, ty): (&Symbol, &TypeId)| hierarchy.is_a(*ty, parameter.ty) && allowed(name, *ty);
                if !self.task.init.objects.iter().any(usable) {
                    obstacles.push(Obstacle::NoObject { ty: hierarchy.name(parameter.ty).clone() });
                }
                continue;
            };
            let Some(&ty) = self.task.init.objects.get(*object) else {
                obstacles.push(Obstacle::Missing { object: (*object).clone() });
                continue;
            };
            if !hierarchy.is_a(ty, parameter.ty) {
                let (found, expected) = (hierarchy.name(ty).clone(), hierarchy.name(parameter.ty).clone());
                obstacles.push(Obstacle::Type { object: (*object).clone(), found, expected });
            } else if !allowed(object, ty) {
                obstacles.push(Obstacle::Excluded { object: (*object).clone() });
            }
        }
        obstacles
    }

    /// Whether an object of this type may be this parameter, whatever the others are.
    fn allows_type(&self, schema: &ActionSchema, index: usize, ty: TypeId) -> bool {
        let mut types = vec![None; schema.parameters.len()];
        types[index] = Some(ty);
        self.restrictions.allows_types(schema, &types, &self.model.hierarchy)
    }

    /// Whether some instance of an atom over these parameters is reachable under a partial binding.
    fn reachable_somehow(&self, parameters: &[Parameter], atom: &LiftedAtom, binding: &[Option<&Symbol>]) -> bool {
        let is_of_type = |p: usize, object: &Symbol, _: &_| {
            self.model.hierarchy.is_a(self.task.init.objects[object], parameters[p].ty)
        };
        let mut binding = binding.to_vec();
        let reached = self.reached.get(&atom.predicate).into_iter().flatten();
        reached.into_iter().any(|fact| atom.bind(fact, &mut binding, is_of_type).is_some())
    }

    /// A lifted atom under a partial binding, that is needed.
    fn need(&self, parameters: &[Parameter], atom: &LiftedAtom, binding: &[Option<&Symbol>]) -> Need {
        let arg = |term: &Term| match term {
            Term::Const(name) => Some(name.clone()),
            Term::Param(p) => binding[*p as usize].cloned(),
        };
        let args = atom.args.iter().map(arg).collect();
        Need { predicate: atom.predicate.clone(), args, text: self.written(parameters, atom, binding) }
    }

    /// A lifted atom in the text's words, with bound parameters written as objects and others as `any TYPE`, or
    /// `the same TYPE` where they come again.
    fn written(&self, parameters: &[Parameter], atom: &LiftedAtom, binding: &[Option<&Symbol>]) -> String {
        let mut mentioned = BTreeSet::new();
        let atom = atom.map(|term| match term {
            Term::Const(name) => name.to_string(),
            Term::Param(p) => match binding[*p as usize] {
                Some(object) => object.to_string(),
                None => {
                    let which = if mentioned.insert(*p) { "any" } else { "the same" };
                    format!("{which} {}", self.model.hierarchy.name(parameters[*p as usize].ty))
                }
            },
        });
        self.model.in_words(&atom, true)
    }
}
