//! What holds of every plan and every search: a plan survives the plainest replay; grounding finds exactly what
//! enumeration finds; the search finds a plan exactly if there is one; landmarks are necessary; imagination only ever
//! adds; the same question gets the same answer, and no answer depends on what entities are called. Held on the
//! kitchen's 24 tasks and on tiny random problems, which are solved by brute force beside.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use typelift::agent::{Options, Proposal, propose};
use typelift::check::check;
use typelift::imagine::{self, imagine};
use typelift::model::{
    ActionModel, ActionSchema, Atom, Budget, Effect, GroundAtom, GroundCall, LiftedCall, Literal, Plan, Provenance,
    State, Symbol, Task, strict,
};
use typelift::plan::{
    self, FactId, GroundTask, Op, Outcome, Planner, Restrictions, Strategy, TieOrder, ground, landmark_sequences,
};
use typelift_kitchen::{KitchenTask, tasks};
use typelift_model::testing::{
    Cheapest, Instance, Tiny, all_instances, cheapest, cheapest_without, reachable_atoms, reachable_instances, tiny,
};
use typelift_tests::{Variant, kitchen_model, planning_task};

/// Enough for every task that is solved at all.
const EXPANSIONS: u64 = 20_000;

fn options(imagines: bool, plans: usize) -> Options {
    let plan = plan::Options { plans, ..plan::Options::default() };
    Options { imagine: imagines.then(imagine::Options::default), plan, ..Options::default() }
}

fn proposal(model: &ActionModel, task: &Task, imagines: bool, plans: usize) -> Proposal {
    let budget = Budget::with_expansions(EXPANSIONS);
    propose(model, task, &Restrictions::default(), &options(imagines, plans), &budget).expect("a plan that checks out")
}

fn kitchen_tasks(model: &ActionModel) -> Vec<(KitchenTask, Task)> {
    tasks().into_iter().map(|task| (task.clone(), planning_task(model, &task, 0))).collect()
}

/// The actions of a plan with their number, whatever their order.
fn multiset(plan: &Plan) -> BTreeMap<(Symbol, Vec<Symbol>), usize> {
    let mut actions = BTreeMap::new();
    for step in &plan.steps {
        *actions.entry((step.action.clone(), step.objects.clone())).or_default() += 1;
    }
    actions
}

#[test]
fn every_plan_of_the_kitchen_replays() {
    let models = [kitchen_model(false), kitchen_model(true)];
    let mut solved = BTreeMap::new();
    for variant in Variant::ALL {
        let model = &models[usize::from(variant.individual())];
        for (task, asked) in kitchen_tasks(model) {
            let found = proposal(model, &asked, variant.imagines(), 1);
            let Outcome::Solved(plan) = &found.outcome else { continue };
            let end = check(&found.model, &asked, plan).unwrap_or_else(|e| panic!("{variant}, {}: {e}", task.name));
            assert!(end.satisfies(&task.goal));
            // Strictness only ever forbids: the plan is one of the plain model too.
            let plain = found.imagination.added_to(model);
            check(&plain, &asked, plan).unwrap_or_else(|e| panic!("{variant}, {}, plain: {e}", task.name));
            assert!(variant.imagines() || plan.imagined_actions() == 0);
            *solved.entry(variant.name()).or_insert(0) += 1;
        }
    }
    assert_eq!(solved["generalized+imagined"], 24);
    assert_eq!(solved["generalized"], 16);
    assert!(solved["individual+imagined"] >= solved["individual"]);
}

#[test]
fn further_plans_replay_and_are_different() {
    let model = kitchen_model(false);
    for (task, asked) in kitchen_tasks(&model) {
        let mut found = proposal(&model, &asked, true, 3);
        let mut plans = Vec::new();
        let mut outcome = found.outcome.clone();
        while let Outcome::Solved(plan) = outcome {
            check(&found.model, &asked, &plan).unwrap_or_else(|e| panic!("{}: {e}", task.name));
            plans.push(plan);
            if plans.len() == 3 {
                break;
            }
            outcome = found.next_plan(&Budget::with_expansions(EXPANSIONS)).expect("a plan that checks out");
        }
        let different: BTreeSet<_> = plans.iter().map(multiset).collect();
        assert_eq!(different.len(), plans.len(), "{}: a plan was given twice", task.name);
        assert!(plans.len() > 1, "{}: there are empty counters to put things down on", task.name);
    }
}

