//! What holds of everything that is learned: no result depends on the order of anything observed, or on how it was
//! split; what an action needs did hold whenever it was seen; what is written can be read. Held on demonstrations and
//! random walks in the kitchen.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use typelift::imagine::{self, imagine, loosenings};
use typelift::learn::{self, evidence_of, learn_evidence, observe};
use typelift::model::{
    ActionModel, Budget, ClusterKey, Evidence, GroundAtom, GroundCall, Hierarchy, LearnedModel, LiftedAtom,
    Observations, PRE_STATE_BOUND, ParseConfig, PreStates, SourceId, SplitMix64, State, Symbol, Term, TypeId,
    is_bijection,
};
use typelift::plan::Restrictions;
use typelift::world::{Dataset, Parser, Reset, Scene, Trace, TraceAction, Transition, World};
use typelift_kitchen::{Kitchen, demonstrations, hierarchy, tasks};
use typelift_model::testing::cases;
use typelift_tests::seen::{NAMES, any_order, renaming, seen, seen_atom, small_types};
use typelift_tests::{dataset_of, kitchen_model, planning_task, shape};

// What is observed in the kitchen.

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
    let mut random = SplitMix64::new(seed);
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
                trace.actions.push(TraceAction { executed, reason, ..TraceAction::from(call) });
                break;
            }
        }
    }
    trace
}

fn walks(seeds: &[u64], steps: usize) -> Dataset {
    let mut parser = Parser::new(hierarchy(), ParseConfig::default());
    let traces = seeds.iter().map(|&seed| walk(seed, steps, &mut parser)).collect();
    Dataset { hierarchy: hierarchy(), traces, ..Dataset::default() }
}

fn learned(hierarchy: &Hierarchy, evidence: Evidence, individual: bool) -> LearnedModel {
    let options = learn::Options { individual, ..learn::Options::default() };
    learn_evidence(hierarchy, &ParseConfig::default(), evidence, &options).expect("a model").0
}

/// Observations as those of one source.
fn one_source(observations: Observations) -> Evidence {
    [(SourceId::new([0; 32]), Symbol::new("all"), observations)].into_iter().collect()
}

fn kitchen_learned(individual: bool) -> LearnedModel {
    let dataset = dataset_of(&demonstrations(0));
    learned(&dataset.hierarchy, evidence_of(&dataset), individual)
}

/// Everything that must hold between a model and what it was learned from.
fn assert_supported(LearnedModel { model, evidence, .. }: &LearnedModel, individual: bool) {
    let evidence = evidence.total();
    let h = &model.hierarchy;
    let mut explained: BTreeMap<&ClusterKey, usize> = BTreeMap::new();
    for action in &model.actions {
        let preconditions: BTreeSet<LiftedAtom> = action.positive_preconditions().cloned().collect();
        assert_eq!(preconditions.len(), action.preconditions.len(), "{}: nothing negative is learned", action.name);
        let mut always: Option<BTreeSet<LiftedAtom>> = None;
        let mut types: Vec<Option<TypeId>> = vec![None; action.parameters.len()];
        assert!(!action.provenance.support().is_empty(), "{} rests on nothing", action.name);
        assert!(!individual || action.provenance.support().len() == 1);
        for support in action.provenance.support() {
            *explained.entry(&*support.cluster).or_default() += 1;
            assert!(is_bijection(&support.map) && support.map.len() == action.parameters.len(), "{}", action.name);
            let (key, cluster) = (&support.cluster, &evidence.clusters[&*support.cluster]);
            assert_eq!(support.observations, cluster.count);
            let moved = |atom: &LiftedAtom| atom.renamed(&support.map);
            // The effect and the call are the cluster's.
            assert_eq!(action.adds().cloned().collect::<BTreeSet<_>>(), key.adds.iter().map(moved).collect());
            assert_eq!(action.deletes().cloned().collect::<BTreeSet<_>>(), key.deletes.iter().map(moved).collect());
            let call: Vec<Term> = key.call.iter().map(|&p| Term::Param(support.map[p as usize])).collect();
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
                let ty = &mut types[support.map[own] as usize];
                let seen = h.id(name.as_str()).expect("a type");
                *ty = Some(ty.map_or(seen, |known| h.lca(known, seen)));
            }
        }
        // Nothing that always held is missing, and no type is wider than what was seen.
        assert_eq!(always, Some(preconditions), "{}", action.name);
        assert_eq!(action.parameters.iter().map(|p| Some(p.ty)).collect::<Vec<_>>(), types, "{}", action.name);
    }
    assert_eq!(explained.len(), evidence.clusters.len(), "every cluster is in an action");
    assert!(explained.values().all(|&times| times == 1), "and in one only");
}

