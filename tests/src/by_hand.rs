//! An episode fed by hand: a saw cuts rods and planks; there are two saws, and a beam.

use std::collections::BTreeSet;
use std::sync::Arc;

use typelift::agent::{Account, Command, CommandId, Episode, Event, Experience, Input, Objection, Options};
use typelift::learn::{evidence_of, learn};
use typelift::model::{ActionModel, Budget, GroundAtom, GroundCall, Hierarchy, ParseConfig, State, Symbol};
use typelift::world::{Dataset, Parser, Scene, Trace, TraceAction};

/// A model in which saws cut pieces, learned from a rod and a plank, and what reads its scenes.
pub fn saws() -> (Arc<ActionModel>, Parser) {
    let edges = [("rod", "piece"), ("plank", "piece"), ("beam", "piece"), ("saw", "machine"), ("cat", "guest")];
    let hierarchy = Hierarchy::from_edges(edges).expect("a tree");
    let mut parser = Parser::new(hierarchy.clone(), ParseConfig::default());
    let mut shown = Dataset { hierarchy: hierarchy.clone(), ..Dataset::default() };
    for kind in ["rod", "plank"] {
        let mut scene = |atom: &str| {
            let objects = [("saw_1", "saw"), ("it", kind)].map(|(o, t)| (Symbol::new(o), Symbol::new(t))).into();
            let atoms = [GroundAtom::new(atom, vec![Symbol::new("it")])].into();
            parser.parse(&Scene::Symbolic { objects, atoms, unknown: BTreeSet::new() }).expect("a state")
        };
        let states = vec![scene("whole"), scene("cut")];
        let call = cut("saw_1", "it");
        let actions = vec![TraceAction::from(call)];
        shown.traces.push(Trace { states, actions, ..Trace::default() });
    }
    let learned = learn(&hierarchy, &evidence_of(&shown).total(), &Default::default()).expect("a model");
    (Arc::new(learned.model), parser)
}

/// A model of a hand that puts things anywhere, also upon each other, and what reads its scenes. Its types have nothing in
/// common, so that things and places are of any type.
pub fn hands() -> (Arc<ActionModel>, Parser) {
    let edges = ["hand", "cup", "lid", "table"].map(|ty| (ty, "object"));
    let hierarchy = Hierarchy::from_edges(edges).expect("a tree");
    let mut parser = Parser::new(hierarchy.clone(), ParseConfig::default());
    let mut shown = Dataset { hierarchy: hierarchy.clone(), ..Dataset::default() };
    for [thing, from, to] in [["cup_1", "table_1", "lid_1"], ["lid_1", "cup_1", "table_1"]] {
        let objects = [("hand_1", "hand"), ("cup_1", "cup"), ("lid_1", "lid"), ("table_1", "table")];
        let on = |place: &str| format!("on({thing},{place})");
        let states = [["empty(hand_1)".to_owned(), on(from)], ["empty(hand_1)".to_owned(), on(to)]];
        let held = bench(&mut parser, &objects, &[&format!("holds(hand_1,{thing})")]);
        let [before, after] = states.map(|[empty, on]| bench(&mut parser, &objects, &[&empty, &on]));
        let call = |name: &str, place: &str| {
            let args = ["hand_1", thing, place].map(Symbol::new).to_vec();
            TraceAction::from(GroundCall { name: Symbol::new(name), args })
        };
        let (states, actions) = (vec![before, held, after], vec![call("grasp", from), call("drop", to)]);
        shown.traces.push(Trace { states, actions, ..Trace::default() });
    }
    let learned = learn(&hierarchy, &evidence_of(&shown).total(), &Default::default()).expect("a model");
    (Arc::new(learned.model), parser)
}

/// The call of a saw that cuts something.
pub fn cut(saw: &str, it: &str) -> GroundCall {
    GroundCall { name: Symbol::new("cut"), args: vec![Symbol::new(saw), Symbol::new(it)] }
}

/// A state: objects with their types, and the atoms that hold.
pub fn bench(parser: &mut Parser, objects: &[(&str, &str)], atoms: &[&str]) -> State {
    let objects = objects.iter().map(|(o, t)| (Symbol::new(o), Symbol::new(t))).collect();
    let atoms = atoms.iter().map(|atom| GroundAtom::parse(atom).expect("an atom")).collect();
    parser.parse(&Scene::Symbolic { objects, atoms, unknown: BTreeSet::new() }).expect("a state")
}

/// An episode with a beam and two saws, and the states in which the beam is whole and cut.
#[derive(Debug)]
pub struct ByHand {
    /// The episode.
    pub episode: Episode,
    /// The last command.
    pub command: Command,
    /// What it told.
    pub events: Vec<Event>,
    /// The beam is whole.
    pub whole: State,
    /// The beam is cut.
    pub cut: State,
    /// Reads scenes.
    pub parser: Parser,
}

