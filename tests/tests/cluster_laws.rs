//! What holds before anything is learned: types are ordered and meet, effects unify exactly if a bijection says so, and
//! transitions belong together exactly if they unify, whatever their objects are called. Held on random ones against
//! brute force.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use proptest::sample::Index;
use typelift::model::{
    GroundAtom, Hierarchy, LiftedAtom, PreStates, Symbol, Term, TypeId, effect_bijections, is_bijection,
};
use typelift_model::testing::cases;
use typelift_tests::seen::{Seen, any_order, permutations, renaming, seen, seen_atom, small_types};

// Types.

prop_compose! {
    /// A tree as `(child, parent)` pairs in any order, names being no hint.
    fn edges()(parents in prop::collection::vec(any::<Index>(), 1..12))(
        edges in Just(
            parents.iter().enumerate().map(|(i, parent)| {
                let name = |i: usize| if i == 0 { "object".to_owned() } else { format!("t{}", (i * 7) % 13) };
                (name(i + 1), name(parent.index(i + 1)))
            }).collect::<Vec<_>>(),
        ).prop_shuffle(),
    ) -> Vec<(String, String)> {
        edges
    }
}

/// A type and everything above it, by following the pairs.
fn ancestors(edges: &[(String, String)], of: &str) -> Vec<String> {
    let mut path = vec![of.to_owned()];
    while let Some((_, parent)) = edges.iter().find(|(child, _)| child == path.last().expect("not empty")) {
        path.push(parent.clone());
    }
    path
}

prop_compose! {
    /// The same with up to two parents a type.
    fn more_edges()(tree in edges(), more in prop::collection::vec((any::<Index>(), any::<Index>()), 0..6)) -> Vec<(String, String)> {
        // A further parent is one that was made before the child, so that there is no cycle.
        let order = |name: &str| (0..13).find(|i| name == format!("t{}", (i * 7) % 13)).unwrap_or(0);
        let mut edges = tree.clone();
        for (child, parent) in more {
            let (child, parent) = (&tree[child.index(tree.len())].0, &tree[parent.index(tree.len())].0);
            if order(parent) < order(child) {
                edges.push((child.clone(), parent.clone()));
            }
        }
        edges
    }
}

