//! Conditions that others imply: where a model and an initial state make sure that of some atoms at most one holds, as
//! of "the hand is empty" and "the hand holds …", requiring the one is requiring that the other does not hold.
//!
//! The groups are the invariants of Helmert (2009, section 5), with weight one and at most one counted argument a
//! predicate. A group is tried for each condition that might be implied, instead of looking for all that there are: it
//! holds if it does initially, and if every action that adds to it takes away from it what it required.
//!
//! The planner finds its groups ground action by ground action (`plan/src/fdr/mutex.rs`), which is more than schemas
//! alone can tell. It has grounded the task for that; an export has not, and may be of a task that is too large to.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionModel, ActionSchema, GroundAtom, Hierarchy, LiftedAtom, Literal, Symbol, Task, Term};

/// More predicates than these no group has.
const MOST_MEMBERS: usize = 6;

/// A predicate of a group: which of the group's keys each argument is; `None` for the one that is counted.
type Member = (Symbol, Vec<Option<usize>>);

/// Predicates of which, for each choice of the keys, at most one atom holds.
type Group = BTreeSet<Member>;

/// Leaves out of the preconditions what others of them imply, in every state that can be reached from the task's.
pub(super) fn without_implied(model: &ActionModel, task: &Task) -> ActionModel {
    let mut exclusive = Exclusive { model, task, known: BTreeMap::new() };
    let mut lean = model.clone();
    for action in &mut lean.actions {
        let required: Vec<LiftedAtom> = action.positive_preconditions().cloned().collect();
        action.preconditions.retain(|literal| {
            literal.positive || literal.atom.is_equality() || !required.iter().any(|r| exclusive.are(r, &literal.atom))
        });
    }
    lean
}

struct Exclusive<'a> {
    model: &'a ActionModel,
    task: &'a Task,
    /// Groups that were tried, and whether they can be made to hold.
    known: BTreeMap<Group, bool>,
}

impl Exclusive<'_> {
    /// Whether two atoms over the same parameters never hold both.
    fn are(&mut self, one: &LiftedAtom, other: &LiftedAtom) -> bool {
        if one.predicate == other.predicate {
            return false;
        }
        let keys: Vec<&Term> = one.args.iter().filter(|term| other.args.contains(term)).collect();
        let (Some(one), Some(other)) = (member(one, &keys), member(other, &keys)) else { return false };
        let group = Group::from([one, other]);
        if let Some(known) = self.known.get(&group) {
            return *known;
        }
        let holds = self.can_hold(&group);
        self.known.insert(group, holds);
        holds
    }

    /// Whether the group, perhaps with further members, holds in every state.
    fn can_hold(&self, group: &Group) -> bool {
        if !self.holds_initially(group) {
            return false;
        }
        for action in &self.model.actions {
            match takes_as_it_adds(action, group, &self.model.hierarchy) {
                Balance::Kept => {}
                Balance::Lost => return false,
                // With what it takes away in the group, it may be kept.
                Balance::Wants(members) => {
                    return group.len() < MOST_MEMBERS
                        && members.into_iter().any(|member| {
                            let mut larger = group.clone();
                            larger.insert(member) && self.can_hold(&larger)
                        });
                }
            }
        }
        true
    }

    fn holds_initially(&self, group: &Group) -> bool {
        let mut held: BTreeMap<Vec<&Symbol>, &GroundAtom> = BTreeMap::new();
        self.task.init.atoms.iter().all(|atom| {
            members(group, &atom.predicate, atom.args.len())
                .all(|member| held.insert(keys(&atom.args, member), atom).is_none_or(|other| other == atom))
        })
    }
}

enum Balance {
    /// With at most one atom before there is at most one afterwards.
    Kept,
    /// No further member changes that there may be more.
    Lost,
    /// Were one of these a member, there might be at most one.
    Wants(Vec<Member>),
}

fn takes_as_it_adds(action: &ActionSchema, group: &Group, hierarchy: &Hierarchy) -> Balance {
    let added: Vec<(Vec<&Term>, &LiftedAtom)> = action.adds().flat_map(|atom| instances(group, atom)).collect();
    for (i, (one, atom)) in added.iter().enumerate() {
        let same_group = |other: &[&Term]| one.iter().zip(other).all(|(a, b)| may_be_same(action, a, b, hierarchy));
        if added[..i].iter().any(|(other, another)| another != atom && same_group(other)) {
            return Balance::Lost;
        }
        let taken = || action.deletes().filter(|atom| action.positive_preconditions().any(|needed| needed == *atom));
        if taken().any(|taken| instances(group, taken).any(|(keys, _)| keys == *one)) {
            continue;
        }
        let wanted = taken().filter_map(|taken| member(taken, one)).filter(|member| !group.contains(member));
        return Balance::Wants(wanted.collect());
    }
    Balance::Kept
}

/// An atom as a member of a group with these keys; not if more than one argument is none of them, or one is repeated.
fn member(atom: &LiftedAtom, keys: &[&Term]) -> Option<Member> {
    let places: Vec<Option<usize>> = atom.args.iter().map(|term| keys.iter().position(|key| *key == term)).collect();
    let each_once = (0..keys.len()).all(|key| places.iter().filter(|place| **place == Some(key)).count() == 1);
    let counted = places.iter().filter(|place| place.is_none()).count();
    (each_once && counted <= 1).then(|| (atom.predicate.clone(), places))
}

fn members<'g>(group: &'g Group, predicate: &'g Symbol, arity: usize) -> impl Iterator<Item = &'g [Option<usize>]> {
    let of_predicate = group.iter().filter(move |(name, places)| name == predicate && places.len() == arity);
    of_predicate.map(|(_, places)| &places[..])
}

/// What stands for each key, in the keys' order.
fn keys<'t, T>(args: &'t [T], places: &[Option<usize>]) -> Vec<&'t T> {
    let mut keys: Vec<(usize, &T)> =
        places.iter().zip(args).filter_map(|(place, arg)| Some(((*place)?, arg))).collect();
    keys.sort_unstable_by_key(|(key, _)| *key);
    keys.into_iter().map(|(_, arg)| arg).collect()
}

/// The keys with which an atom belongs to the group, for each of its members that it fits.
fn instances<'t>(group: &Group, atom: &'t LiftedAtom) -> impl Iterator<Item = (Vec<&'t Term>, &'t LiftedAtom)> {
    let of_members = members(group, &atom.predicate, atom.args.len()).map(|places| (keys(&atom.args, places), atom));
    of_members.collect::<Vec<_>>().into_iter()
}

/// Whether two terms of an action may stand for one object.
fn may_be_same(action: &ActionSchema, one: &Term, other: &Term, hierarchy: &Hierarchy) -> bool {
    let differ = action.preconditions.iter().any(|literal| {
        let Literal { atom, positive: false } = literal else { return false };
        atom.is_equality() && matches!(&atom.args[..], [a, b] if (a, b) == (one, other) || (b, a) == (one, other))
    });
    !differ
        && match (one, other) {
            (Term::Param(i), Term::Param(j)) => {
                let [i_type, j_type] = [i, j].map(|index| action.parameters[*index as usize].ty);
                i == j || !hierarchy.disjoint(i_type, j_type)
            }
            (Term::Const(a), Term::Const(b)) => a == b,
            _ => true,
        }
}
