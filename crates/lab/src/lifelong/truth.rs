//! How true it is what is thought to work: over all calls of demonstrated names in the states of walks by working calls, nothing
//! broken, beside what the simulator does.
//!
//! A call works if what the likeliest action says of it happens. Calls that neither the simulator carries out nor anybody
//! thinks likely are by far the most, and count for nothing.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use typelift::agent::compare;
use typelift::belief::{Belief, Question};
use typelift::model::{ActionModel, ActionSchema, GroundCall, LearnedModel, SplitMix64, State, Symbol, Term, TypeId};
use typelift::world::{Parser, Reset, Scene, Verdict, World, WorldError};
use typelift_kitchen::{Kitchen, Life, LifeTask};

/// After so many tasks of a life it is looked at; and at the end.
pub(super) const LOOKED_AT: [usize; 7] = [0, 5, 10, 20, 50, 100, 150];

/// States of one walk.
const WALK: usize = 20;

/// What is thought to work from here on is predicted to.
const PREDICTED: f64 = 0.5;

/// How true it is at some time what is thought to work.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// After so many tasks.
    pub after: usize,
    /// Calls that were predicted to work, and do.
    pub right: u64,
    /// Calls that were predicted to work, and do not: by name and types.
    pub too_much: BTreeMap<String, u64>,
    /// Calls that work, and were not predicted to.
    pub too_little: BTreeMap<String, u64>,
}

impl Truth {
    /// Adds what was looked at in another life.
    pub(super) fn add(&mut self, other: &Self) {
        self.right += other.right;
        for (sum, calls) in [(&mut self.too_much, &other.too_much), (&mut self.too_little, &other.too_little)] {
            calls.iter().for_each(|(call, count)| *sum.entry(call.clone()).or_default() += count);
        }
    }

    /// How many of the calls that were predicted to work do; 1 if none was.
    pub fn precision(&self) -> f64 {
        share(self.right, self.too_much.values().sum())
    }

    /// How many of the calls that work were predicted to; 1 if none works.
    pub fn recall(&self) -> f64 {
        share(self.right, self.too_little.values().sum())
    }
}

fn share(right: u64, wrong: u64) -> f64 {
    if right + wrong == 0 { 1.0 } else { right as f64 / (right + wrong) as f64 }
}

/// The states of walks in the rooms of a life, in which nothing is broken.
#[derive(Debug)]
pub(super) struct Walks(Vec<Standing>);

/// A state on a walk, and what each call leads to that the simulator carries out there.
#[derive(Debug)]
struct Standing {
    state: State,
    working: BTreeMap<GroundCall, State>,
}

impl Walks {
    /// So many states of the walks of a life.
    ///
    /// # Errors
    /// In words, if the simulator fails.
    pub(super) fn new(life: &Life, states: usize, learned: &LearnedModel) -> Result<Self, String> {
        let mut random = SplitMix64::new(0);
        let mut parser = Parser::new(learned.model.hierarchy.clone(), learned.parse.clone());
        let mut all = Vec::new();
        for task in life.tasks.iter().cycle().take(states.div_ceil(WALK)) {
            all.extend(walk(task, states.min(WALK), &mut random, &mut parser)?);
        }
        all.truncate(states);
        Ok(Self(all))
    }

    /// How true it is what is thought to work after so many tasks.
    pub(super) fn truth(&self, learned: &LearnedModel, after: usize) -> Truth {
        let belief = Belief::of(learned);
        let mut promising = Promising { belief: &belief, model: &learned.model, known: BTreeMap::new() };
        let mut truth = Truth { after, ..Truth::default() };
        for Standing { state, working } in &self.0 {
            let mut asked: BTreeSet<GroundCall> = promising.calls(state).into_iter().collect();
            asked.extend(working.keys().cloned());
            for call in asked {
                let types = types_of(&call.args, state);
                let judged = belief.judge(&Question { call: &call, types: &types, state: Some(state) });
                let schema = judged.action.as_ref().and_then(|name| learned.model.action(name.as_str()));
                let works = schema
                    .zip(working.get(&call))
                    .is_some_and(|(schema, after)| happens(schema, &call, state, after, &learned.model));
                let described = || described(&call, &types, &learned.model);
                match (judged.p >= PREDICTED, works) {
                    (true, true) => truth.right += 1,
                    (true, false) => *truth.too_much.entry(described()).or_default() += 1,
                    (false, true) => *truth.too_little.entry(described()).or_default() += 1,
                    (false, false) => {}
                }
            }
        }
        truth
    }
}

/// A walk of so many states in the room of a task, without what is broken there: a name that works is drawn, then a call.
fn walk(task: &LifeTask, states: usize, random: &mut SplitMix64, parser: &mut Parser) -> Result<Vec<Standing>, String> {
    let mut scenario = task.task.scenario.clone();
    if let Some(scenario) = scenario.as_object_mut() {
        scenario.remove("broken");
    }
    let failed = |error: WorldError| error.to_string();
    let mut parsed = |scene: &Scene| parser.parse(scene).map_err(|error| error.to_string());
    let mut kitchen = Kitchen::new();
    let scene = kitchen.reset(&Reset { seed: task.seed, scenario: Some(scenario) }).map_err(failed)?;
    let (mut state, mut walk) = (parsed(&scene)?, Vec::with_capacity(states));
    while walk.len() < states {
        let mut working = BTreeMap::new();
        for call in kitchen.possible_calls().unwrap_or_default() {
            let after = kitchen.clone().act(&call).map_err(failed)?;
            working.insert(call, parsed(&after.scene)?);
        }
        let names: BTreeSet<&Symbol> = working.keys().map(|call| &call.name).collect();
        let name = names.iter().nth(random.below(names.len().max(1))).map(|name| (*name).clone());
        let named: Vec<&GroundCall> = working.keys().filter(|call| Some(&call.name) == name.as_ref()).collect();
        let Some(call) = named.get(random.below(named.len().max(1))).map(|call| (*call).clone()) else { break };
        kitchen.act(&call).map_err(failed)?;
        let next = working.get(&call).cloned().unwrap_or_default();
        walk.push(Standing { state: std::mem::replace(&mut state, next), working });
    }
    Ok(walk)
}