#[test]
fn a_better_plan_is_cheaper() {
    // Two identical breads, one at a time: wasteful plans exist, and the first plan is not always the cheapest.
    let model = kitchen_model(true);
    let mut improved = 0;
    for (task, asked) in kitchen_tasks(&model) {
        let mut found = proposal(&model, &asked, true, 3);
        let Outcome::Solved(first) = found.outcome.clone() else { continue };
        // Asked for a dearer bound, anything cheaper than it will do.
        for bound in [first.cost() + 3, first.cost(), first.cost() - 1] {
            let better = found.better_plan(bound, &Budget::with_expansions(2_000)).expect("a plan that checks out");
            if let Outcome::Solved(plan) = better {
                assert!(plan.cost() < bound, "{}: {} where less than {bound} was asked", task.name, plan.cost());
                check(&found.model, &asked, &plan).unwrap_or_else(|e| panic!("{}: {e}", task.name));
                improved += 1;
            }
        }
    }
    assert!(improved > 0, "nothing was tested");
}

#[test]
fn the_same_question_gets_the_same_answer() {
    let model = kitchen_model(false);
    for (task, asked) in kitchen_tasks(&model) {
        let [a, b] = [(); 2].map(|()| proposal(&model, &asked, true, 1));
        assert_eq!(a.outcome, b.outcome, "{}", task.name);
        assert_eq!(a.report(), b.report(), "{}", task.name);
        assert_eq!(a.imagination, b.imagination, "{}", task.name);
        assert_eq!(a.model, b.model, "{}", task.name);
    }
}

/// The task with other names, in another order, for its entities.
fn renamed(task: &Task, multiplier: usize) -> Task {
    let number = |i: usize| (i * multiplier + 11) % 97;
    let names: BTreeMap<&Symbol, Symbol> = task
        .init
        .objects
        .keys()
        .enumerate()
        .map(|(i, name)| (name, Symbol::from(format!("n{:02}", number(i)))))
        .collect();
    let atom = |atom: &GroundAtom| atom.map(|arg| names[arg].clone());
    let init = State {
        objects: task.init.objects.iter().map(|(name, ty)| (names[name].clone(), *ty)).collect(),
        atoms: task.init.atoms.iter().map(atom).collect(),
        ..State::default()
    };
    Task::new(init, task.goal.required.iter().map(atom).collect::<Vec<_>>())
}

#[test]
fn names_of_entities_do_not_change_the_length_of_plans() {
    let model = kitchen_model(false);
    for (task, asked) in kitchen_tasks(&model) {
        let length = |asked: &Task| match proposal(&model, asked, true, 1).outcome {
            Outcome::Solved(plan) => plan.len(),
            other => panic!("{}: {other:?}", task.name),
        };
        let expected = length(&asked);
        for multiplier in [96, 41, 5] {
            assert_eq!(length(&renamed(&asked, multiplier)), expected, "{}, names × {multiplier}", task.name);
        }
    }
}

// Grounding.

fn grounded(model: &ActionModel, task: &Task) -> GroundTask {
    ground(model, task, &Restrictions::default(), TieOrder::default(), &Budget::unlimited()).expect("no limits")
}

/// What a ground action is, by its atoms.
type Described = (GroundCall, BTreeSet<GroundAtom>, BTreeSet<GroundAtom>, BTreeSet<GroundAtom>, BTreeSet<GroundAtom>);

fn atoms(task: &GroundTask, facts: &[FactId]) -> BTreeSet<GroundAtom> {
    facts.iter().map(|&fact| task.atom(fact)).collect()
}

/// Call, preconditions, adds, then negative preconditions and deletes as far as they are among `of`.
fn described(task: &GroundTask, of: &BTreeSet<GroundAtom>) -> BTreeSet<Described> {
    let among = |facts: &[FactId]| atoms(task, facts).intersection(of).cloned().collect();
    task.ops()
        .map(|(id, op)| {
            let (preconditions, adds) = (atoms(task, &op.preconditions), atoms(task, &op.adds));
            (task.step(id).call, preconditions, adds, among(&op.negative), among(&op.deletes))
        })
        .collect()
}

