//! Algorithm 2: imagining generalized actions for goals that cannot be reached.
//!
//! Each step of the paper's pseudocode is a file:
//!
//! | step                                             | file              |
//! |--------------------------------------------------|-------------------|
//! | `GetUnreachableGoals`, the queue                 | `lib.rs`          |
//! | `GetPotentialActions`                            | `potential.rs`    |
//! | `CreateImaginedAction`                           | `create.rs`       |
//! | when a proposal is given up, and what was          | `guard.rs`, `given_up.rs` |
//! | `GetUnreachablePreconds`                         | `preconditions.rs`|
//! | `CreateSubstitutedAction`                        | `substitute.rs`   |
//!
//! The paper speaks of goals that are to hold. A goal that something is to hold no longer (`not p(a)`) is imagined for in the same
//! way, with what deletes in place of what adds; that goes beyond the paper, and changes nothing where all goals are positive.
//!
//! Where an action and one that was imagined from it can both be used with the same call, the learned one goes before
//! (`give_way.rs`), which the paper leaves open. Where all that leads to no plan either, preconditions that always held may be
//! done without, one or two (`loosen.rs`).
//! That goes beyond the paper.
//!
//! Imagined actions rest on no observation of their own. They only ever widen what may be planned: the model's own
//! actions stay as they are.
#![deny(missing_docs)]

mod create;
mod give_way;
mod given_up;
mod guard;
mod loosen;
mod potential;
mod preconditions;
mod substitute;

use std::collections::{BTreeSet, VecDeque};

use typelift_model::{
    ActionModel, ActionSchema, Axiom, Budget, GroundAtom, HashMap, LiftedAtom, Stop, Symbol, Task, TypeId, UniqueNames,
};
use typelift_plan::{Reachable, Restrictions};

pub use give_way::contradicted;
pub use given_up::{Because, GivenUp};
pub use guard::Guard;
pub use loosen::{Loosening, loosenings, without_all};

/// How actions are imagined.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Options {
    /// Which proposals are given up.
    pub guard: Guard,
    /// Where there is no plan otherwise, do without preconditions that always held and may be accidents.
    pub loosen: bool,
}

/// What was imagined for a task.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Imagination {
    /// The new actions, imagined ones first, each followed later by those that were made to follow it.
    pub actions: Vec<ActionSchema>,
    /// The atoms that could not be reached and were worked through, in order.
    pub unreachable: Vec<GroundAtom>,
    /// The atoms that were to hold no longer, that nothing could delete, and that were worked through, in order.
    pub undeleted: Vec<GroundAtom>,
    /// What the guard gave up, each once, in order.
    pub given_up: Vec<GivenUp>,
    /// The preconditions that some of the new actions do without.
    pub loosened: Vec<Loosening>,
    /// With which calls those actions of the model can be used to which new ones give way.
    pub usable: Vec<Axiom>,
}

impl Imagination {
    /// The model with the imagined actions.
    pub fn added_to(&self, model: &ActionModel) -> ActionModel {
        let mut model = model.clone();
        model.actions.extend(self.actions.iter().cloned());
        model.actions.sort_by(|a, b| a.name.cmp(&b.name));
        let of_anything = |head: &LiftedAtom| vec![model.hierarchy.root(); head.arity()];
        let heads = self.usable.iter().map(|axiom| &axiom.head);
        model.predicates.extend(heads.map(|head| (head.predicate.clone(), of_anything(head))));
        model.axioms.extend(self.usable.iter().cloned());
        model
    }

    /// Adds actions that do without one or two of these preconditions of the model's.
    pub fn loosen(&mut self, model: &ActionModel, loosenings: &[Loosening]) {
        let loosened = loosen::loosened(model, loosenings).into_iter();
        self.actions.extend(loosened.filter(|action| model.action(action.name.as_str()).is_none()));
        self.loosened.extend_from_slice(loosenings);
    }

    /// Has the new actions of these names used only where those that they were imagined from cannot be used with the same call.
    pub fn give_way(&mut self, model: &ActionModel, names: &BTreeSet<Symbol>) {
        self.usable = give_way::give_way(&mut self.actions, model, names);
    }
}

/// An atom that is to hold, or to hold no longer, and which nothing that is known brings about.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Wanted {
    atom: GroundAtom,
    positive: bool,
}

/// What all steps need to know.
struct Context<'a> {
    model: &'a ActionModel,
    task: &'a Task,
    restrictions: &'a Restrictions,
    /// The reachable atoms of each predicate.
    reached: HashMap<Symbol, Vec<GroundAtom>>,
}