/// Which calls may be predicted to work in some state: by name and types, for all of which every literal is as it should be.
struct Promising<'a> {
    belief: &'a Belief<'a>,
    model: &'a ActionModel,
    known: BTreeMap<(Symbol, Vec<TypeId>), bool>,
}

impl Promising<'_> {
    /// The calls of demonstrated names on objects of a state that may be predicted to work.
    fn calls(&mut self, state: &State) -> Vec<GroundCall> {
        let forms: BTreeSet<(&Symbol, usize)> =
            self.model.actions.iter().map(|schema| (&schema.call.name, schema.call.args.len())).collect();
        let mut objects: BTreeMap<TypeId, Vec<&Symbol>> = BTreeMap::new();
        for (object, ty) in &state.objects {
            objects.entry(*ty).or_default().push(object);
        }
        let mut calls = Vec::new();
        for (name, arity) in forms {
            let types: Vec<TypeId> = objects.keys().copied().collect();
            for chosen in choices(&types, arity).into_iter().filter(|chosen| self.is_promising(name, chosen)) {
                let places: Vec<&Vec<&Symbol>> = chosen.iter().map(|ty| &objects[ty]).collect();
                let mut args: Vec<Vec<Symbol>> = vec![Vec::new()];
                for objects in places {
                    let longer = |known: &Vec<Symbol>| -> Vec<Vec<Symbol>> {
                        let with = |object: &&Symbol| known.iter().cloned().chain([(*object).clone()]).collect();
                        objects.iter().map(with).collect()
                    };
                    args = args.iter().flat_map(longer).collect();
                }
                calls.extend(args.into_iter().map(|args| GroundCall { name: name.clone(), args }));
            }
        }
        calls
    }

    fn is_promising(&mut self, name: &Symbol, types: &[TypeId]) -> bool {
        let key = (name.clone(), types.to_vec());
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let args = (0..types.len()).map(|place| Symbol::from(format!("?{place}"))).collect();
        let (call, types) =
            (GroundCall { name: name.clone(), args }, types.iter().copied().map(Some).collect::<Vec<_>>());
        let p = self.belief.judge(&Question { call: &call, types: &types, state: None }).p;
        self.known.insert(key, p >= PREDICTED);
        p >= PREDICTED
    }
}

/// All lists of so many of these types.
fn choices(types: &[TypeId], length: usize) -> Vec<Vec<TypeId>> {
    (0..length).fold(vec![Vec::new()], |lists, _| {
        let longer = |list: &Vec<TypeId>| -> Vec<Vec<TypeId>> {
            types.iter().map(|ty| list.iter().copied().chain([*ty]).collect()).collect()
        };
        lists.iter().flat_map(longer).collect()
    })
}

fn types_of(objects: &[Symbol], state: &State) -> Vec<Option<TypeId>> {
    objects.iter().map(|object| state.objects.get(object).copied()).collect()
}

/// `USE cutboard onion`.
fn described(call: &GroundCall, types: &[Option<TypeId>], model: &ActionModel) -> String {
    let types = types.iter().skip(1).flatten().map(|ty| model.hierarchy.name(*ty).as_str());
    [call.name.as_str()].into_iter().chain(types).collect::<Vec<_>>().join(" ")
}

/// Whether what an action says of a call happened, whatever objects it is about besides those that the call names.
fn happens(schema: &ActionSchema, call: &GroundCall, before: &State, after: &State, model: &ActionModel) -> bool {
    let (mut schema, mut bound) = (schema.clone(), vec![None; schema.parameters.len()]);
    for (term, arg) in schema.call.args.clone().iter().zip(&call.args) {
        if let Term::Param(parameter) = term {
            bound[*parameter as usize] = Some(arg.clone());
            // It may be thought to work beyond the types that it was generalized to.
            schema.parameters[*parameter as usize].ty = model.hierarchy.root();
        }
    }
    let mut lists: Vec<Vec<Symbol>> = vec![Vec::new()];
    for (parameter, bound) in schema.parameters.iter().zip(bound) {
        let fits = |(object, ty): (&Symbol, &TypeId)| model.hierarchy.is_a(*ty, parameter.ty).then(|| object.clone());
        let choices: Vec<Symbol> = match bound {
            Some(object) => vec![object],
            None => before.objects.iter().filter_map(fits).collect(),
        };
        lists = lists
            .iter()
            .flat_map(|list| choices.iter().map(move |object| list.iter().cloned().chain([object.clone()]).collect()))
            .collect();
    }
    lists.iter().any(|objects| {
        let expected = schema.instantiate(objects, before, &model.hierarchy);
        expected.is_ok_and(|expected| compare(&expected, before, after, true, model).verdict == Verdict::AsExpected)
    })
}
