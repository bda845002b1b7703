//! Random tasks in the whole of ADL against the plainest evaluation of their texts: every state that can be reached is
//! enumerated, and tells whether there is a plan, what the cheapest costs, which reasons are true and whether there is
//! another plan. The evaluation shares nothing with compiler and planner.
//!
//! A hundred thousand tasks take some ten minutes on a processor of their own:
//! `PROPTEST_CASES=85334 cargo test --release -p typelift-tests --test generated_adl`

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use proptest::prelude::*;
use typelift::agent::{Options, Proposal, propose};
use typelift::check::{validate, validate_stated};
use typelift::model::testing::cases;
use typelift::model::{ActionModel, Budget, GroundAtom, GroundCall, Plan, SplitMix64, Symbol, Task};
use typelift::pddl::{
    Atoms, Domain, Meaning, PddlEffect, PddlTerm, Problem, compile_domain, compile_problem, read_domain, read_plan,
    read_problem,
};
use typelift::plan::{
    self, Conflict, Explanation, Nearest, Obstacle, Outcome, Restrictions, Strategy, UnreachableGoal, Unreached,
};
use typelift_tests::adl_tasks::AdlTask;

/// Larger tasks are left out.
const MOST_STATES: usize = 400;

/// So many plans are asked for.
const PLANS: usize = 4;

/// So many ways to leave out a call of each plan are tried.
const MOST_WAYS: usize = 300;

/// The states that can be reached, the first being the initial one, and what leads from each to others.
struct Space {
    states: Vec<Atoms>,
    steps: Vec<Vec<(GroundCall, usize, u64)>>,
}

impl Space {
    /// `None` if it is too large.
    fn of(domain: &Domain, meaning: &Meaning<'_>) -> Option<Self> {
        let calls: Vec<_> = domain.actions.iter().map(|action| (action, meaning.choices(&action.parameters))).collect();
        let mut known = BTreeMap::from([(meaning.initial(), 0)]);
        let mut space = Self { states: vec![meaning.initial()], steps: Vec::new() };
        while let Some(state) = space.states.get(space.steps.len()).cloned() {
            let mut steps = Vec::new();
            for (action, choices) in &calls {
                for objects in choices.iter().filter(|objects| meaning.can_be_used(action, objects, &state)) {
                    let (after, cost) = meaning.after(action, objects, &state).expect("every function has a value");
                    let next = *known.entry(after).or_insert_with_key(|after| {
                        space.states.push(after.clone());
                        space.states.len() - 1
                    });
                    steps.push((GroundCall { name: action.name.clone(), args: objects.clone() }, next, cost));
                }
            }
            if space.states.len() > MOST_STATES {
                return None;
            }
            space.steps.push(steps);
        }
        Some(space)
    }

    /// What the cheapest way to one of these states costs that does without some calls.
    fn cheapest(&self, goals: &BTreeSet<usize>, without: &BTreeSet<&GroundCall>) -> Option<u64> {
        let mut open = BinaryHeap::from([Reverse((0, 0))]);
        let mut done = BTreeSet::new();
        while let Some(Reverse((cost, state))) = open.pop() {
            if goals.contains(&state) {
                return Some(cost);
            }
            if done.insert(state) {
                let steps = self.steps[state].iter().filter(|(call, ..)| !without.contains(call));
                open.extend(steps.map(|(_, next, step)| Reverse((cost + step, *next))));
            }
        }
        None
    }
}

/// A task with all that is known of it.
struct Known<'p> {
    domain: &'p Domain,
    /// Domain and problem, for messages.
    texts: &'p str,
    /// The problem with another goal.
    asking: &'p dyn Fn(&str) -> String,
    meaning: &'p Meaning<'p>,
    space: &'p Space,
    goals: BTreeSet<usize>,
}

#[derive(Debug, Default)]
struct Found {
    tasks: usize,
    solved: usize,
    longest: usize,
    reasons: BTreeSet<&'static str>,
}

