//! Tries an environment before anything is learned in it: is what it shows what learning can use?
//!
//! An adapter may keep to the protocol and still show nothing that can be learned from: relations that flicker, a state that
//! has not settled, words where numbers are meant. Nothing of that is an error in any one state; it shows when several are
//! compared.
//!
//! | file           | what it looks at                                              |
//! |----------------|---------------------------------------------------------------|
//! | `problem.rs`   | what can be wrong, in words, and what to do about it          |
//! | `comparing.rs` | two states that should be the same                            |
//! | `sightings.rs` | the values that attributes and relations have in all scenes    |

mod comparing;
mod problem;
mod sightings;

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use thiserror::Error;
use typelift_model::{GroundCall, Hierarchy, ParseConfig, ROOT, State, Symbol, nearest};

use crate::{DoubtfulParent, Parser, Reset, Scene, UnreadKey, World, WorldError};
use comparing::{Place, changed_places, compare, differing_numbers};
use sightings::Sightings;

pub use problem::{Change, Finding, Problem};

/// How often the world is observed in a row. What flickers seldom does so at the first look.
const OBSERVATIONS: usize = 5;

/// Where fewer actions do not speak of what all of them changed, it may still be by chance.
const ACTIONS: usize = 3;

/// What an environment is tried with.
#[derive(Debug, Clone, Default)]
pub struct InspectOptions {
    /// The types that its entities are to have; any, if there are none.
    pub hierarchy: Option<Hierarchy>,
    /// What is doubtful about them.
    pub doubtful_parents: Vec<DoubtfulParent>,
    /// What is left out of the states, as in learning.
    pub parse: ParseConfig,
    /// How it is set up.
    pub reset: Reset,
    /// Actions to carry out, in turn, after everything else.
    pub calls: Vec<GroundCall>,
}

/// What was seen of an environment, and what is wrong with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inspection {
    /// Its entities in the first state.
    pub entities: usize,
    /// The types that they have.
    pub types: BTreeSet<Symbol>,
    /// The predicates of all states.
    pub predicates: BTreeSet<Symbol>,
    /// What came of the actions.
    pub tried: Vec<Tried>,
    /// What is wrong, each thing once.
    pub findings: Vec<Finding>,
    /// Where it was broken off, if the environment failed before all was tried: the rest is what was found so far.
    pub broken_off: Option<BrokenOffAt>,
}

/// The request at which an environment failed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BrokenOffAt {
    /// The request.
    pub asked: String,
    /// Whether an answer came: one that is none by the protocol, or that it could not be done.
    pub answered: bool,
}

/// An environment that failed while it was tried.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{error}")]
pub struct BrokenOff {
    /// How it failed.
    pub error: WorldError,
    /// What was found until then.
    pub found: Box<Inspection>,
}

/// What came of an action.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tried {
    /// The action.
    pub call: GroundCall,
    /// Whether the environment says that it did it.
    pub executed: bool,
    /// Why not, if it says so.
    pub reason: Option<String>,
    /// What it changed, without what changes by itself; nothing is known where a state could not be read.
    pub change: Option<Change>,
}

/// Sets an environment up twice alike, if it can be set up, observes it several times in a row, carries out the calls, sets it up
/// once more after these, and says what of all this would hurt learning. The cost is that of comparing these states.
///
/// # Errors
/// [`BrokenOff`] if the environment itself fails, with what was found until then.
pub fn inspect(world: &mut dyn World, options: &InspectOptions) -> Result<Inspection, BrokenOff> {
    let mut inspector = Inspector::new(options);
    for parent in &options.doubtful_parents {
        inspector.find("types", Problem::DoubtfulParent(parent.clone()));
    }
    let tried = inspector.try_all(world, options);
    inspector.note_unread_keys(world.unread_keys());
    match tried {
        Ok(()) => Ok(inspector.finish(None)),
        Err(error) => {
            let answered = matches!(error, WorldError::Misspoke { .. } | WorldError::Failed { .. });
            Err(BrokenOff { error, found: Box::new(inspector.finish(Some(answered))) })
        }
    }
}

