//! No rule in the code knows a word of the kitchen: if every type, predicate, action and entity of the
//! demonstrations and tasks gets another name, everything learned and planned is the same but for the names. The new
//! names say nothing (`p004`, `e017`) and keep the alphabetical order of the old ones, since order decides ties. With
//! names in another order the actions learned are still the same, only ties may fall otherwise. The renaming is done
//! on symbolic states, behind the parser, which makes names of predicates from names of attributes and words.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use typelift::agent::{Options, propose};
use typelift::imagine;
use typelift::learn::{self, learn_dataset};
use typelift::model::{
    ActionModel, ActionSchema, Atom, Budget, Cluster, ClusterKey, Goal, GroundAtom, GroundCall, Hierarchy,
    LearnedModel, LiftedAtom, Observations, PreStates, Provenance, ROOT, State, Step, Support, Symbol, Task,
};
use typelift::plan::{Outcome, Restrictions};
use typelift::world::Dataset;
use typelift_kitchen::{demonstrations, hierarchy, tasks};
use typelift_tests::{dataset_of, planning_task, shape};

/// New names for everything.
struct Renaming {
    types: BTreeMap<Symbol, Symbol>,
    predicates: BTreeMap<Symbol, Symbol>,
    calls: BTreeMap<Symbol, Symbol>,
    entities: BTreeMap<Symbol, Symbol>,
}

/// Gives sorted names the names that `new` makes from their numbers.
fn numbered(names: BTreeSet<Symbol>, new: impl Fn(usize) -> String) -> BTreeMap<Symbol, Symbol> {
    names.into_iter().enumerate().map(|(i, name)| (name, Symbol::from(new(i)))).collect()
}

/// 0, 1, 2, … in an order that has nothing to do with theirs.
fn scattered(i: usize) -> usize {
    (i * 379 + 123) % 1000
}

impl Renaming {
    /// Names in the same alphabetical order, or in another.
    fn new(dataset: &Dataset, tasks: &[Task], same_order: bool) -> Self {
        let place = |i: usize| if same_order { i } else { scattered(i) };
        let states =
            || dataset.traces.iter().flat_map(|trace| &trace.states).chain(tasks.iter().map(|task| &task.init));
        let atoms = || {
            states()
                .flat_map(|state| &state.atoms)
                .chain(tasks.iter().flat_map(|task| task.goal.literals().map(|(atom, _)| atom)))
        };
        let calls = dataset.traces.iter().flat_map(|trace| &trace.actions).map(|action| action.call.name.clone());
        let types = dataset.hierarchy.types().map(|t| dataset.hierarchy.name(t).clone());
        let types: BTreeSet<Symbol> = types.filter(|name| *name != ROOT).collect();
        let (before, after): (BTreeSet<_>, BTreeSet<_>) = types.into_iter().partition(|name| name.as_str() < ROOT);
        // The root keeps its name and its place among the others.
        let mut types = numbered(before, |i| format!("k{:03}", place(i)));
        types.extend(numbered(after, |i| format!("q{:03}", place(i))));
        types.insert(Symbol::new(ROOT), Symbol::new(ROOT));
        Self {
            types,
            predicates: numbered(atoms().map(|a| a.predicate.clone()).collect(), |i| format!("p{:03}", place(i))),
            calls: numbered(calls.collect(), |i| format!("c{:03}", place(i))),
            entities: numbered(states().flat_map(|s| s.objects.keys().cloned()).collect(), |i| {
                format!("e{:03}", place(i))
            }),
        }
    }

    fn hierarchy(&self, hierarchy: &Hierarchy) -> Hierarchy {
        let edges = hierarchy.edges().map(|(child, parent)| (self.types[child].as_str(), self.types[parent].as_str()));
        let renamed = Hierarchy::from_edges(edges).expect("still a tree");
        assert!(hierarchy.types().eq(renamed.types()), "ids keep their meaning");
        renamed
    }

    fn atom<T: Clone>(&self, atom: &Atom<T>, term: impl Fn(&T) -> T) -> Atom<T> {
        Atom { predicate: self.predicates[&atom.predicate].clone(), args: atom.args.iter().map(term).collect() }
    }

    fn ground(&self, atom: &GroundAtom) -> GroundAtom {
        self.atom(atom, |entity| self.entities[entity].clone())
    }

    fn lifted(&self, atom: &LiftedAtom) -> LiftedAtom {
        self.atom(atom, Clone::clone)
    }

    fn state(&self, state: &State) -> State {
        assert!(state.unknown.is_nothing(), "the kitchen shows everything");
        State {
            objects: state.objects.iter().map(|(name, ty)| (self.entities[name].clone(), *ty)).collect(),
            atoms: state.atoms.iter().map(|atom| self.ground(atom)).collect(),
            ..State::default()
        }
    }

    fn goal(&self, goal: &Goal) -> Goal {
        let [required, forbidden] =
            [&goal.required, &goal.forbidden].map(|atoms| atoms.iter().map(|atom| self.ground(atom)).collect());
        Goal { required, forbidden }
    }

