//! Why there is no plan.
//!
//! Nothing is said that is not known. That an atom is not reached even if nothing is ever deleted means that it never holds;
//! that it is reached so means nothing. An action that is never used has no schema, and one with alternatives has several, so
//! "no action can add it" is true where "no action adds it" may not be, and what the nearest schema needs is said of one case.

use std::collections::BTreeSet;
use std::fmt::{self, Display};

use serde::{Deserialize, Serialize};
use typelift_model::{
    ActionModel, ActionSchema, Axiom, Effect, GroundAtom, HashMap, LiftedAtom, Parameter, Symbol, Task, Term, TypeId,
};

use crate::Restrictions;
use crate::conflict::Conflict;
use crate::obstacle::{Nearest, Obstacle};
use crate::reach::Reachable;

/// Why a goal atom cannot be reached.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Unreached {
    /// No action can add it.
    NoAction,
    /// No action can add it: this one, which adds atoms of its predicate, can never be used.
    NeverUsed(Symbol),
    /// This action comes nearest to adding it.
    Nearest(Nearest),
    /// It is derived, and follows from nothing that can be reached. For each rule, something that the rule needs and that
    /// cannot be reached; nothing at all if there is a rule of which everything can be reached, but not together.
    Derived(Vec<String>),
    /// It is what the text puts as a part of the goal, and contradicts itself or what never changes.
    Impossible,
}

/// A goal atom that cannot be reached even if nothing is ever deleted.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnreachableGoal<A = GroundAtom> {
    /// The atom.
    pub atom: A,
    /// Why not.
    pub why: Unreached,
}

/// An atom that must not hold in the end, but does from the start, and that nothing deletes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UndeletedGoal<A = GroundAtom> {
    /// The atom.
    pub atom: A,
    /// The action that comes nearest to deleting it; none if no action deletes such atoms.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nearest: Option<Nearest>,
}

/// Why there is no plan. The planner says it of the model's atoms; [`in_words`](Explanation::in_words) of what these stand
/// for in the text that the model was made from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Explanation<A = GroundAtom> {
    /// Some goal atoms cannot be reached at all.
    Unreachable(Vec<UnreachableGoal<A>>),
    /// No state that can be reached holds both of two goal atoms.
    Exclusive {
        /// The one.
        one: A,
        /// The other.
        other: A,
    },
    /// Another planner says so, and no more.
    ToldByPlanner,
    /// These atoms must not hold in the end, but do from the start, and no action can delete them.
    NeverDeleted(Vec<UndeletedGoal<A>>),
    /// No state that can be reached satisfies the whole goal; where the search came closest, these were missing.
    NotTogether {
        /// The missing goal atoms, and whether each must hold. None where the search did not look at any state.
        missing: Vec<(A, bool)>,
        /// Two of the goal atoms that undo each other, if that is known.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        conflict: Option<Conflict<A>>,
    },
}

impl Explanation {
    /// The same in the words of the text that this model was made from.
    pub fn in_words(&self, model: &ActionModel) -> Explanation<String> {
        let words = |atom: &GroundAtom| model.in_words(atom, true);
        match self {
            Self::Unreachable(goals) => {
                let goal = |goal: &UnreachableGoal| UnreachableGoal { atom: words(&goal.atom), why: goal.why.clone() };
                Explanation::Unreachable(goals.iter().map(goal).collect())
            }
            Self::Exclusive { one, other } => Explanation::Exclusive { one: words(one), other: words(other) },
            Self::ToldByPlanner => Explanation::ToldByPlanner,
            Self::NeverDeleted(goals) => {
                let goal =
                    |goal: &UndeletedGoal| UndeletedGoal { atom: words(&goal.atom), nearest: goal.nearest.clone() };
                Explanation::NeverDeleted(goals.iter().map(goal).collect())
            }
            Self::NotTogether { missing, conflict } => {
                // A formula is negated in its own words.
                let literal = |(atom, positive): &(GroundAtom, bool)| match model.wordings.get(&atom.predicate) {
                    Some(_) => (model.in_words(atom, *positive), true),
                    None => (words(atom), *positive),
                };
                let conflict = conflict.as_ref().map(|conflict| conflict.map(words));
                Explanation::NotTogether { missing: missing.iter().map(literal).collect(), conflict }
            }
        }
    }
}