/// A goal that holds in one of the last states that were found, if chance wants it.
fn goal(
    task: &mut AdlTask,
    random: &mut SplitMix64,
    domain: &Domain,
    meaning: &Meaning<'_>,
    space: &Space,
    init: &str,
) -> String {
    if random.below(3) == 0 {
        return format!("(and {} {})", task.formula(0), task.formula(2));
    }
    let last = space.states.len() - 1;
    let target = last - random.below(1 + last / 4);
    let mut parts = String::new();
    let mut left: Vec<usize> = (0..=last).collect();
    for draw in 0..30 {
        let part = task.formula(draw % 3);
        let problem = read_problem(&task.problem(init, &part), domain).expect("a problem");
        let holds = |state: &usize| meaning.holds(&problem.goal, &space.states[*state]);
        let still: Vec<usize> = left.iter().copied().filter(holds).collect();
        if still.len() < left.len() && still.contains(&target) {
            left = still;
            parts.push_str(&part);
        }
    }
    format!("(and {parts})")
}

/// Whether an effect adds an atom of such a predicate, with such objects where it names them.
fn adds(effect: &PddlEffect, said: &str) -> bool {
    match effect {
        PddlEffect::And(parts) => parts.iter().any(|part| adds(part, said)),
        PddlEffect::When(_, then) => adds(then, said),
        PddlEffect::Forall(_, body) => adds(body, said),
        PddlEffect::Add(atom) => {
            let (predicate, args) = said.split_once('(').unwrap_or((said, ""));
            let fits = |(term, arg): (&PddlTerm, &str)| match term {
                PddlTerm::Object(name) => arg.contains(' ') || name == arg,
                PddlTerm::Variable(_) => true,
            };
            atom.predicate == predicate && atom.args.iter().zip(args.trim_end_matches(')').split(',')).all(fits)
        }
        PddlEffect::Delete(_) | PddlEffect::Increase(_) => false,
    }
}

fn lines(plan: &Plan) -> Vec<GroundCall> {
    plan.steps.iter().map(|step| step.call.clone()).collect()
}

fn plan_text(calls: &[GroundCall]) -> String {
    let line = |call: &GroundCall| {
        let args: String = call.args.iter().map(|arg| format!(" {arg}")).collect();
        format!("({}{args})\n", call.name)
    };
    calls.iter().map(line).collect()
}