/// A type and everything above it, by following all pairs.
fn closure(edges: &[(String, String)], of: &str) -> BTreeSet<String> {
    let mut above = BTreeSet::from([of.to_owned(), "object".to_owned()]);
    loop {
        let more: Vec<String> =
            edges.iter().filter(|(child, _)| above.contains(child)).map(|(_, parent)| parent.clone()).collect();
        let before = above.len();
        above.extend(more);
        if above.len() == before {
            return above;
        }
    }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn types_are_ordered_and_meet_in_the_least_common_ancestor(edges in edges()) {
        let h = Hierarchy::from_edges(edges.clone()).expect("a tree");
        prop_assert_eq!(h.len(), edges.len() + 1);
        let above: BTreeMap<TypeId, Vec<String>> =
            h.types().map(|t| (t, ancestors(&edges, h.name(t).as_str()))).collect();
        for a in h.types() {
            prop_assert_eq!(h.depth(a) as usize, above[&a].len() - 1);
            for b in h.types() {
                prop_assert_eq!(h.is_a(a, b), above[&a].contains(&h.name(b).to_string()));
                // The first of the one's ancestors that is the other's too: every other such one is above it.
                let least = above[&a].iter().find(|name| above[&b].contains(name)).expect("the root");
                prop_assert_eq!(h.name(h.lca(a, b)).as_str(), least);
                prop_assert_eq!(h.lca(a, b), h.lca(b, a));
                prop_assert_eq!(h.is_a(a, b) && h.is_a(b, a), a == b);
                prop_assert_eq!(h.disjoint(a, b), !h.is_a(a, b) && !h.is_a(b, a));
                for c in h.types() {
                    prop_assert!(!(h.is_a(a, b) && h.is_a(b, c)) || h.is_a(a, c));
                    prop_assert_eq!(h.lca(a, h.lca(b, c)), h.lca(h.lca(a, b), c));
                }
            }
        }
        let top = h.types().skip(1).reduce(|a, b| h.lca(a, b)).expect("a type");
        prop_assert_eq!(h.top(), top);
    }

    #[test]
    fn types_of_several_parents_meet_in_the_smallest_lowest_type(edges in more_edges()) {
        let h = Hierarchy::from_edges(edges.clone()).expect("no cycle");
        let above: BTreeMap<TypeId, BTreeSet<String>> =
            h.types().map(|t| (t, closure(&edges, h.name(t).as_str()))).collect();
        let name = |ty: TypeId| h.name(ty).to_string();
        let leaves = |ty: &TypeId| {
            let is_leaf = |leaf: &TypeId| !h.types().any(|other| other != *leaf && above[&other].contains(&name(*leaf)));
            h.types().filter(|leaf| is_leaf(leaf) && above[leaf].contains(&name(*ty))).count()
        };
        for a in h.types() {
            let direct = h.parents(a);
            prop_assert!(direct.iter().all(|p| !direct.iter().any(|other| other != p && h.is_a(*other, *p))));
            for b in h.types() {
                prop_assert_eq!(h.is_a(a, b), above[&a].contains(&name(b)));
                let covers = |ty: TypeId| above[&a].contains(&name(ty)) && above[&b].contains(&name(ty));
                let common: Vec<TypeId> = h.types().filter(|&ty| covers(ty)).collect();
                let is_lowest = |ty: &TypeId| !common.iter().any(|c| c != ty && above[c].contains(&name(*ty)));
                let lowest: Vec<TypeId> = common.iter().copied().filter(is_lowest).collect();
                prop_assert_eq!(&h.lowest_common(a, b), &lowest);
                let least = lowest.into_iter().min_by_key(|ty| (leaves(ty), name(*ty))).expect("the root");
                prop_assert_eq!(h.lca(a, b), least);
                let share = h.types().any(|ty| above[&ty].contains(&name(a)) && above[&ty].contains(&name(b)));
                prop_assert_eq!(h.disjoint(a, b), !share);
            }
        }
    }

    #[test]
    fn a_larger_tree_keeps_what_ids_mean(edges in edges(), cut in any::<Index>()) {
        // Only a part in which no parent is missing; the missing ones would hang below the root.
        let all = Hierarchy::from_edges(edges.clone()).expect("a tree");
        let mut ordered: Vec<_> = all.edges().map(|(c, p)| (c.to_string(), p.to_string())).collect();
        let rest = ordered.split_off(cut.index(ordered.len() + 1));
        let part = Hierarchy::from_edges(ordered).expect("a tree");
        let larger = part.extended(rest.clone()).expect("a larger tree");
        prop_assert_eq!(larger.len(), part.len() + rest.len());
        for a in part.types() {
            prop_assert_eq!(part.name(a), larger.name(a));
            prop_assert_eq!(part.parents(a), larger.parents(a));
            for b in part.types() {
                prop_assert_eq!(part.lca(a, b), larger.lca(a, b));
            }
        }
        prop_assert_eq!(part.extended(Vec::<(String, String)>::new()).expect("a tree"), part);
        prop_assert_eq!(larger.extended(edges).expect("nothing new"), larger);
    }
}

// Unification of lifted effects.

/// Signed atoms over so many parameters.
fn signed(n: usize) -> impl Strategy<Value = Vec<(bool, LiftedAtom)>> {
    let atom = (any::<bool>(), 0..4_usize, [0..n as u32, 0..n as u32]).prop_map(|(sign, predicate, args)| {
        let (name, arity) = [("dry", 0), ("hot", 1), ("wet", 1), ("on", 2)][predicate];
        (sign, LiftedAtom::new(name, args[..arity].iter().map(|&p| Term::Param(p)).collect()))
    });
    prop::collection::vec(atom, 0..7)
}

proptest! {
    #![proptest_config(cases(1_000))]

    #[test]
    fn unification_finds_exactly_the_bijections(
        ((n, left, other), types, fix, order, alike) in (1..=5_usize).prop_flat_map(|n| (
            (Just(n), signed(n), signed(n)),
            prop::collection::vec(0..2_u8, n),
            prop::collection::vec(prop::bool::weighted(0.2), n),
            Just((0..n as u32).collect::<Vec<_>>()).prop_shuffle(),
            prop::bool::weighted(0.8),
        )),
    ) {
        // Mostly the same effect under other numbers, else there is rarely a bijection at all.
        let right = if alike { left.iter().map(|(s, a)| (*s, a.renamed(&order))).collect() } else { other };
        let fixed: Vec<Option<u32>> = (0..n).map(|i| fix[i].then_some(order[i])).collect();
        // The types are those of the left side; the right side's are the same under the order.
        let compatible = |l: u32, r: u32| {
            let back = order.iter().position(|&image| image == r).expect("an order");
            types[l as usize] == types[back]
        };
        let found = effect_bijections(&fixed, compatible, &left, &right, usize::MAX);
        let want: BTreeSet<(bool, LiftedAtom)> = right.iter().cloned().collect();
        let mut expected: Vec<Vec<u32>> = permutations(n);
        expected.sort_unstable();
        expected.retain(|map| {
            let image: BTreeSet<_> = left.iter().map(|(s, a)| (*s, a.renamed(map))).collect();
            image == want
                && (0..n).all(|i| fixed[i].is_none_or(|f| f == map[i]) && compatible(i as u32, map[i]))
        });
        prop_assert_eq!(&found, &expected);
        prop_assert!(found.iter().all(|map| is_bijection(map)));
        prop_assert!(!alike || found.contains(&order), "the one that it was made with");
        prop_assert_eq!(effect_bijections(&fixed, compatible, &left, &right, 1), expected.get(..1.min(expected.len())).unwrap_or_default());
    }
}