impl<A: Display + PartialEq> Display for Explanation<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreachable(goals) => {
                let lines: Vec<String> = goals.iter().map(ToString::to_string).collect();
                f.write_str(&lines.join("\n"))
            }
            Self::Exclusive { one, other } => {
                write!(f, "{one} and {other} cannot hold together: no state that can be reached holds both")
            }
            Self::ToldByPlanner => f.write_str("the planner says that there is none"),
            Self::NeverDeleted(goals) => {
                let lines: Vec<String> = goals.iter().map(ToString::to_string).collect();
                f.write_str(&lines.join("\n"))
            }
            Self::NotTogether { missing, conflict } => {
                f.write_str("no state that can be reached satisfies the goal")?;
                let missing: Vec<String> = missing
                    .iter()
                    .map(|(atom, positive)| format!("{}{atom}", if *positive { "" } else { "not " }))
                    .collect();
                if !missing.is_empty() {
                    write!(f, "; at best this is missing: {}", missing.join(", "))?;
                }
                conflict.iter().try_for_each(|conflict| write!(f, "\n{conflict}"))
            }
        }
    }
}

impl<A: Display> Display for UnreachableGoal<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let atom = &self.atom;
        match &self.why {
            Unreached::Impossible => write!(f, "{atom} can never hold"),
            why => write!(f, "{atom} cannot be reached: {why}"),
        }
    }
}

impl Display for Unreached {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAction => f.write_str("no action can add it"),
            Self::NeverUsed(action) => {
                write!(f, "no action can add it: {action}, which adds such atoms, can never be used")
            }
            Self::Nearest(nearest) => nearest.say(f, "add"),
            Self::Derived(needed) if needed.is_empty() => f.write_str("it follows from nothing that can be reached"),
            Self::Derived(needed) => {
                write!(f, "it follows only from what cannot be reached: {}", needed.join(", "))
            }
            Self::Impossible => f.write_str("it can never hold"),
        }
    }
}

impl<A: Display> Display for UndeletedGoal<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} must not hold in the end, ", self.atom)?;
        match &self.nearest {
            None => f.write_str("but no action can delete it"),
            Some(nearest) => {
                f.write_str("and cannot be deleted: ")?;
                nearest.say(f, "delete")
            }
        }
    }
}

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
        let ways: Vec<Nearest> =
            effects.map(|(schema, effect, binding)| self.obstructed(schema, effect, &binding)).collect();
        // Of several that are as near, one that was shown, which whoever reads this can look up.
        let nearest = ways.iter().min_by_key(|way| (way.obstacles.len(), way.imagined))?;
        let of_same = ways.iter().filter(|way| way.action == nearest.action).count();
        Some(Nearest { one_of_several: of_same > 1, ..nearest.clone() })
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
    fn obstructed(&self, schema: &ActionSchema, effect: &Effect, binding: &[Option<&Symbol>]) -> Nearest {
        let mut obstacles = self.unfit(schema, effect, binding);
        let parameters = [&schema.parameters[..], &effect.parameters].concat();
        let missing = |need: &&LiftedAtom| !self.reachable_somehow(&parameters, need, binding);
        let written = |need: &LiftedAtom| self.written(&parameters, need, binding);
        if obstacles.is_empty() {
            let precondition = schema.positive_preconditions().find(missing);
            obstacles.extend(precondition.map(|need| Obstacle::Precondition(written(need))));
        }
        if obstacles.is_empty() {
            let condition = effect.condition.iter().filter(|l| l.positive && !l.atom.is_equality());
            obstacles.extend(condition.map(|l| &l.atom).find(missing).map(|need| Obstacle::Condition(written(need))));
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
        Nearest { action: schema.signature().name, one_of_several: false, imagined, obstacles }
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