impl Known<'_> {
    /// What the steps of a plan of the file cost, if it is one.
    fn cost(&self, calls: &[GroundCall]) -> Option<u64> {
        let total = validate_stated(self.meaning, &read_plan(&plan_text(calls)).expect("a plan")).ok()?;
        Some(total - self.meaning.initial_cost())
    }

    /// Verdict, cost and further plans of a search.
    fn check_plans(&self, model: &ActionModel, task: &Task, strategy: Strategy) -> (Proposal, Option<Plan>) {
        let Self { texts, .. } = self;
        let options = Options { plan: plan::Options { strategy, ..Default::default() }, ..Options::default() };
        let budget = Budget::with_expansions(100_000);
        let proposal = propose(model, task, &Restrictions::default(), &options, &budget);
        let mut proposal = proposal.unwrap_or_else(|error| panic!("{error}\n{texts}"));
        let cheapest = self.space.cheapest(&self.goals, &BTreeSet::new());
        let mut plans: Vec<Plan> = Vec::new();
        let mut outcome = proposal.outcome.clone();
        while let Outcome::Solved(plan) = outcome {
            let calls = lines(&plan);
            assert_eq!(self.cost(&calls), Some(plan.cost()), "{strategy}: {calls:?}\n{texts}");
            assert!(
                !strategy.is_optimal() || !plans.is_empty() || cheapest == Some(plan.cost()),
                "{strategy}\n{texts}"
            );
            for other in &plans {
                let has_all = other.steps.iter().all(|step| calls.contains(&step.call));
                assert!(!has_all, "{strategy}: {calls:?} has all steps of {:?}\n{texts}", lines(other));
            }
            plans.push(plan);
            outcome = match plans.len() < PLANS {
                true => proposal.next_plan(&budget).unwrap_or_else(|error| panic!("{error}\n{texts}")),
                false => return (proposal, plans.into_iter().next()),
            };
        }
        match outcome {
            Outcome::Unsolvable => assert_eq!((plans.len(), cheapest), (0, None), "{strategy}\n{texts}"),
            Outcome::NoMorePlans => self.assert_no_other(&plans),
            other => panic!("{strategy}: {other:?}\n{texts}"),
        }
        (proposal, plans.into_iter().next())
    }

    /// No plan does without a call of each of these.
    fn assert_no_other(&self, plans: &[Plan]) {
        let mut ways: Vec<BTreeSet<&GroundCall>> = vec![BTreeSet::new()];
        for plan in plans {
            let calls: BTreeSet<&GroundCall> = plan.steps.iter().map(|step| &step.call).collect();
            let mut longer = Vec::new();
            for way in &ways {
                longer.extend(calls.iter().map(|call| way.iter().copied().chain([*call]).collect::<BTreeSet<_>>()));
            }
            ways = longer;
            if ways.len() > MOST_WAYS {
                return;
            }
        }
        for without in &ways {
            let left = self.space.cheapest(&self.goals, without);
            assert_eq!(left, None, "there is a further plan without {without:?}\n{}", self.texts);
        }
    }

    /// Validating a plan that lost a step says the same by text and by model.
    fn check_broken(&self, model: &ActionModel, task: &Task, plan: &Plan) {
        for left_out in 0..plan.steps.len() {
            let mut calls = lines(plan);
            calls.remove(left_out);
            let by_model = validate(model, task, &calls).ok().map(|valid| valid.plan.cost());
            assert_eq!(by_model, self.cost(&calls), "{calls:?}\n{}", self.texts);
        }
    }

    /// Whether what a reason says of holds in a state: an atom, maybe with `any TYPE` in it, or a formula and what its
    /// variables stand for.
    fn said_holds(&self, said: &str, state: &Atoms) -> bool {
        let (negated, said) = said.strip_prefix("not ").map_or((false, said), |rest| (true, rest));
        let holds = if said.starts_with('(') { self.formula_holds(said, state) } else { self.atom_holds(said, state) };
        holds != negated
    }

    fn atom_holds(&self, said: &str, state: &Atoms) -> bool {
        let (predicate, args) = said.split_once('(').unwrap_or_else(|| panic!("no atom: {said}\n{}", self.texts));
        let args: Vec<&str> = args.trim_end_matches(')').split(',').filter(|arg| !arg.is_empty()).collect();
        let declared = self.domain.predicates.iter().find(|p| p.name == predicate);
        let declared = declared.unwrap_or_else(|| panic!("no predicate: {said}\n{}", self.texts));
        assert_eq!(declared.parameters.len(), args.len(), "{said}\n{}", self.texts);
        let fits = |arg: &str, object: &Symbol| match arg.strip_prefix("any ").or(arg.strip_prefix("the same ")) {
            Some(types) => self.is_of(object, types),
            None => arg == object.as_str(),
        };
        let is_same = |atom: &GroundAtom, at: usize| {
            let first = args.iter().position(|arg| args[at].strip_prefix("the same ") == arg.strip_prefix("any "));
            !args[at].starts_with("the same ") || first.is_some_and(|first| atom.args[first] == atom.args[at])
        };
        let matches = |atom: &GroundAtom| {
            let fit = |at: usize| fits(args[at], &atom.args[at]) && is_same(atom, at);
            atom.predicate == predicate && (0..args.len()).all(fit)
        };
        state.iter().any(matches)
    }

    fn is_of(&self, object: &Symbol, types: &str) -> bool {
        let types = types.split(" or ").map(Symbol::new).collect();
        self.meaning.fits(object, &typelift::pddl::Typed { name: Symbol::new("any"), types })
    }

    /// Of variables that stand for any object of a type, for some.
    fn formula_holds(&self, said: &str, state: &Atoms) -> bool {
        let (formula, places) = said.split_once(" where ").unwrap_or((said, ""));
        let mut asked = formula.to_owned();
        let places: Vec<(&str, &str)> = places.split(" and ").filter_map(|place| place.split_once(" is ")).collect();
        for (variable, object) in places.iter().rev() {
            let any = object.strip_prefix("the same ").map(|ty| format!("any {ty}"));
            let first = places.iter().find(|(_, other)| any.as_deref() == Some(*other)).map(|(first, _)| *first);
            asked = match object.strip_prefix("any ") {
                Some(ty) => format!("(exists ({variable} - {ty}) {asked})"),
                None => format!("(exists ({variable}) (and (= {variable} {}) {asked}))", first.unwrap_or(object)),
            };
        }
        let problem: Problem = read_problem(&(self.asking)(&asked), self.domain)
            .unwrap_or_else(|error| panic!("{said}: {error}\n{}", self.texts));
        self.meaning.holds(&problem.goal, state)
    }

    fn assert_never(&self, said: &str) {
        let holds = self.space.states.iter().any(|state| self.said_holds(said, state));
        assert!(!holds, "said to be never true: {said}\n{}", self.texts);
    }

    /// Every sentence of a reason is true.
    fn check_reason(&self, reason: &Explanation<String>) -> &'static str {
        let text = reason.to_string();
        let blank = text.contains("  ") || text.contains(" ,") || text.ends_with([' ', ':', ',']);
        assert!(!blank && !text.is_empty(), "{text:?}\n{}", self.texts);
        match reason {
            Explanation::Unreachable(goals) => {
                let check = |_, goal: &UnreachableGoal<String>| {
                    self.assert_never(&goal.atom);
                    self.check_unreached(&goal.why, &goal.atom)
                };
                goals.iter().fold("none", check)
            }
            Explanation::Exclusive { one, other } => {
                let both = |state: &Atoms| self.said_holds(one, state) && self.said_holds(other, state);
                assert!(!self.space.states.iter().any(both), "{text}\n{}", self.texts);
                "exclusive"
            }
            Explanation::NeverDeleted(goals) => {
                let all = |state| goals.iter().all(|goal| self.said_holds(&goal.atom, state));
                assert!(self.space.states.iter().all(all), "{text}\n{}", self.texts);
                goals.iter().filter_map(|goal| goal.nearest.as_ref()).for_each(|nearest| self.check_nearest(nearest));
                "never deleted"
            }
            Explanation::NotTogether { missing, conflict } => {
                let lacks_all =
                    |state: &Atoms| missing.iter().all(|(said, positive)| self.said_holds(said, state) != *positive);
                assert!(self.space.states.iter().any(lacks_all), "{text}\n{}", self.texts);
                let Some(conflict) = conflict else { return "not together" };
                self.check_conflict(conflict);
                "in conflict"
            }
            Explanation::ToldByPlanner => panic!("{text}\n{}", self.texts),
        }
    }

    /// Nothing leads to the other atom once the one was reached, and what that takes excludes the other.
    fn check_conflict(&self, Conflict { one, other, lost, price }: &Conflict<String>) {
        let holding =
            |said: &str| -> Vec<bool> { self.space.states.iter().map(|state| self.said_holds(said, state)).collect() };
        let (one, of_other) = (holding(one), holding(other));
        let lost = lost.as_ref().map(|need| holding(&need.atom));
        let mut after: BTreeSet<usize> = (0..one.len()).filter(|&state| one[state]).collect();
        let mut open: Vec<usize> = after.iter().copied().collect();
        while let Some(state) = open.pop() {
            let is_needed = lost.as_ref().is_some_and(|lost| lost[state]);
            assert!(!(is_needed || one[state] && of_other[state]), "{}", self.texts);
            for &(_, next, _) in &self.space.steps[state] {
                assert!(of_other[state] || !of_other[next], "{}", self.texts);
                if after.insert(next) {
                    open.push(next);
                }
            }
        }
        if price.atom != *other {
            let price = holding(&price.atom);
            assert!((0..price.len()).all(|state| !price[state] || !of_other[state]), "{}", self.texts);
        }
    }

    fn check_nearest(&self, nearest: &Nearest) {
        nearest.obstacles.iter().for_each(|obstacle| self.check_obstacle(obstacle));
        if let Some(root) = &nearest.root {
            self.assert_never(&root.needs);
        }
    }

    fn check_obstacle(&self, obstacle: &Obstacle) {
        match obstacle {
            Obstacle::Precondition(said) | Obstacle::Condition(said) => self.assert_never(said),
            Obstacle::NoObject { ty } => {
                let mut objects = self.meaning.objects();
                assert!(!objects.any(|object| self.is_of(object, ty.as_str())), "{obstacle}\n{}", self.texts);
            }
            Obstacle::Type { object, expected, .. } => {
                assert!(!self.is_of(object, expected.as_str()), "{obstacle}\n{}", self.texts);
            }
            other => panic!("{other}\n{}", self.texts),
        }
    }

    fn check_unreached(&self, why: &Unreached, atom: &str) -> &'static str {
        match why {
            // An action may add it as it is written: not where it contradicts itself.
            Unreached::NoAction => {
                self.assert_never(atom);
                "no action"
            }
            Unreached::NeverUsed(action) => {
                self.assert_never(atom);
                let action = self.meaning.action(action.as_str()).expect("the domain has it");
                let mut choices = self.meaning.choices(&action.parameters).into_iter();
                let is_used = |objects: &Vec<Symbol>| {
                    self.space.states.iter().any(|state| self.meaning.can_be_used(action, objects, state))
                };
                assert!(!choices.any(|objects| is_used(&objects)), "{}", self.texts);
                "never used"
            }
            Unreached::Impossible => "impossible",
            Unreached::Derived(needed) => {
                needed.iter().for_each(|said| self.assert_never(said));
                "derived"
            }
            Unreached::Nearest(nearest) => {
                let action = self.meaning.action(nearest.action.as_str());
                let adds = action.is_some_and(|action| adds(&action.effect, atom));
                assert!(adds, "no action {} adds {atom}\n{}", nearest.action, self.texts);
                self.check_nearest(nearest);
                "nearest"
            }
        }
    }
}