// Clusters.

proptest! {
    #![proptest_config(cases(1_500))]

    #[test]
    fn transitions_are_of_one_cluster_exactly_if_they_unify(
        first in seen(),
        independent in seen(),
        related in prop::bool::weighted(0.7),
        order in any_order(),
        flips in prop::collection::vec(seen_atom(5), 0..2),
        retyped in prop::option::weighted(0.2, (any::<Index>(), 0..3_usize)),
    ) {
        // Mostly the same step under other names, and perhaps a little different.
        let mut second = if related { first.clone() } else { independent };
        if related {
            for atom in flips.iter().filter(|atom| atom.args.iter().all(|arg| second.objects.contains_key(arg))) {
                if !second.after.remove(atom) {
                    second.after.insert(atom.clone());
                }
            }
            if let Some((which, ty)) = retyped {
                let name = second.objects.keys().nth(which.index(second.objects.len())).expect("one").clone();
                let h = small_types();
                second.objects.insert(name, h.id(["cup", "lid", "hand"][ty]).expect("a type"));
            }
            second = second.renamed(&renaming(&second, &order));
        }
        match (first.key(), second.key()) {
            (Some(a), Some(b)) => {
                prop_assert_eq!(a == b, first.unifies_with(&second), "{:?}\n{:?}", a, b);
            }
            (a, b) => {
                // What changes nothing belongs to no cluster.
                let changes = |seen: &Seen| seen.before != seen.after;
                prop_assert_eq!((a.is_some(), b.is_some()), (changes(&first), changes(&second)));
            }
        }
    }

    #[test]
    fn names_of_objects_leave_no_trace_in_evidence(seen in seen(), order in any_order()) {
        let other = seen.renamed(&renaming(&seen, &order));
        let evidence = seen.evidence();
        prop_assert_eq!(&evidence, &other.evidence());
        prop_assert_eq!(evidence.transitions, 1);
        prop_assert_eq!(evidence.clusters.len() + evidence.negatives.len(), 1);
    }

    #[test]
    fn a_cluster_says_what_was_seen(seen in seen()) {
        // Its key is an image of the step under a numbering of its objects; so is its pre-state.
        let evidence = seen.evidence();
        let Some((key, cluster)) = evidence.clusters.iter().next() else { return Ok(()) };
        let PreStates::Exact(states) = &cluster.states else { panic!("one state") };
        let state = states.keys().next().expect("one");
        let mentioned = seen.mentioned();
        prop_assert_eq!(key.types.len(), mentioned.len());
        let h = small_types();
        let fits = permutations(mentioned.len()).into_iter().any(|order| {
            let number = |name: &Symbol| mentioned.iter().position(|m| m == name).map(|i| order[i]);
            let lift = |atom: &GroundAtom| LiftedAtom::lift(atom, number);
            let lifted = |atoms: &BTreeSet<GroundAtom>| atoms.iter().filter_map(lift).collect::<BTreeSet<_>>();
            mentioned.iter().all(|name| *h.name(seen.objects[name]) == key.types[number(name).expect("there") as usize])
                && seen.call.args.iter().map(|arg| number(arg).expect("there")).eq(key.call.iter().copied())
                && lifted(&seen.adds()) == key.adds.iter().cloned().collect()
                && lifted(&seen.deletes()) == key.deletes.iter().cloned().collect()
                && lifted(&seen.before) == *state
        });
        prop_assert!(fits, "{key:?}");
        prop_assert!(key.adds.is_sorted() && key.deletes.is_sorted());
    }
}