    fn call(&self, call: &GroundCall) -> GroundCall {
        GroundCall {
            name: self.calls[&call.name].clone(),
            args: call.args.iter().map(|arg| self.entities[arg].clone()).collect(),
        }
    }

    fn task(&self, task: &Task) -> Task {
        Task::new(self.state(&task.init), self.goal(&task.goal))
    }

    fn dataset(&self, dataset: &Dataset) -> Dataset {
        let mut renamed = dataset.clone();
        renamed.hierarchy = self.hierarchy(&dataset.hierarchy);
        for trace in &mut renamed.traces {
            trace.states = trace.states.iter().map(|state| self.state(state)).collect();
            trace.goal = self.goal(&trace.goal);
            for action in &mut trace.actions {
                action.call = self.call(&action.call);
            }
        }
        renamed
    }

    /// The name of a schema: that of the call, those of types, and perhaps a number.
    fn schema_name(&self, name: &Symbol) -> Symbol {
        let mut parts = name.as_str().split('-');
        let call = parts.next().expect("a name").to_owned();
        let rest = parts.map(|part| self.types.get(part).map_or(part, Symbol::as_str));
        let call = self.calls[call.as_str()].to_string();
        Symbol::from([call.as_str()].into_iter().chain(rest).collect::<Vec<_>>().join("-"))
    }

    fn key(&self, key: &ClusterKey) -> ClusterKey {
        ClusterKey {
            action: self.calls[&key.action].clone(),
            types: key.types.iter().map(|ty| self.types[ty].clone()).collect(),
            call: key.call.clone(),
            adds: key.adds.iter().map(|atom| self.lifted(atom)).collect(),
            deletes: key.deletes.iter().map(|atom| self.lifted(atom)).collect(),
        }
    }

    fn observations(&self, observations: &Observations) -> Observations {
        let types = |types: &BTreeSet<Symbol>| types.iter().map(|ty| self.types[ty].clone()).collect();
        let predicates = observations.predicates.iter().map(|((name, arity), arguments)| {
            ((self.predicates[name].clone(), *arity), arguments.iter().map(types).collect())
        });
        let clusters = observations.clusters.iter().map(|(key, cluster)| {
            let PreStates::Exact(states) = &cluster.states else { panic!("so many demonstrations?") };
            let states = states.iter().map(|(state, count)| (state.iter().map(|a| self.lifted(a)).collect(), *count));
            (self.key(key), Cluster { states: PreStates::Exact(states.collect()), ..cluster.clone() })
        });
        assert!(observations.negatives.is_empty() && observations.unexplained.is_empty());
        Observations { predicates: predicates.collect(), clusters: clusters.collect(), ..observations.clone() }
    }

    fn support(&self, support: &Support) -> Support {
        Support { cluster: Arc::new(self.key(&support.cluster)), ..support.clone() }
    }

    fn action(&self, action: &ActionSchema) -> ActionSchema {
        let mut renamed = action.clone();
        renamed.name = self.schema_name(&action.name);
        renamed.call.name = self.calls[&action.call.name].clone();
        for literal in &mut renamed.preconditions {
            literal.atom = self.lifted(&literal.atom);
        }
        for effect in &mut renamed.effects {
            effect.literal.atom = self.lifted(&effect.literal.atom);
        }
        renamed.provenance = match &action.provenance {
            Provenance::Demonstrated(support) => Provenance::Demonstrated(self.support(support)),
            Provenance::Generalized(support) => {
                Provenance::Generalized(support.iter().map(|support| self.support(support)).collect())
            }
            other => panic!("{other:?} is not learned"),
        };
        renamed
    }

    fn model(&self, model: &ActionModel) -> ActionModel {
        ActionModel {
            hierarchy: self.hierarchy(&model.hierarchy),
            predicates: model
                .predicates
                .iter()
                .map(|(name, types)| (self.predicates[name].clone(), types.clone()))
                .collect(),
            actions: model.actions.iter().map(|action| self.action(action)).collect(),
            ..model.clone()
        }
    }

    fn step(&self, step: &Step) -> Step {
        let mut renamed = step.clone();
        renamed.action = self.schema_name(&step.action);
        renamed.objects = step.objects.iter().map(|object| self.entities[object].clone()).collect();
        renamed.call = self.call(&step.call);
        if let Some(imagined) = &mut renamed.imagined {
            imagined.from = self.schema_name(&imagined.from);
        }
        renamed
    }
}

fn learned(dataset: &Dataset, individual: bool) -> LearnedModel {
    learn_dataset(dataset, &learn::Options { individual, ..learn::Options::default() }).expect("a model").0
}

fn shown_and_asked() -> (Dataset, Vec<(String, Task)>) {
    let dataset = dataset_of(&demonstrations(0));
    let model = ActionModel { hierarchy: hierarchy(), ..ActionModel::default() };
    let asked = tasks().iter().map(|task| (task.name.clone(), planning_task(&model, task, 0))).collect();
    (dataset, asked)
}