proptest! {
    #![proptest_config(cases(500))]

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
        let mut evidence = Observations::default();
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
            let learned = learned(&h, one_source(evidence.clone()), individual);
            assert_supported(&learned, individual);
            let expected = if individual { clusters } else { clusters.min(1) };
            prop_assert_eq!(learned.model.actions.len(), expected, "the same step is one action");
        }
    }
}

#[test]
fn preconditions_held_whenever_an_action_was_demonstrated() {
    for individual in [true, false] {
        assert_supported(&kitchen_learned(individual), individual);
    }
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn preconditions_held_whenever_an_action_was_seen(seeds in prop::collection::vec(any::<u64>(), 1..4)) {
        let dataset = walks(&seeds, 60);
        let evidence = evidence_of(&dataset);
        let total = evidence.total().into_owned();
        prop_assert_eq!(total.transitions as usize, 60 * seeds.len());
        let counted: u64 = total.clusters.values().map(|c| c.count).sum::<u64>() + total.failures();
        prop_assert_eq!(counted, total.transitions, "nothing is lost");
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
        // Of predicates that no transition is about, whole traces alone tell.
        let whole = Observations { predicates: BTreeMap::new(), ..evidence_of(&dataset).total().into_owned() };
        let whole = learned(&dataset.hierarchy, one_source(whole), false).to_json().expect("JSON");

        let mut random = SplitMix64::new(salt);
        let mut transitions: Vec<Transition<'_>> = dataset.transitions().collect();
        random.shuffle(&mut transitions);
        let mut split = vec![Observations::default(); 4];
        for (i, transition) in transitions.iter().enumerate() {
            observe(&mut split[parts[i % parts.len()]], transition, &dataset.hierarchy);
        }
        random.shuffle(&mut split);
        // ((a + b) + c) + d, and a + (b + (c + d)).
        let merge = |mut a: Observations, b: &Observations| {
            a.merge(b);
            a
        };
        let left = split.iter().fold(Observations::default(), merge);
        let right = split.iter().rev().cloned().reduce(|later, earlier| merge(earlier, &later)).expect("four");
        for merged in [left, right] {
            prop_assert_eq!(&learned(&dataset.hierarchy, one_source(merged), false).to_json().expect("JSON"), &whole);
        }
    }
}

proptest! {
    #![proptest_config(cases(12))]

    /// Beyond the bound single pre-states are forgotten, but what is counted stays exact, and the same.
    #[test]
    fn counts_are_exact_beyond_the_bound(salt in any::<u64>(), number in 200..700_usize, parts in 1..6_usize) {
        let h = small_types();
        let mut random = SplitMix64::new(salt);
        let mut tally: BTreeMap<LiftedAtom, u64> = BTreeMap::new();
        let mut different: BTreeSet<Vec<usize>> = BTreeSet::new();
        let mut split = vec![Observations::default(); parts];
        let mut whole = Observations::default();
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
            let state = |atoms| State { objects: objects.clone(), atoms, ..State::default() };
            let call = GroundCall { name: Symbol::new("do"), args: it };
            let action = TraceAction::from(call);
            let (before, after) = (state(before), state(after));
            let step = step as u64 + 1;
            let transition = Transition { before: &before, action: &action, after: &after, file: None, step };
            observe(&mut whole, &transition, &h);
            observe(&mut split[random.below(parts)], &transition, &h);
        }
        random.shuffle(&mut split);
        let merged = split.iter().fold(Observations::default(), |mut merged, part| { merged.merge(part); merged });
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
        let [a, b] = [merged, whole].map(|observations| learned(&h, one_source(observations), false).to_json().expect("JSON"));
        prop_assert_eq!(&a, &b);
        let read = LearnedModel::from_json(&a).expect("a model");
        prop_assert_eq!(read.to_json().expect("JSON"), a);
    }
}

