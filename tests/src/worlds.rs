//! Kitchens that are watched, and in which things happen that nobody planned.

use typelift::agent::{Account, Confirmation, Episode, Event, Experience, Options, Person, run};
use typelift::model::{ActionModel, Budget, GroundCall, ParseConfig, Plan, State, Symbol};
use typelift::world::{Acted, Parser, Reset, Scene, World, WorldError};
use typelift_kitchen::{Kitchen, KitchenTask};

use std::sync::Arc;

/// What happens instead of, or around, an action; see [`Watched`].
pub type Meddle = Box<dyn FnMut(&mut Kitchen, &GroundCall) -> Result<Acted, WorldError> + Send>;

/// A kitchen that writes down which actions it is told, and in which an action does what `meddle` says.
pub struct Watched {
    /// The kitchen.
    pub kitchen: Kitchen,
    /// Every action that it was told, in order.
    pub told: Vec<GroundCall>,
    /// How often it was reset.
    pub resets: usize,
    meddle: Meddle,
}

impl std::fmt::Debug for Watched {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watched").field("told", &self.told).field("resets", &self.resets).finish_non_exhaustive()
    }
}

impl Watched {
    /// A kitchen in which actions do what they do.
    pub fn new() -> Self {
        Self::with(World::act)
    }

    /// A kitchen in which an action does what `meddle` says.
    pub fn with(meddle: impl FnMut(&mut Kitchen, &GroundCall) -> Result<Acted, WorldError> + Send + 'static) -> Self {
        Self { kitchen: Kitchen::new(), told: Vec::new(), resets: 0, meddle: Box::new(meddle) }
    }

    /// How often it was told this action.
    pub fn times_told(&self, call: &GroundCall) -> usize {
        self.told.iter().filter(|told| *told == call).count()
    }
}

impl Default for Watched {
    fn default() -> Self {
        Self::new()
    }
}

impl World for Watched {
    fn name(&self) -> String {
        "a watched kitchen".to_owned()
    }

    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError> {
        self.resets += 1;
        self.kitchen.reset(reset)
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        self.kitchen.observe()
    }

    fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError> {
        self.told.push(call.clone());
        (self.meddle)(&mut self.kitchen, call)
    }
}

/// Everything that came of an episode.
#[derive(Debug)]
pub struct Ran {
    /// What the agent says of it.
    pub account: Account,
    /// What was tried, and what came of it.
    pub experience: Experience,
    /// The instance of the kitchen.
    pub instance: Symbol,
    /// What happened, in order.
    pub events: Vec<Event>,
    /// The state that the world was left in.
    pub left: State,
}

/// One task in a watched kitchen. Every expectation that holds of all episodes is asserted here.
///
/// # Panics
/// If the account contradicts what was observed.
pub fn run_in(
    world: &mut Watched,
    model: &Arc<ActionModel>,
    task: &KitchenTask,
    seed: u64,
    options: &Options,
    experience: Experience,
    person: &mut dyn Person,
) -> Ran {
    let mut parser = Parser::new(model.hierarchy.clone(), ParseConfig::default());
    let budget = Budget::with_expansions(20_000);
    let mut episode = Episode::new(model.clone(), task.goal.clone(), options.clone(), experience, budget);
    let reset = Reset { seed, scenario: Some(task.scenario.clone()) };
    let mut events: Vec<Event> = Vec::new();
    let told = world.told.len();
    let ran = run(&mut episode, world, &reset, &mut parser, person, &mut events, &mut []);
    let account = ran.expect("the simulator works");
    let left = world.observe().map(|scene| parser.parse(&scene).expect("a state")).expect("the simulator works");
    assert_eq!(account.solved(), left.satisfies(&task.goal), "{}: the world agrees with the account", task.name);
    assert_eq!(account.solved(), account.plan.is_some(), "{}: solved by a plan", task.name);
    assert_eq!(account.actions as usize, world.told.len() - told, "{}: every action is accounted for", task.name);
    let count = |wanted: fn(&Event) -> bool| events.iter().filter(|event| wanted(event)).count();
    assert_eq!(account.proposals as usize, count(|e| matches!(e, Event::Proposed { .. })), "{}", task.name);
    let excluded: usize = account.failures.iter().map(|failure| failure.suspects.len()).sum();
    assert_eq!(excluded, count(|e| matches!(e, Event::Excluded { .. })), "{}", task.name);
    assert_eq!(1, count(|e| matches!(e, Event::Ended { .. })), "{}", task.name);
    let (experience, instance) = (episode.experience().clone(), episode.instance().clone());
    Ran { account, experience, instance, events, left }
}

/// Approves every plan.
pub fn approve(_: &Plan) -> Confirmation {
    Confirmation::Approve
}