fn renaming(dataset: &Dataset, asked: &[(String, Task)], same_order: bool) -> Renaming {
    let tasks: Vec<Task> = asked.iter().map(|(_, task)| task.clone()).collect();
    Renaming::new(dataset, &tasks, same_order)
}

/// No word of the kitchen is left in the text.
fn assert_neutral(text: &str, renaming: &Renaming) {
    let kinds = [&renaming.types, &renaming.predicates, &renaming.calls, &renaming.entities];
    let words: BTreeSet<&str> = text.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    for name in kinds.iter().flat_map(|map| map.keys()).filter(|name| **name != ROOT) {
        assert!(!words.contains(name.as_str()), "`{name}` is still there");
    }
}

#[test]
fn other_names_give_the_same_model_under_other_names() {
    let (dataset, asked) = shown_and_asked();
    let renaming = renaming(&dataset, &asked, true);
    for individual in [true, false] {
        let original = learned(&dataset, individual);
        let renamed = learned(&renaming.dataset(&dataset), individual);
        // Piece by piece first: what differs is easier to see.
        for (a, b) in original.model.actions.iter().zip(&renamed.model.actions) {
            assert_eq!(renaming.action(a), *b);
        }
        assert_eq!(renaming.model(&original.model), renamed.model);
        assert_eq!(renaming.observations(&original.evidence.total()), *renamed.evidence.total());
        assert_eq!(renamed.model.actions.len(), if individual { 39 } else { 13 });
        assert_neutral(&renamed.model.actions.iter().map(|a| format!("{a:?}")).collect::<String>(), &renaming);
        assert_neutral(&format!("{:?}", renamed.model.hierarchy), &renaming);
    }
}

#[test]
fn other_names_give_the_same_plans_under_other_names() {
    let (dataset, asked) = shown_and_asked();
    let renaming = renaming(&dataset, &asked, true);
    let renamed = renaming.dataset(&dataset);
    for (individual, imagines) in [(false, true), (false, false), (true, false)] {
        let models = [&dataset, &renamed].map(|dataset| learned(dataset, individual).model);
        let options = Options { imagine: imagines.then(imagine::Options::default), ..Options::default() };
        for (name, task) in &asked {
            let context = format!("{name}, individual {individual}, imagines {imagines}");
            let both = [(&models[0], task.clone()), (&models[1], renaming.task(task))];
            let [original, renamed] = both.map(|(model, task)| {
                let budget = Budget::with_expansions(20_000);
                propose(model, &task, &Restrictions::default(), &options, &budget).expect("the planner does not err")
            });
            assert_eq!(original.report(), renamed.report(), "{context}: the same work");
            match (&original.outcome, &renamed.outcome) {
                (Outcome::Solved(a), Outcome::Solved(b)) => {
                    let expected: Vec<Step> = a.steps.iter().map(|step| renaming.step(step)).collect();
                    assert_eq!(expected, b.steps, "{context}");
                }
                (a, b) => assert_eq!(a, b, "{context}"),
            }
            let (a, b) = (&original.imagination, &renamed.imagination);
            assert_eq!(a.given_up.len(), b.given_up.len(), "{context}");
            assert_eq!(
                a.unreachable.iter().map(|g| renaming.ground(g)).collect::<Vec<_>>(),
                b.unreachable,
                "{context}"
            );
            let names = a.actions.iter().map(|action| renaming.schema_name(&action.name));
            assert_eq!(names.collect::<Vec<_>>(), b.actions.iter().map(|a| a.name.clone()).collect::<Vec<_>>());
        }
    }
}

#[test]
fn names_in_another_order_give_the_same_actions() {
    let (dataset, asked) = shown_and_asked();
    let renaming = renaming(&dataset, &asked, false);
    for individual in [true, false] {
        let original = learned(&dataset, individual).model;
        let renamed = learned(&renaming.dataset(&dataset), individual).model;
        let shapes = |actions: &[ActionSchema]| -> BTreeSet<_> { actions.iter().map(shape).collect() };
        let expected: Vec<ActionSchema> = original.actions.iter().map(|action| renaming.action(action)).collect();
        assert_eq!(shapes(&expected), shapes(&renamed.actions));
        assert_eq!(original.actor, renamed.actor, "ids keep their meaning");
    }
}

#[test]
fn names_in_another_order_leave_every_task_solved() {
    let (dataset, asked) = shown_and_asked();
    let renaming = renaming(&dataset, &asked, false);
    let models = [learned(&dataset, false).model, learned(&renaming.dataset(&dataset), false).model];
    let options = Options { imagine: Some(imagine::Options::default()), ..Options::default() };
    for (name, task) in &asked {
        let both = [(&models[0], task.clone()), (&models[1], renaming.task(task))];
        let [original, renamed] = both.map(|(model, task)| {
            let budget = Budget::with_expansions(20_000);
            propose(model, &task, &Restrictions::default(), &options, &budget)
                .expect("the planner does not err")
                .outcome
        });
        let (Outcome::Solved(a), Outcome::Solved(b)) = (&original, &renamed) else {
            panic!("{name}: {original:?}, {renamed:?}")
        };
        assert_eq!(a.len(), b.len(), "{name}");
    }
}