/// What is gathered while an environment is tried.
struct Inspector {
    parser: Parser,
    /// The hierarchy that was asked for.
    hierarchy: Option<Hierarchy>,
    sightings: Sightings,
    /// Types met so far, each with whether the hierarchy has it.
    types: BTreeMap<Symbol, bool>,
    types_of_entities: BTreeMap<Symbol, Symbol>,
    entities: Option<usize>,
    predicates: BTreeSet<Symbol>,
    /// Attributes and relations that change by themselves: they say nothing about what else changes.
    flickering: BTreeSet<Symbol>,
    tried: Vec<Tried>,
    findings: Vec<Finding>,
    /// What the world was asked for last.
    asked: String,
}

impl Inspector {
    fn new(options: &InspectOptions) -> Self {
        let known = options.hierarchy.clone().unwrap_or_default();
        Self {
            parser: Parser::new(known, options.parse.clone()),
            hierarchy: options.hierarchy.clone(),
            sightings: Sightings::default(),
            types: BTreeMap::new(),
            types_of_entities: BTreeMap::new(),
            entities: None,
            predicates: BTreeSet::new(),
            flickering: BTreeSet::new(),
            tried: Vec::new(),
            findings: Vec::new(),
            asked: String::new(),
        }
    }

    /// All that is done with the world.
    fn try_all(&mut self, world: &mut dyn World, options: &InspectOptions) -> Result<(), WorldError> {
        let (mut set_up, mut reset) = (Vec::new(), Vec::new());
        if world.can_reset() {
            for place in ["reset", "second reset"] {
                place.clone_into(&mut self.asked);
                let scene = world.reset(&options.reset)?;
                set_up.push(self.look(place, &scene));
                reset.push(scene);
            }
        }
        let (mut observed, mut scenes) = (Vec::new(), Vec::new());
        for _ in 0..OBSERVATIONS {
            let scene = self.observe(world)?;
            observed.push(self.look("observe", &scene));
            scenes.push(scene);
        }
        self.compare_observations(&observed);
        if let [first, second] = set_up.as_slice() {
            self.compare_resets(options.reset.seed, first.as_ref(), second.as_ref());
            self.compare_numbers(options.reset.seed, &reset, &scenes);
            self.compare_settled("reset", second.as_ref(), observed[0].as_ref());
        }
        let mut before = observed.pop().flatten();
        for call in &options.calls {
            before = self.try_call(world, call, before.as_ref())?;
        }
        self.compare_changes();
        if world.can_reset() && !options.calls.is_empty() {
            self.compare_reset_after_actions(world, options, set_up.last().and_then(Option::as_ref))?;
        }
        Ok(())
    }

    /// Sets it up once more: what the actions did must be undone.
    fn compare_reset_after_actions(
        &mut self,
        world: &mut dyn World,
        options: &InspectOptions,
        before: Option<&State>,
    ) -> Result<(), WorldError> {
        "reset after the actions".clone_into(&mut self.asked);
        let scene = world.reset(&options.reset)?;
        let after = self.look("reset after the actions", &scene);
        let told = self.findings.iter().any(|finding| matches!(finding.problem, Problem::NotRepeatable { .. }));
        if let (Some(before), Some(after)) = (before, after.as_ref())
            && let Some(change) = compare(before, after, &self.flickering_predicates())
            && !told
        {
            self.find("reset", Problem::NotUndone { change });
        }
        Ok(())
    }

    fn observe(&mut self, world: &mut dyn World) -> Result<Scene, WorldError> {
        "observe".clone_into(&mut self.asked);
        world.observe()
    }

    fn find(&mut self, place: &str, problem: Problem) {
        let finding = Finding { place: place.to_owned(), problem };
        if !self.findings.iter().any(|known| known.problem.has_cause_of(&finding.problem)) {
            self.findings.push(finding);
        }
    }

    /// Looks at a scene by itself; the state that it shows, if it shows one.
    fn look(&mut self, place: &str, scene: &Scene) -> Option<State> {
        let entities = scene.entities_and_types();
        self.entities.get_or_insert(entities.len());
        for (entity, ty) in entities {
            self.note_type(place, entity, ty);
        }
        if let Scene::Snapshot(snapshot) = scene {
            self.sightings.note(snapshot, self.parser.config());
        }
        match self.parser.parse(scene) {
            Ok(state) => {
                self.predicates.extend(state.atoms.iter().map(|atom| atom.predicate.clone()));
                Some(state)
            }
            Err(error) => {
                self.find(place, Problem::NotAState(error));
                None
            }
        }
    }