/// Holds the program against one random task.
fn check(seed: u64, found: &mut Found) {
    let mut task = AdlTask::new(seed);
    let mut random = SplitMix64::new(seed);
    let (domain_text, init) = (task.domain(), task.init());
    let domain = read_domain(&domain_text).unwrap_or_else(|error| panic!("{error}\n{domain_text}"));
    let open = task.problem(&init, "(and)");
    let open = read_problem(&open, &domain).unwrap_or_else(|error| panic!("{error}\n{domain_text}\n{open}"));
    // Derived predicates that depend on their own negation are refused.
    let (meaning, model) = match (Meaning::of(&domain, &open), compile_domain(&domain)) {
        (Ok(meaning), Ok(model)) => (meaning, model),
        (Err(error), Err(_)) => return assert!(error.message.contains("its own negation"), "{error}\n{domain_text}"),
        (Ok(_), Err(error)) => return assert!(error.unsupported, "{error}\n{domain_text}"),
        (Err(error), Ok(_)) => panic!("only the compiler takes it: {error}\n{domain_text}"),
    };
    let Some(space) = Space::of(&domain, &meaning) else { return };
    let goal = goal(&mut task, &mut random, &domain, &meaning, &space, &init);
    let text = task.problem(&init, &goal);
    let problem = read_problem(&text, &domain).expect("a problem");
    let meaning = Meaning::of(&domain, &problem).expect("it means something");
    let goals = (0..space.states.len()).filter(|&state| meaning.holds(&problem.goal, &space.states[state])).collect();
    let mut model = model;
    let Ok(compiled) = compile_problem(&problem, &mut model) else { return };
    let asking = |goal: &str| task.problem(&init, goal);
    let texts = format!("seed {seed}\n{domain_text}\n{text}");
    let known = Known { domain: &domain, texts: &texts, asking: &asking, meaning: &meaning, space: &space, goals };
    let suboptimal = [Strategy::default(), Strategy::LamaPortfolio, Strategy::LazyFf, Strategy::Bfws][random.below(4)];
    let optimal = [Strategy::AStarLmCut, Strategy::AStarBlind][random.below(2)];
    for strategy in [suboptimal, optimal] {
        let (proposal, plan) = known.check_plans(&model, &compiled, strategy);
        match plan {
            Some(plan) => {
                known.check_broken(&model, &compiled, &plan);
                found.longest = found.longest.max(plan.len());
                found.solved += usize::from(strategy.is_optimal() && !plan.steps.is_empty());
            }
            None => drop(found.reasons.insert(known.check_reason(&proposal.explain()))),
        }
    }
    found.tasks += 1;
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn the_program_agrees_with_plain_evaluation(seed in any::<u64>()) {
        check(seed, &mut Found::default());
    }
}

#[test]
fn generated_tasks_are_of_all_kinds() {
    let mut found = Found::default();
    (0..300).for_each(|seed| check(seed, &mut found));
    assert!(found.tasks > 250 && found.solved > 100 && found.longest >= 10, "{found:?}");
    let kinds =
        ["derived", "exclusive", "impossible", "nearest", "never deleted", "never used", "no action", "not together"];
    assert_eq!(found.reasons, BTreeSet::from(kinds), "{found:?}");
}