#[test]
fn imagination_only_adds() {
    let models = [kitchen_model(false), kitchen_model(true)];
    let mut added = 0;
    for model in &models {
        for (task, asked) in kitchen_tasks(model) {
            let imagined =
                imagine(model, &asked, &Restrictions::default(), &imagine::Options::default(), &Budget::unlimited())
                    .expect("no limits");
            for rewrite in [Clone::clone, strict] {
                let (base, widened) = (rewrite(model), rewrite(&imagined.added_to(model)));
                let (base, widened) = (grounded(&base, &asked), grounded(&widened, &asked));
                // What cannot be reached without imagination is no part of the actions there.
                let of: BTreeSet<GroundAtom> = base.reached_facts().map(|fact| base.atom(fact)).collect();
                let (without, with) = (described(&base, &of), described(&widened, &of));
                let lost: Vec<_> = without.difference(&with).collect();
                assert!(lost.is_empty(), "{}: {lost:?}", task.name);
                assert!(of.iter().all(|atom| widened.reaches(atom)), "{}", task.name);
                if imagined.actions.is_empty() {
                    assert_eq!(without, with, "{}", task.name);
                } else {
                    added += with.len() - without.len();
                }
            }
            for action in &imagined.actions {
                if let Provenance::Imagined { goal, .. } = &action.provenance {
                    assert!(imagined.unreachable.contains(goal), "{}: {} for {goal}", task.name, action.name);
                }
            }
        }
    }
    assert!(added > 0);
}