    /// Notes an entity's type. One that the hierarchy lacks is found once, and taken into it: the rest can then be judged.
    fn note_type(&mut self, place: &str, entity: &Symbol, ty: &Symbol) {
        match self.types_of_entities.get(entity) {
            Some(before) if before != ty => {
                let (entity, before, now) = (entity.clone(), before.clone(), ty.clone());
                self.find(place, Problem::TypeChanges { entity, before, now });
            }
            Some(_) => {}
            None => {
                self.types_of_entities.insert(entity.clone(), ty.clone());
            }
        }
        if self.types.contains_key(ty) {
            return;
        }
        let known = self.parser.hierarchy().id(ty.as_str()).is_some();
        self.types.insert(ty.clone(), known);
        if known {
            return;
        }
        if let Some(hierarchy) = &self.hierarchy {
            let names: Vec<Symbol> = hierarchy.types().map(|known| hierarchy.name(known).clone()).collect();
            let near = nearest(ty.as_str(), &names).cloned();
            self.find(place, Problem::UnknownType { ty: ty.clone(), entity: entity.clone(), near });
        }
        // A name that no type can have is told by the parser.
        if let Ok(hierarchy) = self.parser.hierarchy().extended([(ty.as_str(), ROOT)]) {
            self.parser = Parser::new(hierarchy, self.parser.config().clone());
        }
    }

    /// Nothing was done between these observations.
    fn compare_observations(&mut self, observed: &[Option<State>]) {
        let changes = observed.windows(2).filter_map(|pair| match pair {
            [Some(before), Some(after)] => compare(before, after, &BTreeSet::new()),
            _ => None,
        });
        let changes: Vec<Change> = changes.collect();
        let sources = self.parser.attributes();
        let names = changes.iter().flat_map(Change::predicates).filter_map(|predicate| sources.get(predicate));
        self.flickering = names.cloned().collect();
        let names = self.flickering.clone();
        if let Some(change) = changes.into_iter().next() {
            self.find("observe", Problem::Flickers { names, change });
        }
    }

    /// The predicates, met so far, of what changes by itself.
    fn flickering_predicates(&self) -> BTreeSet<Symbol> {
        let sources = self.parser.attributes();
        sources.into_iter().filter(|(_, name)| self.flickering.contains(name)).map(|(predicate, _)| predicate).collect()
    }

    fn compare_resets(&mut self, seed: u64, first: Option<&State>, second: Option<&State>) {
        if let (Some(first), Some(second)) = (first, second)
            && let Some(change) = compare(first, second, &self.flickering_predicates())
        {
            self.find("reset", Problem::NotRepeatable { seed, change });
        }
    }

    /// Where two resets show the same atoms: whether they show the same numbers, but for those that change by themselves.
    fn compare_numbers(&mut self, seed: u64, reset: &[Scene], observed: &[Scene]) {
        let differing = |scenes: &[Scene]| {
            let pairs = scenes.windows(2);
            pairs.flat_map(|pair| differing_numbers(&pair[0], &pair[1], self.parser.config())).collect::<BTreeSet<_>>()
        };
        let restless = differing(observed);
        let names: BTreeSet<Symbol> = differing(reset).difference(&restless).cloned().collect();
        let told = |finding: &Finding| matches!(finding.problem, Problem::NotRepeatable { .. });
        if !names.is_empty() && !self.findings.iter().any(told) {
            self.find("reset", Problem::NumbersNotRepeatable { seed, names });
        }
    }

    /// Looks for what changed with every action that was executed, though several do not speak of it.
    fn compare_changes(&mut self) {
        let executed: Vec<&Tried> = self.tried.iter().filter(|tried| tried.executed).collect();
        let (sources, actions) = (self.parser.attributes(), executed.len());
        // Of each place how many actions changed it, and the names of those that do not speak of it.
        let mut changed: BTreeMap<Place, (usize, Vec<&Symbol>)> = BTreeMap::new();
        for Tried { call, change, .. } in executed {
            for (place, is_apart) in change.iter().flat_map(|change| changed_places(change, call, &sources)) {
                let (times, apart) = changed.entry(place).or_default();
                *times += 1;
                apart.extend(is_apart.then_some(&call.name));
            }
        }
        let is_restless = |(times, apart): &(usize, Vec<&Symbol>)| {
            *times == actions && apart.len() >= ACTIONS && apart.iter().any(|name| *name != apart[0])
        };
        let places: Vec<Place> =
            changed.into_iter().filter(|(_, changed)| is_restless(changed)).map(|(place, _)| place).collect();
        for (name, entity) in places {
            self.find("state", Problem::ChangesEveryTime { name, entity, actions });
        }
    }

