//! What holds of everything that is learned: transitions belong together exactly if a bijection of their objects
//! says so; no result depends on names of objects, on the order of anything observed, or on how it was split; what an
//! action needs did hold whenever it was seen; what is written can be read. Held on random transitions against brute
//! force, and on demonstrations and random walks in the kitchen.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::Config;
use typelift::imagine::{self, imagine};
use typelift::learn::{self, evidence_of, learn, observe};
use typelift::model::{
    ActionModel, Budget, ClusterKey, Evidence, GroundAtom, GroundCall, Hierarchy, LiftedAtom, PRE_STATE_BOUND,
    ParseConfig, PreStates, State, Symbol, Term, TypeId, effect_bijections, is_bijection,
};
use typelift::plan::Restrictions;
use typelift::world::{Dataset, Parser, Reset, Scene, Trace, TraceAction, Transition, World};
use typelift_kitchen::{Kitchen, demonstrations, hierarchy, tasks};
use typelift_tests::{dataset_of, kitchen_model, planning_task, shape};

fn config(cases: u32) -> Config {
    Config { cases, failure_persistence: None, ..Config::default() }
}

/// Every order of `0..n`.
fn permutations(n: usize) -> Vec<Vec<u32>> {
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

proptest! {
    #![proptest_config(config(256))]

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
            prop_assert_eq!(part.parent(a), larger.parent(a));
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
    #![proptest_config(config(1_000))]

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

fn small_types() -> Hierarchy {
    Hierarchy::from_edges([("cup", "thing"), ("lid", "thing"), ("hand", "object")]).expect("a tree")
}

/// An observed step, by names.
#[derive(Debug, Clone)]
struct Seen {
    objects: BTreeMap<Symbol, TypeId>,
    before: BTreeSet<GroundAtom>,
    after: BTreeSet<GroundAtom>,
    call: GroundCall,
}

impl Seen {
    fn state(&self, atoms: &BTreeSet<GroundAtom>) -> State {
        State { objects: self.objects.clone(), atoms: atoms.clone(), unknown: BTreeSet::new() }
    }

    fn evidence(&self) -> Evidence {
        let (before, after) = (self.state(&self.before), self.state(&self.after));
        let action = TraceAction { call: self.call.clone(), executed: None, reason: None, time: None };
        let transition = Transition { before: &before, action: &action, after: &after, file: None, step: 1 };
        let mut evidence = Evidence::default();
        observe(&mut evidence, &transition, &small_types());
        evidence
    }

    fn key(&self) -> Option<ClusterKey> {
        self.evidence().clusters.into_keys().next()
    }

    fn adds(&self) -> BTreeSet<GroundAtom> {
        self.after.difference(&self.before).cloned().collect()
    }

    fn deletes(&self) -> BTreeSet<GroundAtom> {
        self.before.difference(&self.after).cloned().collect()
    }

    /// The objects of the call and of the effect.
    fn mentioned(&self) -> Vec<Symbol> {
        let mut mentioned: Vec<Symbol> = self.call.args.clone();
        mentioned.extend(self.adds().iter().chain(&self.deletes()).flat_map(|atom| atom.args.clone()));
        mentioned.sort_unstable();
        mentioned.dedup();
        mentioned
    }

    fn renamed(&self, names: &BTreeMap<Symbol, Symbol>) -> Self {
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
    fn unifies_with(&self, other: &Self) -> bool {
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

const NAMES: [&str; 5] = ["ada", "bob", "cyd", "dan", "eve"];

fn seen_atom(objects: usize) -> impl Strategy<Value = GroundAtom> {
    // Few predicates, so that effects are often symmetric.
    (0..3_usize, [0..objects, 0..objects]).prop_map(|(predicate, args)| {
        let (name, arity) = [("hot", 1), ("on", 2), ("on", 2)][predicate];
        GroundAtom::new(name, args[..arity].iter().map(|&i| Symbol::new(NAMES[i])).collect())
    })
}

/// A step that changes up to five atoms of up to five objects, of which the call names up to two, perhaps one twice.
fn seen() -> impl Strategy<Value = Seen> {
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
fn renaming(seen: &Seen, order: &[usize]) -> BTreeMap<Symbol, Symbol> {
    let fresh = ["zoe", "kim", "ada", "pat", "bob"];
    seen.objects.keys().zip(order).map(|(name, &i)| (name.clone(), Symbol::new(fresh[i]))).collect()
}

fn any_order() -> impl Strategy<Value = Vec<usize>> {
    Just((0..5).collect::<Vec<_>>()).prop_shuffle()
}

proptest! {
    #![proptest_config(config(1_500))]

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

// What is observed in the kitchen.

/// Random numbers; a seed means the same walk everywhere.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % bound
    }

    fn shuffle<T>(&mut self, elements: &mut [T]) {
        for end in (1..elements.len()).rev() {
            elements.swap(end, self.below(end + 1));
        }
    }
}

/// Every call that may make sense where the kitchen stands now.
fn calls(kitchen: &Kitchen) -> Vec<GroundCall> {
    let room = kitchen.room().expect("a room");
    let snapshot = room.snapshot();
    let agent = room.agent_name();
    let call = |name: &str, container: &Symbol, item: &Symbol| GroundCall {
        name: Symbol::new(name),
        args: vec![agent.clone(), container.clone(), item.clone()],
    };
    let mut calls = Vec::new();
    let items = snapshot.entities.iter().filter(|e| e.attributes.contains_key("movable"));
    for item in items {
        match room.container_of(item.id.as_str()) {
            Some(container) => {
                calls.extend(["PICK", "USE", "USE", "USE"].map(|name| call(name, container, &item.id)));
            }
            None => {
                let containers = snapshot.entities.iter().filter(|e| e.relations.contains_key("content"));
                calls.extend(containers.map(|container| call("PLACE", &container.id, &item.id)));
            }
        }
    }
    calls
}

/// A random walk: mostly what can be done, now and then what cannot.
fn walk(seed: u64, steps: usize, parser: &mut Parser) -> Trace {
    let mut random = Random(seed);
    let all = tasks();
    let task = &all[random.below(all.len())];
    let mut kitchen = Kitchen::new();
    let reset = Reset { seed, scenario: Some(task.scenario.clone()) };
    let mut parse = |scene: &Scene| parser.parse(scene).expect("a state");
    let mut trace = Trace {
        file: Some(Symbol::from(format!("walk_{seed}.jsonl"))),
        states: vec![parse(&kitchen.reset(&reset).expect("a room"))],
        ..Trace::default()
    };
    while trace.actions.len() < steps {
        let mut calls = calls(&kitchen);
        random.shuffle(&mut calls);
        for call in calls {
            let acted = kitchen.act(&call).expect("a room");
            if acted.executed || random.below(20) == 0 {
                trace.states.push(parse(&acted.scene));
                let (executed, reason) = (Some(acted.executed), acted.reason);
                trace.actions.push(TraceAction { call, executed, reason, time: None });
                break;
            }
        }
    }
    trace
}

fn walks(seeds: &[u64], steps: usize) -> Dataset {
    let mut parser = Parser::new(hierarchy(), ParseConfig::default());
    let traces = seeds.iter().map(|&seed| walk(seed, steps, &mut parser)).collect();
    Dataset { hierarchy: hierarchy(), predicates: parser.predicates(), traces, ..Dataset::default() }
}

fn learned(hierarchy: &Hierarchy, evidence: Evidence, individual: bool) -> ActionModel {
    let options = learn::Options { individual, ..learn::Options::default() };
    learn(hierarchy, evidence, &options).expect("a model").model
}

/// Everything that must hold between a model and what it was learned from.
fn assert_supported(model: &ActionModel, individual: bool) {
    let h = &model.hierarchy;
    let mut explained: BTreeMap<&ClusterKey, usize> = BTreeMap::new();
    for action in &model.actions {
        let preconditions: BTreeSet<LiftedAtom> = action.positive_preconditions().cloned().collect();
        assert_eq!(preconditions.len(), action.preconditions.len(), "{}: nothing negative is learned", action.name);
        let mut always: Option<BTreeSet<LiftedAtom>> = None;
        let mut types: Vec<Option<TypeId>> = vec![None; action.parameters.len()];
        assert!(!action.provenance.sources().is_empty(), "{} rests on nothing", action.name);
        assert!(!individual || action.provenance.sources().len() == 1);
        for source in action.provenance.sources() {
            *explained.entry(&source.cluster).or_default() += 1;
            assert!(is_bijection(&source.map) && source.map.len() == action.parameters.len(), "{}", action.name);
            let (key, cluster) = (&source.cluster, &model.evidence.clusters[&source.cluster]);
            let moved = |atom: &LiftedAtom| atom.renamed(&source.map);
            // The effect and the call are the cluster's.
            assert_eq!(action.adds().cloned().collect::<BTreeSet<_>>(), key.adds.iter().map(moved).collect());
            assert_eq!(action.deletes().cloned().collect::<BTreeSet<_>>(), key.deletes.iter().map(moved).collect());
            let call: Vec<Term> = key.call.iter().map(|&p| Term::Param(source.map[p as usize])).collect();
            assert_eq!((&action.call.name, &action.call.args), (&key.action, &call));
            // The preconditions held each time.
            let PreStates::Exact(states) = &cluster.states else { continue };
            assert_eq!(states.values().sum::<u64>(), cluster.count);
            for state in states.keys() {
                let state: BTreeSet<LiftedAtom> = state.iter().map(moved).collect();
                assert!(preconditions.is_subset(&state), "{} needs what did not hold", action.name);
                always = Some(always.map_or(state.clone(), |known| known.intersection(&state).cloned().collect()));
            }
            for (own, name) in key.types.iter().enumerate() {
                let ty = &mut types[source.map[own] as usize];
                let seen = h.id(name.as_str()).expect("a type");
                *ty = Some(ty.map_or(seen, |known| h.lca(known, seen)));
            }
        }
        // Nothing that always held is missing, and no type is wider than what was seen.
        assert_eq!(always, Some(preconditions), "{}", action.name);
        assert_eq!(action.parameters.iter().map(|p| Some(p.ty)).collect::<Vec<_>>(), types, "{}", action.name);
    }
    assert_eq!(explained.len(), model.evidence.clusters.len(), "every cluster is in an action");
    assert!(explained.values().all(|&times| times == 1), "and in one only");
}

proptest! {
    #![proptest_config(config(500))]

    /// The same step again and again, on objects of other types, with other atoms around: most of it becomes one
    /// action, whose parameters correspond to those of the clusters in ways that are far from obvious.
    #[test]
    fn preconditions_held_whatever_the_parameters_correspond_to(
        base in seen(),
        variants in prop::collection::vec(
            (prop::collection::vec(0..2_usize, 5), prop::collection::vec(seen_atom(5), 0..4), any_order()), 1..6,
        ),
    ) {
        let h = small_types();
        let mut evidence = Evidence::default();
        for (types, around, order) in &variants {
            let mut variant = base.clone();
            for (ty, index) in variant.objects.values_mut().zip(types) {
                *ty = h.id(["cup", "lid"][*index]).expect("a type");
            }
            // More that holds before and after is no part of the effect.
            let known = around.iter().filter(|atom| atom.args.iter().all(|arg| variant.objects.contains_key(arg)));
            for atom in known.filter(|atom| !base.adds().contains(atom) && !base.deletes().contains(atom)) {
                variant.before.insert(atom.clone());
                variant.after.insert(atom.clone());
            }
            evidence.merge(&variant.renamed(&renaming(&variant, order)).evidence());
        }
        let clusters = evidence.clusters.len();
        for individual in [true, false] {
            let model = learned(&h, evidence.clone(), individual);
            assert_supported(&model, individual);
            let expected = if individual { clusters } else { clusters.min(1) };
            prop_assert_eq!(model.actions.len(), expected, "the same step is one action");
        }
    }
}

#[test]
fn preconditions_held_whenever_an_action_was_demonstrated() {
    for individual in [true, false] {
        assert_supported(&kitchen_model(individual), individual);
    }
}

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn preconditions_held_whenever_an_action_was_seen(seeds in prop::collection::vec(any::<u64>(), 1..4)) {
        let dataset = walks(&seeds, 60);
        let evidence = evidence_of(&dataset);
        prop_assert_eq!(evidence.transitions as usize, 60 * seeds.len());
        let counted: u64 = evidence.clusters.values().map(|c| c.count).sum::<u64>() + evidence.unchanged();
        prop_assert_eq!(counted, evidence.transitions, "nothing is lost");
        for individual in [true, false] {
            assert_supported(&learned(&dataset.hierarchy, evidence.clone(), individual), individual);
        }
    }

    #[test]
    fn any_split_in_any_order_gives_the_same_bytes(
        seeds in prop::collection::vec(any::<u64>(), 1..4),
        parts in prop::collection::vec(0..4_usize, 7..50),
        salt in any::<u64>(),
    ) {
        let mut dataset = walks(&seeds, 40);
        dataset.traces.extend(dataset_of(&demonstrations(1)).traces);
        let whole = learned(&dataset.hierarchy, evidence_of(&dataset), false).to_json().expect("JSON");

        let mut random = Random(salt);
        let mut transitions: Vec<Transition<'_>> = dataset.transitions().collect();
        random.shuffle(&mut transitions);
        let mut split = vec![Evidence::default(); 4];
        for (i, transition) in transitions.iter().enumerate() {
            observe(&mut split[parts[i % parts.len()]], transition, &dataset.hierarchy);
        }
        random.shuffle(&mut split);
        // ((a + b) + c) + d, and a + (b + (c + d)).
        let merge = |mut a: Evidence, b: &Evidence| {
            a.merge(b);
            a
        };
        let left = split.iter().fold(Evidence::default(), merge);
        let right = split.iter().rev().cloned().reduce(|later, earlier| merge(earlier, &later)).expect("four");
        for merged in [left, right] {
            prop_assert_eq!(&learned(&dataset.hierarchy, merged, false).to_json().expect("JSON"), &whole);
        }
    }
}

proptest! {
    #![proptest_config(config(12))]

    /// Beyond the bound single pre-states are forgotten, but what is counted stays exact, and the same.
    #[test]
    fn counts_are_exact_beyond_the_bound(salt in any::<u64>(), number in 200..700_usize, parts in 1..6_usize) {
        let h = small_types();
        let mut random = Random(salt);
        let mut tally: BTreeMap<LiftedAtom, u64> = BTreeMap::new();
        let mut different: BTreeSet<Vec<usize>> = BTreeSet::new();
        let mut split = vec![Evidence::default(); parts];
        let mut whole = Evidence::default();
        for step in 0..number {
            // `clean` always holds; of ten others about half do.
            let held: Vec<usize> = (0..10).filter(|_| random.below(2) == 0).collect();
            let it = vec![Symbol::new(NAMES[random.below(5)])];
            let names = held.iter().map(|i| format!("p{i}")).chain(["clean".to_owned()]);
            let before: BTreeSet<GroundAtom> = names.map(|name| GroundAtom::new(name.as_str(), it.clone())).collect();
            for atom in &before {
                *tally.entry(atom.map(|_| Term::Param(0))).or_default() += 1;
            }
            different.insert(held);
            let mut after = before.clone();
            after.insert(GroundAtom::new("done", it.clone()));
            let objects: BTreeMap<Symbol, TypeId> = [(it[0].clone(), h.id("cup").expect("a type"))].into();
            let state = |atoms| State { objects: objects.clone(), atoms, unknown: BTreeSet::new() };
            let call = GroundCall { name: Symbol::new("do"), args: it };
            let action = TraceAction { call, executed: None, reason: None, time: None };
            let (before, after) = (state(before), state(after));
            let step = step as u64 + 1;
            let transition = Transition { before: &before, action: &action, after: &after, file: None, step };
            observe(&mut whole, &transition, &h);
            observe(&mut split[random.below(parts)], &transition, &h);
        }
        random.shuffle(&mut split);
        let merged = split.iter().fold(Evidence::default(), |mut merged, part| { merged.merge(part); merged });
        prop_assert_eq!(&merged, &whole);
        let cluster = whole.clusters.values().next().expect("one");
        prop_assert_eq!(whole.clusters.len(), 1);
        prop_assert_eq!(cluster.count, number as u64);
        prop_assert_eq!(cluster.states.counts(), (number as u64, tally));
        match &cluster.states {
            PreStates::Exact(states) => {
                prop_assert!(different.len() <= PRE_STATE_BOUND);
                prop_assert_eq!(states.len(), different.len());
            }
            PreStates::Counted { .. } => prop_assert!(different.len() > PRE_STATE_BOUND),
        }
        let clean = LiftedAtom::new("clean", vec![Term::Param(0)]);
        prop_assert_eq!(cluster.states.always(), BTreeSet::from([clean]));
        let [a, b] = [merged, whole].map(|evidence| learned(&h, evidence, false).to_json().expect("JSON"));
        prop_assert_eq!(&a, &b);
        let read = ActionModel::from_json(&a).expect("a model");
        prop_assert_eq!(read.to_json().expect("JSON"), a);
    }
}

#[test]
fn the_order_and_names_of_demonstrations_do_not_matter() {
    let original = dataset_of(&demonstrations(0));
    let expected = learned(&original.hierarchy, evidence_of(&original), false);
    assert_eq!(expected.actions.len(), 13);
    let shapes = |model: &ActionModel| {
        let mut shapes: Vec<_> = model.actions.iter().map(shape).collect();
        shapes.sort_unstable();
        shapes
    };
    let mut random = Random(1);
    for _ in 0..30 {
        let mut dataset = original.clone();
        random.shuffle(&mut dataset.traces);
        let mut names: Vec<usize> = (0..dataset.traces.len()).collect();
        random.shuffle(&mut names);
        for (trace, name) in dataset.traces.iter_mut().zip(names) {
            trace.file = Some(Symbol::from(format!("{name}.jsonl")));
        }
        let model = learned(&dataset.hierarchy, evidence_of(&dataset), false);
        assert_eq!(shapes(&model), shapes(&expected));
        // All but the places where it was seen.
        for (cluster, other) in model.evidence.clusters.values().zip(expected.evidence.clusters.values()) {
            assert_eq!((cluster.count, &cluster.states), (other.count, &other.states));
        }
        assert_eq!(model.actions, expected.actions);
    }
}

#[test]
fn the_room_of_a_demonstration_does_not_matter() {
    // Where things stand, and so which counters and which order, is no part of what is learned.
    let expected = kitchen_model(false);
    for seed in 1..30 {
        let dataset = dataset_of(&demonstrations(seed));
        assert_eq!(learned(&dataset.hierarchy, evidence_of(&dataset), false).actions, expected.actions, "seed {seed}");
    }
}

// Reading and writing.

#[test]
fn parsing_is_a_function_of_what_is_there() {
    let mut random = Random(7);
    for task in tasks() {
        let reset = Reset { seed: 3, scenario: Some(task.scenario.clone()) };
        let scene = Kitchen::new().reset(&reset).expect("a room");
        let parse = |scene: &Scene| Parser::new(hierarchy(), ParseConfig::default()).parse(scene).expect("a state");
        let state = parse(&scene);
        assert_eq!(state, parse(&scene));
        let Scene::Snapshot(mut snapshot) = scene else { panic!("a snapshot") };
        for _ in 0..5 {
            random.shuffle(&mut snapshot.entities);
            assert_eq!(state, parse(&Scene::Snapshot(snapshot.clone())));
        }
        // A symbolic scene with the same objects and atoms is the same state.
        let h = hierarchy();
        let objects = state.objects.iter().map(|(name, ty)| (name.clone(), h.name(*ty).clone())).collect();
        let symbolic = Scene::Symbolic { objects, atoms: state.atoms.clone(), unknown: BTreeSet::new() };
        assert_eq!(state, parse(&symbolic));
    }
}

fn assert_round_trip(model: &ActionModel) {
    let text = model.to_json().expect("JSON");
    let read = ActionModel::from_json(&text).expect("a model");
    assert_eq!(read, *model);
    assert_eq!(read.to_json().expect("JSON"), text);
}

#[test]
fn models_survive_being_written() {
    for individual in [true, false] {
        let model = kitchen_model(individual);
        assert_round_trip(&model);
        assert_round_trip(&typelift::model::strict(&model));
        let mut with_imagined = 0;
        for task in tasks() {
            let asked = planning_task(&model, &task, 0);
            let imagined =
                imagine(&model, &asked, &Restrictions::default(), &imagine::Options::default(), &Budget::unlimited())
                    .expect("no limits");
            with_imagined += usize::from(!imagined.actions.is_empty());
            assert_round_trip(&imagined.added_to(&model));
        }
        assert!(with_imagined > 0);
    }
}

proptest! {
    #![proptest_config(config(16))]

    #[test]
    fn models_of_anything_seen_survive_being_written(seeds in prop::collection::vec(any::<u64>(), 1..3)) {
        let dataset = walks(&seeds, 60);
        for individual in [true, false] {
            assert_round_trip(&learned(&dataset.hierarchy, evidence_of(&dataset), individual));
        }
    }
}