impl Context<'_> {
    /// The objects that nothing speaks against, but for those in `bound`, with their types. An object excluded from
    /// one kind of action does not count for another either: what cannot be loaded need not be started, and the
    /// action that would start it has to be imagined for something else. The same goes for a type, where it may not
    /// meet the type of something bound.
    fn available<'a>(&'a self, bound: &BTreeSet<&Symbol>) -> impl Iterator<Item = (&'a Symbol, TypeId)> {
        let types: Vec<TypeId> = bound.iter().filter_map(|name| self.task.init.objects.get(*name)).copied().collect();
        let objects = self.task.init.objects.iter().map(|(name, ty)| (name, *ty));
        objects.filter(move |(name, ty)| {
            !bound.contains(name) && !self.restrictions.distrusts(name, *ty, &types, &self.model.hierarchy)
        })
    }
}

/// Algorithm 2: actions for the goal atoms that cannot be reached, or that are to hold no longer and cannot be deleted; none if
/// there are no such goals.
///
/// Work goes through a queue of unreachable atoms, each once. The cost is that of working out what is reachable, plus, for
/// each atom, a look at every action, and at the instances of its unreachable preconditions.
///
/// # Errors
/// [`Stop`] if the budget ends it.
pub fn imagine(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    budget: &Budget,
) -> Result<Imagination, Stop> {
    let reachable = Reachable::with_few_objects(model, task, restrictions, budget)?;
    imagine_from(&reachable, model, task, restrictions, options, budget)
}

/// The same, where what is reachable is known already: with this model or its [strict](typelift_model::strict) form, with
/// which the same is reachable; and with all of the task's objects, unless fewer reach all goals.
///
/// # Errors
/// [`Stop`] if the budget ends it.
pub fn imagine_from(
    reachable: &Reachable,
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    budget: &Budget,
) -> Result<Imagination, Stop> {
    let to_hold = reachable.unreached_goals().iter().cloned().map(|atom| Wanted { atom, positive: true });
    let to_vanish = reachable.undeleted_goals().iter().cloned().map(|atom| Wanted { atom, positive: false });
    let mut queue: VecDeque<Wanted> = to_hold.chain(to_vanish).collect();
    if queue.is_empty() {
        return Ok(Imagination::default());
    }
    let context = Context { model, task, restrictions, reached: reachable.atoms_by_predicate() };
    let mut met: BTreeSet<Wanted> = queue.iter().cloned().collect();
    let mut imagination = Imagination::default();
    let mut names = UniqueNames::new(model.actions.iter().map(|action| action.name.clone()));
    let mut known: Vec<ActionSchema> = Vec::new();
    while let Some(wanted) = queue.pop_front() {
        if let Some(stop) = budget.stopped() {
            return Err(stop);
        }
        for potential in potential::get_potential_actions(model, &wanted) {
            let Some(proposal) = create::create_imagined_action(&context, &potential) else { continue };
            if let Some(given_up) = guard::gives_up(options.guard, &context, &proposal) {
                if !imagination.given_up.contains(&given_up) {
                    imagination.given_up.push(given_up);
                }
                continue;
            }
            for atom in preconditions::get_unreachable_preconds(&context, &proposal) {
                let wanted = Wanted { atom, positive: true };
                if met.insert(wanted.clone()) {
                    queue.push_back(wanted);
                }
            }
            if proposal.is_new() {
                add_if_new(proposal.into_schema(&wanted), model, &mut known, &mut names);
            }
        }
        let worked_through = if wanted.positive { &mut imagination.unreachable } else { &mut imagination.undeleted };
        worked_through.push(wanted.atom);
    }
    for index in 0..known.len() {
        let action = known[index].clone();
        for substituted in substitute::create_substituted_actions(model, &action) {
            add_if_new(substituted, model, &mut known, &mut names);
        }
    }
    imagination.actions = known;
    Ok(imagination)
}

/// Names and keeps an action, unless one that does the same is there.
fn add_if_new(mut action: ActionSchema, model: &ActionModel, known: &mut Vec<ActionSchema>, names: &mut UniqueNames) {
    let same = |other: &ActionSchema| {
        other.call == action.call
            && other.parameters.iter().map(|p| p.ty).eq(action.parameters.iter().map(|p| p.ty))
            && other.preconditions == action.preconditions
            && other.effects == action.effects
    };
    if !model.actions.iter().chain(known.iter()).any(same) {
        action.name = names.of_action(&action, model);
        known.push(action);
    }
}
