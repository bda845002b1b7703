//! Small random transitions, for laws about clusters.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use typelift::learn::observe;
use typelift::model::{ClusterKey, GroundAtom, GroundCall, Hierarchy, Observations, State, Symbol, TypeId};
use typelift::world::{TraceAction, Transition};

/// Every order of `0..n`.
pub fn permutations(n: usize) -> Vec<Vec<u32>> {
    (0..n as u32).fold(vec![Vec::new()], |shorter, next| {
        shorter
            .iter()
            .flat_map(|order| {
                (0..=order.len()).map(move |at| {
                    let mut longer: Vec<u32> = order.clone();
                    longer.insert(at, next);
                    longer
                })
            })
            .collect()
    })
}

pub fn small_types() -> Hierarchy {
    Hierarchy::from_edges([("cup", "thing"), ("lid", "thing"), ("hand", "object")]).expect("a tree")
}

/// An observed step, by names.
#[derive(Debug, Clone)]
pub struct Seen {
    pub objects: BTreeMap<Symbol, TypeId>,
    pub before: BTreeSet<GroundAtom>,
    pub after: BTreeSet<GroundAtom>,
    pub call: GroundCall,
}

impl Seen {
    pub fn state(&self, atoms: &BTreeSet<GroundAtom>) -> State {
        State { objects: self.objects.clone(), atoms: atoms.clone(), ..State::default() }
    }

    pub fn evidence(&self) -> Observations {
        let (before, after) = (self.state(&self.before), self.state(&self.after));
        let action = TraceAction::from(self.call.clone());
        let transition = Transition { before: &before, action: &action, after: &after, file: None, step: 1 };
        let mut evidence = Observations::default();
        observe(&mut evidence, &transition, &small_types());
        evidence
    }

    pub fn key(&self) -> Option<ClusterKey> {
        self.evidence().clusters.into_keys().next()
    }

    pub fn adds(&self) -> BTreeSet<GroundAtom> {
        self.after.difference(&self.before).cloned().collect()
    }

    pub fn deletes(&self) -> BTreeSet<GroundAtom> {
        self.before.difference(&self.after).cloned().collect()
    }

    /// The objects of the call and of the effect.
    pub fn mentioned(&self) -> Vec<Symbol> {
        let mut mentioned: Vec<Symbol> = self.call.args.clone();
        mentioned.extend(self.adds().iter().chain(&self.deletes()).flat_map(|atom| atom.args.clone()));
        mentioned.sort_unstable();
        mentioned.dedup();
        mentioned
    }

    pub fn renamed(&self, names: &BTreeMap<Symbol, Symbol>) -> Self {
        let atoms = |atoms: &BTreeSet<GroundAtom>| atoms.iter().map(|a| a.map(|arg| names[arg].clone())).collect();
        Self {
            objects: self.objects.iter().map(|(name, ty)| (names[name].clone(), *ty)).collect(),
            before: atoms(&self.before),
            after: atoms(&self.after),
            call: GroundCall {
                name: self.call.name.clone(),
                args: self.call.args.iter().map(|arg| names[arg].clone()).collect(),
            },
        }
    }

    /// Whether a bijection of the objects that keeps types maps call onto call, adds onto adds, deletes onto
    /// deletes; found by trying every one.
    pub fn unifies_with(&self, other: &Self) -> bool {
        let (mine, theirs) = (self.mentioned(), other.mentioned());
        if self.call.name != other.call.name
            || mine.len() != theirs.len()
            || self.call.args.len() != other.call.args.len()
        {
            return false;
        }
        permutations(mine.len()).iter().any(|order| {
            let image = |name: &Symbol| {
                let index = mine.iter().position(|m| m == name).expect("mentioned");
                &theirs[order[index] as usize]
            };
            let atoms = |atoms: BTreeSet<GroundAtom>| -> BTreeSet<GroundAtom> {
                atoms.iter().map(|atom| atom.map(|arg| image(arg).clone())).collect()
            };
            mine.iter().all(|name| self.objects[name] == other.objects[image(name)])
                && self.call.args.iter().map(image).eq(&other.call.args)
                && atoms(self.adds()) == other.adds()
                && atoms(self.deletes()) == other.deletes()
        })
    }
}

pub const NAMES: [&str; 5] = ["ada", "bob", "cyd", "dan", "eve"];

pub fn seen_atom(objects: usize) -> impl Strategy<Value = GroundAtom> {
    // Few predicates, so that effects are often symmetric.
    (0..3_usize, [0..objects, 0..objects]).prop_map(|(predicate, args)| {
        let (name, arity) = [("hot", 1), ("on", 2), ("on", 2)][predicate];
        GroundAtom::new(name, args[..arity].iter().map(|&i| Symbol::new(NAMES[i])).collect())
    })
}

/// A step that changes up to five atoms of up to five objects, of which the call names up to two, perhaps one twice.
pub fn seen() -> impl Strategy<Value = Seen> {
    (1..=5_usize).prop_flat_map(|n| {
        let atoms = |range| prop::collection::btree_set(seen_atom(n), range);
        let types = prop::collection::vec(prop_oneof![4 => Just(0_usize), 1 => Just(1), 1 => Just(2)], n);
        let args =
            prop_oneof![1 => Just(vec![]), 3 => prop::collection::vec(0..n, 1), 3 => prop::collection::vec(0..n, 2)];
        (types, atoms(0..6), atoms(0..6), args, prop::bool::weighted(0.9)).prop_map(
            |(types, before, changed, args, put)| {
                let h = small_types();
                let ids = ["cup", "lid", "hand"].map(|name| h.id(name).expect("a type"));
                let objects = types.iter().zip(NAMES).map(|(&t, name)| (Symbol::new(name), ids[t])).collect();
                let after = before.symmetric_difference(&changed).cloned().collect();
                let args = args.into_iter().map(|i| Symbol::new(NAMES[i])).collect();
                let name = Symbol::new(if put { "put" } else { "take" });
                Seen { objects, before, after, call: GroundCall { name, args } }
            },
        )
    })
}

/// A step, and the names of its objects in another order.
pub fn renaming(seen: &Seen, order: &[usize]) -> BTreeMap<Symbol, Symbol> {
    let fresh = ["zoe", "kim", "ada", "pat", "bob"];
    seen.objects.keys().zip(order).map(|(name, &i)| (name.clone(), Symbol::new(fresh[i]))).collect()
}

pub fn any_order() -> impl Strategy<Value = Vec<usize>> {
    Just((0..5).collect::<Vec<_>>()).prop_shuffle()
}