/// A ground action of the planner in the form of the enumeration.
fn instance(task: &GroundTask, id: plan::OpId, op: &Op) -> Instance {
    let signed = |positive: &[FactId], negative: &[FactId]| {
        let positive = positive.iter().map(|&fact| (true, task.atom(fact)));
        positive.chain(negative.iter().map(|&fact| (false, task.atom(fact)))).collect::<BTreeSet<_>>()
    };
    let always = |facts: &[FactId], adds: bool| {
        facts.iter().map(|&fact| (BTreeSet::new(), adds, task.atom(fact))).collect::<Vec<_>>()
    };
    let mut effects: BTreeSet<_> = always(&op.adds, true).into_iter().chain(always(&op.deletes, false)).collect();
    effects.extend(op.conditional.iter().map(|e| (signed(&e.positive, &e.negative), e.adds, task.atom(e.fact))));
    let step = task.step(id);
    Instance {
        action: step.action,
        objects: step.objects,
        preconditions: signed(&op.preconditions, &op.negative),
        effects,
        cost: op.cost,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn grounding_is_enumeration(Tiny { model, task } in tiny(4)) {
        let all = all_instances(&model, &task);
        let reachable = reachable_atoms(&all, &task);
        let expected = reachable_instances(&all, &reachable);
        let ground = grounded(&model, &task);
        let reached: BTreeSet<GroundAtom> = ground.reached_facts().map(|fact| ground.atom(fact)).collect();
        prop_assert_eq!(&reached, &reachable);
        prop_assert_eq!(ground.op_count_with_duplicates(), expected.len());
        let found: BTreeSet<Instance> = ground.ops().map(|(id, op)| instance(&ground, id, op)).collect();
        prop_assert_eq!(found, expected.into_iter().collect());
        let unreachable: Vec<_> = task.goal.required.iter().filter(|goal| !reachable.contains(goal)).cloned().collect();
        prop_assert_eq!(ground.unreachable_goals(), unreachable);
    }

    #[test]
    fn a_plan_is_found_exactly_if_there_is_one(Tiny { model, task } in tiny(3)) {
        let cheapest = cheapest(&all_instances(&model, &task), &task, 5_000);
        prop_assume!(cheapest != Cheapest::TooMany);
        let solvable = cheapest != Cheapest::None;
        let planner = |tie_order, plans| {
            let options = plan::Options { tie_order, plans, ..plan::Options::default() };
            Planner::new(&model, &task, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits")
        };
        // Several ways to each node.
        let mut several = planner(TieOrder::default(), 3);
        let mut plans = Vec::new();
        while let Outcome::Solved(plan) = several.next_plan(&Budget::with_expansions(EXPANSIONS)) {
            prop_assert_eq!(check(&model, &task, &plan).err(), None);
            plans.push(multiset(&plan));
            if plans.len() == 4 {
                break;
            }
        }
        prop_assert_eq!(!plans.is_empty(), solvable);
        prop_assert_eq!(plans.iter().collect::<BTreeSet<_>>().len(), plans.len());
        if !solvable {
            prop_assert_eq!(several.next_plan(&Budget::unlimited()), Outcome::Unsolvable);
            prop_assert!(!several.explain().to_string().is_empty());
        }
        // The plain search, in every order; asked for better plans, it ends with the cheapest.
        for tie_order in [TieOrder::SpecificFirst, TieOrder::GeneralFirst, TieOrder::Name] {
            let mut planner = planner(tie_order, 1);
            let mut outcome = planner.next_plan(&Budget::unlimited());
            let mut cost = None;
            while let Outcome::Solved(plan) = &outcome {
                prop_assert_eq!(check(&model, &task, plan).err(), None);
                prop_assert!(cost.is_none_or(|known| plan.cost() < known), "no better");
                cost = Some(plan.cost());
                outcome = planner.better_plan(plan.cost(), &Budget::unlimited());
            }
            match cheapest {
                Cheapest::Cost(least) => prop_assert_eq!((cost, outcome), (Some(least), Outcome::NoMorePlans)),
                _ => prop_assert_eq!((cost, outcome), (None, Outcome::Unsolvable)),
            }
        }
    }

    #[test]
    fn every_strategy_finds_plans_exactly_if_there_are_any(Tiny { model, task } in tiny(3)) {
        let cheapest = cheapest(&all_instances(&model, &task), &task, 5_000);
        prop_assume!(cheapest != Cheapest::TooMany);
        for strategy in Strategy::ALL {
            let options = plan::Options { strategy, ..plan::Options::default() };
            let planner =
                || Planner::new(&model, &task, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits");
            // Asked for better plans, it ends with the cheapest; an optimal one begins with it.
            let mut asked = planner();
            let mut outcome = asked.next_plan(&Budget::unlimited());
            let mut costs = Vec::new();
            while let Outcome::Solved(plan) = &outcome {
                prop_assert_eq!(check(&model, &task, plan).err(), None, "{}", strategy);
                prop_assert!(costs.last().is_none_or(|known| plan.cost() < *known), "{}: no better", strategy);
                costs.push(plan.cost());
                outcome = asked.better_plan(plan.cost(), &Budget::unlimited());
            }
            match cheapest {
                Cheapest::Cost(least) => {
                    prop_assert_eq!((costs.last(), outcome), (Some(&least), Outcome::NoMorePlans), "{}", strategy);
                    prop_assert!(!strategy.is_optimal() || costs.len() == 1, "{}: {:?}", strategy, costs);
                }
                _ => prop_assert_eq!((costs.last(), outcome), (None, Outcome::Unsolvable), "{}", strategy),
            }
            // Further plans are different ones.
            let mut asked = planner();
            let mut plans = Vec::new();
            while let Outcome::Solved(plan) = asked.next_plan(&Budget::with_expansions(EXPANSIONS)) {
                prop_assert_eq!(check(&model, &task, &plan).err(), None, "{}", strategy);
                plans.push(multiset(&plan));
                if plans.len() == 3 {
                    break;
                }
            }
            prop_assert_eq!(plans.iter().collect::<BTreeSet<_>>().len(), plans.len(), "{}", strategy);
        }
    }

    #[test]
    fn landmarks_of_tiny_problems_are_necessary(Tiny { model, task } in tiny(4)) {
        let ground = grounded(&model, &task);
        let all = all_instances(&model, &task);
        if matches!(cheapest(&all, &task, 5_000), Cheapest::Cost(_)) {
            // Of actions that are never applicable landmarks know more than the delete relaxation.
            let without = |fact| cheapest_without(&all, &task, 5_000, &ground.atom(fact));
            let avoidable = |fact| matches!(without(fact), Cheapest::Cost(_));
            assert_necessary(&ground, "a tiny problem", avoidable);
            assert_complete(&ground);
        }
    }
}

// Landmarks.

/// What can become true without the actions that `left_out` names and without the additions that it names.
fn relaxed(task: &GroundTask, left_out: impl Fn(&Op, FactId, &[FactId]) -> bool) -> BTreeSet<FactId> {
    let mut reached: BTreeSet<FactId> = task.init().iter().copied().collect();
    loop {
        let before = reached.len();
        for (_, op) in task.ops() {
            if !op.preconditions.iter().all(|fact| reached.contains(fact)) {
                continue;
            }
            let always = op.adds.iter().map(|&fact| (fact, &[][..]));
            let adding = op.conditional.iter().filter(|e| e.adds).map(|e| (e.fact, e.positive.as_slice()));
            for (fact, condition) in always.chain(adding) {
                if condition.iter().all(|c| reached.contains(c)) && !left_out(op, fact, condition) {
                    reached.insert(fact);
                }
            }
        }
        if reached.len() == before {
            return reached;
        }
    }
}

/// Whether the goal can be reached without anything that achieves a fact, if nothing is ever deleted.
fn relaxed_without(task: &GroundTask, fact: FactId) -> bool {
    let reached = relaxed(task, |_, added, _| added == fact);
    task.goal().iter().all(|goal| reached.contains(goal))
}

/// No plan avoids a landmark.
fn assert_necessary(task: &GroundTask, context: &str, avoidable: impl Fn(FactId) -> bool) {
    let mut checked = BTreeSet::new();
    for sequence in landmark_sequences(task, &Budget::unlimited()).expect("no limits") {
        for landmark in sequence.facts {
            assert!(!task.init().contains(&landmark), "{context}: {} holds already", task.atom(landmark));
            if checked.insert(landmark) {
                assert!(!avoidable(landmark), "{context}: {} is not necessary", task.atom(landmark));
            }
        }
    }
    // What is asked is a landmark, unless it holds.
    for goal in task.goal().iter().filter(|goal| !task.init().contains(goal)) {
        assert!(checked.contains(goal), "{context}: {} is missing", task.atom(*goal));
    }
}

/// Every fact without whose use a goal atom cannot be reached, and which mentions the goal object, is a landmark of
/// its sequence.
fn assert_complete(task: &GroundTask) {
    let sequences = landmark_sequences(task, &Budget::unlimited()).expect("no limits");
    let objects: BTreeSet<Symbol> = sequences.iter().filter_map(|s| s.object.clone()).collect();
    for &goal in task.goal() {
        let atom = task.atom(goal);
        let owner = atom.args.iter().find(|&arg| objects.contains(arg));
        for fact in task.reached_facts().filter(|fact| !task.init().contains(fact)) {
            let reached =
                relaxed(task, |op, _, condition| op.preconditions.contains(&fact) || condition.contains(&fact));
            let is_used = !task.init().contains(&goal) && (fact == goal || !reached.contains(&goal));
            let mentions = match owner {
                Some(object) => task.atom(fact).args.contains(object),
                None => task.atom(fact).args.iter().any(|arg| atom.args.contains(arg)),
            };
            if is_used && (mentions || fact == goal) {
                let mut own = sequences.iter().filter(|s| s.object.as_ref() == owner);
                assert!(
                    own.any(|s| s.facts.contains(&fact)),
                    "{} is necessary for {atom} and missing",
                    task.atom(fact)
                );
            }
        }
    }
}

#[test]
fn landmarks_of_the_kitchen_are_necessary() {
    let model = kitchen_model(false);
    for (task, asked) in kitchen_tasks(&model) {
        let imagined =
            imagine(&model, &asked, &Restrictions::default(), &imagine::Options::default(), &Budget::unlimited())
                .expect("no limits");
        let ground = grounded(&strict(&imagined.added_to(&model)), &asked);
        assert_necessary(&ground, &task.name, |fact| relaxed_without(&ground, fact));
        if ["T1.1", "T1.3", "T2.4", "T4.1"].contains(&task.name.as_str()) {
            assert_complete(&ground);
        }
    }
}

#[test]
fn a_further_plan_may_differ_in_any_action() {
    let action = |name: &str, add: &str| ActionSchema {
        name: Symbol::new(name),
        call: LiftedCall { name: Symbol::new(name), args: Vec::new() },
        parameters: Vec::new(),
        preconditions: Vec::new(),
        distinct: Vec::new(),
        effects: vec![Effect::always(Literal::positive(Atom::new(add, Vec::new())))],
        cost: 1.into(),
        strict: false,
        named_by_call: true,
        provenance: Provenance::Given,
    };
    for detour in ["a", "z"] {
        let mut actions = vec![action(detour, "noise"), action("b", "done")];
        actions.sort_by(|a, b| a.name.cmp(&b.name));
        let model = ActionModel { actions, ..ActionModel::default() };
        let task = Task::new(Default::default(), vec![GroundAtom::new("done", Vec::new())]);
        let options = plan::Options { plans: 2, ..plan::Options::default() };
        let mut planner =
            Planner::new(&model, &task, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits");
        let lengths = [(); 2].map(|()| match planner.next_plan(&Budget::unlimited()) {
            Outcome::Solved(plan) => plan.len(),
            other => panic!("{detour}: {other:?}"),
        });
        assert_eq!(lengths, [1, 2]);
    }
}