#[test]
fn the_order_and_names_of_demonstrations_do_not_matter() {
    let original = dataset_of(&demonstrations(0));
    let expected = learned(&original.hierarchy, evidence_of(&original), false);
    assert_eq!(expected.model.actions.len(), 13);
    let shapes = |model: &ActionModel| {
        let mut shapes: Vec<_> = model.actions.iter().map(shape).collect();
        shapes.sort_unstable();
        shapes
    };
    let mut random = SplitMix64::new(1);
    for _ in 0..30 {
        let mut dataset = original.clone();
        random.shuffle(&mut dataset.traces);
        let mut names: Vec<usize> = (0..dataset.traces.len()).collect();
        random.shuffle(&mut names);
        for (trace, name) in dataset.traces.iter_mut().zip(names) {
            trace.file = Some(Symbol::from(format!("{name}.jsonl")));
        }
        let learned = learned(&dataset.hierarchy, evidence_of(&dataset), false);
        assert_eq!(shapes(&learned.model), shapes(&expected.model));
        // All but the places where it was seen.
        let (total, expected_total) = (learned.evidence.total(), expected.evidence.total());
        for (cluster, other) in total.clusters.values().zip(expected_total.clusters.values()) {
            assert_eq!((cluster.count, &cluster.states), (other.count, &other.states));
        }
        assert_eq!(learned.model.actions, expected.model.actions);
    }
}

#[test]
fn the_room_of_a_demonstration_does_not_matter() {
    // Where things stand, and so which counters and which order, is no part of what is learned.
    let expected = kitchen_model(false);
    for seed in 1..30 {
        let dataset = dataset_of(&demonstrations(seed));
        let learned = learned(&dataset.hierarchy, evidence_of(&dataset), false);
        assert_eq!(learned.model.actions, expected.actions, "seed {seed}");
    }
}

// Reading and writing.

#[test]
fn parsing_is_a_function_of_what_is_there() {
    let mut random = SplitMix64::new(7);
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

fn assert_round_trip(learned: &LearnedModel) {
    let text = learned.to_json().expect("JSON");
    let read = LearnedModel::from_json(&text).expect("a model");
    assert_eq!(read, *learned);
    assert_eq!(read.to_json().expect("JSON"), text);
}

#[test]
fn models_survive_being_written() {
    for individual in [true, false] {
        let learned = kitchen_learned(individual);
        assert_round_trip(&learned);
        let LearnedModel { model, .. } = &learned;
        let round_trip = |model: ActionModel| assert_round_trip(&LearnedModel { model, ..learned.clone() });
        round_trip(typelift::model::strict(model));
        let (mut with_imagined, mut with_loosened) = (0, 0);
        for task in tasks() {
            let asked = planning_task(model, &task, 0);
            let mut imagined =
                imagine(model, &asked, &Restrictions::default(), &imagine::Options::default(), &Budget::unlimited())
                    .expect("no limits");
            imagined.loosen(model, &loosenings(model, &asked.goal));
            with_loosened += imagined.loosened.len();
            with_imagined += usize::from(!imagined.actions.is_empty());
            round_trip(imagined.added_to(model));
        }
        assert!(with_imagined > 0 && with_loosened > 0);
    }
}

proptest! {
    #![proptest_config(cases(16))]

    #[test]
    fn models_of_anything_seen_survive_being_written(seeds in prop::collection::vec(any::<u64>(), 1..3)) {
        let dataset = walks(&seeds, 60);
        for individual in [true, false] {
            assert_round_trip(&learned(&dataset.hierarchy, evidence_of(&dataset), individual));
        }
    }
}