    fn compare_settled(&mut self, after: &str, answered: Option<&State>, observed: Option<&State>) {
        if let (Some(answered), Some(observed)) = (answered, observed)
            && let Some(change) = compare(answered, observed, &self.flickering_predicates())
        {
            self.find(after, Problem::NotSettled { change });
        }
    }

    /// Carries out an action; the state after it.
    fn try_call(
        &mut self,
        world: &mut dyn World,
        call: &GroundCall,
        before: Option<&State>,
    ) -> Result<Option<State>, WorldError> {
        let place = call.to_string();
        let shown: BTreeSet<Symbol> = self.types_of_entities.keys().cloned().collect();
        let missing: Vec<&Symbol> = call.args.iter().filter(|arg| !shown.contains(*arg)).collect();
        self.asked.clone_from(&place);
        let acted = world.act(call);
        let executed = acted.as_ref().is_ok_and(|acted| acted.executed);
        for entity in missing {
            let problem = match executed {
                true => Problem::MadeOnDemand { entity: entity.clone() },
                false => {
                    let near = nearest(entity.as_str(), &shown).cloned();
                    Problem::NoSuchEntity { entity: entity.clone(), near }
                }
            };
            self.find(&place, problem);
        }
        let acted = acted?;
        let after = self.look(&place, &acted.scene);
        let observed = self.observe(world)?;
        let observed = self.look("observe", &observed);
        self.compare_settled(&place, after.as_ref(), observed.as_ref());
        let change = before
            .as_ref()
            .zip(after.as_ref())
            .map(|(before, after)| compare(before, after, &self.flickering_predicates()).unwrap_or_default());
        let problem = change.as_ref().and_then(|change| match executed {
            _ if !change.objects.is_empty() => Some(Problem::EntitiesChange { objects: change.objects.clone() }),
            true if change.is_empty() => Some(Problem::ChangesNothing),
            false if !change.is_empty() => Some(Problem::ChangesUnexecuted { change: change.clone() }),
            _ => None,
        });
        if let Some(problem) = problem {
            self.find(&place, problem);
        }
        self.tried.push(Tried { call: call.clone(), executed, reason: acted.reason, change });
        Ok(observed.or(after))
    }

    fn note_unread_keys(&mut self, unread: &[UnreadKey]) {
        for UnreadKey { entity, key, near } in unread.iter().cloned() {
            self.find("state", Problem::UnreadKey { key, entity, near });
        }
    }

    /// What was found; if it was broken off, with whether an answer came to what was asked last.
    fn finish(mut self, broken_off: Option<bool>) -> Inspection {
        for problem in self.sightings.problems() {
            self.find("state", problem);
        }
        for (one, other) in differing_in_case(self.predicates.iter().chain(self.types.keys())) {
            self.find("state", Problem::DiffersInCase { one, other });
        }
        // What was not met yet might have been.
        if broken_off.is_none() {
            for name in self.parser.unmatched_ignores().cloned().collect::<Vec<_>>() {
                self.find("state", Problem::NothingIgnored { name });
            }
        }
        Inspection {
            entities: self.entities.unwrap_or_default(),
            types: self.types.into_keys().collect(),
            predicates: self.predicates,
            tried: self.tried,
            findings: self.findings,
            broken_off: broken_off.map(|answered| BrokenOffAt { asked: self.asked, answered }),
        }
    }
}

/// Names that differ in case only from one before.
fn differing_in_case<'n>(names: impl Iterator<Item = &'n Symbol>) -> Vec<(Symbol, Symbol)> {
    let mut spelled: BTreeMap<String, &Symbol> = BTreeMap::new();
    let differs = |name: &'n Symbol| match spelled.entry(name.as_str().to_lowercase()) {
        Entry::Vacant(entry) => {
            entry.insert(name);
            None
        }
        Entry::Occupied(entry) => (*entry.get() != name).then(|| ((*entry.get()).clone(), name.clone())),
    };
    names.filter_map(differs).collect()
}

#[cfg(test)]
mod tests;