/// Two saws and a beam.
pub const BENCH: [(&str, &str); 3] = [("saw_1", "saw"), ("saw_2", "saw"), ("b", "beam")];

/// A command in words.
pub fn told(command: &Command) -> String {
    match command {
        Command::Reset { .. } => "reset".to_owned(),
        Command::Observe { .. } => "observe".to_owned(),
        Command::Propose { plan, .. } => {
            let calls: Vec<String> = plan.steps.iter().map(|step| step.call.to_string()).collect();
            format!("propose {}", calls.join(" "))
        }
        Command::Act { call, .. } => format!("act {call}"),
        Command::Await { call, .. } => format!("await {call}"),
        Command::Done(account) => format!("done, {}", account.ending.word()),
    }
}

/// The id of a command; of the last one none.
pub fn id(command: &Command) -> CommandId {
    match command {
        Command::Reset { id }
        | Command::Observe { id }
        | Command::Propose { id, .. }
        | Command::Act { id, .. }
        | Command::Await { id, .. } => *id,
        Command::Done(_) => CommandId::default(),
    }
}

impl ByHand {
    /// One that asks for a reset.
    pub fn new(options: Options) -> Self {
        Self::within(options, Budget::unlimited())
    }

    /// One that asks for a reset and may spend so much.
    pub fn within(options: Options, budget: Budget) -> Self {
        Self::at(&BENCH, &["b"], options, budget)
    }

    /// One that asks for a reset, with these objects, of which those beams are to be cut.
    pub fn at(objects: &[(&str, &str)], beams: &[&str], options: Options, budget: Budget) -> Self {
        let (model, mut parser) = saws();
        let all = |predicate: &str| beams.iter().map(|beam| format!("{predicate}({beam})")).collect::<Vec<_>>();
        let goal: Vec<_> = all("cut").iter().map(|atom| GroundAtom::parse(atom).expect("an atom")).collect();
        let mut episode = Episode::new(model, goal, options, Experience::new(), budget);
        let mut state = |predicate: &str| {
            let atoms = all(predicate);
            bench(&mut parser, objects, &atoms.iter().map(String::as_str).collect::<Vec<_>>())
        };
        let (whole, cut) = (state("whole"), state("cut"));
        let command = episode.step(Input::Started, &mut ()).expect("nothing was planned");
        assert_eq!(told(&command), "reset");
        Self { episode, command, events: Vec::new(), whole, cut, parser }
    }

    /// One to which a plan was proposed.
    pub fn asked(options: Options) -> Self {
        let mut this = Self::new(options);
        let whole = this.whole.clone();
        assert_eq!(this.reset(whole), "propose cut(saw_1, b)");
        this
    }

    /// One that has started to cut with the first saw.
    pub fn cutting(options: Options) -> Self {
        let mut this = Self::asked(options);
        assert_eq!(this.approve(), "act cut(saw_1, b)");
        this
    }

    /// Takes an input, whatever stands.
    pub fn input(&mut self, input: Input) -> String {
        self.command = self.episode.step(input, &mut self.events).expect("the planner does not err");
        told(&self.command)
    }

    /// Answers the last command.
    pub fn answer(&mut self, input: impl FnOnce(CommandId) -> Input) -> String {
        self.input(input(id(&self.command)))
    }

    /// The world was reset to this state.
    pub fn reset(&mut self, state: State) -> String {
        self.answer(|id| Input::Reset { id, state, instance: None })
    }

    /// This is observed.
    pub fn observed(&mut self, state: State) -> String {
        self.answer(|id| Input::Observation { id, state })
    }

    /// The plan is approved.
    pub fn approve(&mut self) -> String {
        self.answer(|id| Input::Approve { id })
    }

    /// Another plan is wanted.
    pub fn another_plan(&mut self) -> String {
        self.answer(|id| Input::AnotherPlan { id })
    }

    /// The action was not finished in time.
    pub fn timed_out(&mut self) -> String {
        self.answer(|id| Input::TimedOut { id })
    }

    /// The action was refused, and the beam is whole.
    pub fn refused(&mut self) -> String {
        let state = self.whole.clone();
        self.answer(|id| Input::Refused { id, reason: "jammed".to_owned(), state })
    }

    /// A step is rejected.
    pub fn reject(&mut self, step: usize, objection: Option<Objection>) -> String {
        self.answer(|id| Input::Reject { id, step, objection, reason: "blunt".to_owned() })
    }

    /// The account, at the end.
    pub fn account(&self) -> &Account {
        match &self.command {
            Command::Done(account) => account,
            other => panic!("{other:?}"),
        }
    }
}
