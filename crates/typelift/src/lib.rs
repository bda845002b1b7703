//! Show a robot a few tasks; it plans tasks it was never shown.
//!
//! This is the crate that a user of the library depends on. The names on this page are its interface, and each appears in
//! an example below. The examples use the workshop in `examples/workshop`, where pieces of wood and metal are put into
//! machines, and a machine runs when its switch is pressed; `workshop` is the path of its folder.
//!
//! # Learn
//!
//! Demonstrations are traces: files of states with the actions between them. [`learn_dataset`] runs Algorithm 1 on them.
//!
//! ```
//! use typelift::{LearnOptions, learn_dataset, read_dataset, read_hierarchy};
//!
//! # let workshop = std::path::Path::new("../../examples/workshop/robot");
//! let types = read_hierarchy(&workshop.join("types.pddl"))?;
//! let demonstrations = read_dataset(&[workshop.into()], types, Default::default(), &Default::default())?;
//! let (learned, report) = learn_dataset(&demonstrations, &LearnOptions::default())?;
//!
//! assert_eq!(report.transitions, 30);
//! assert_eq!(learned.model.actions.len(), 8);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Save and load
//!
//! A [`LearnedModel`] is an [`ActionModel`], which is all that planning needs, with the evidence that it rests on and
//! the way in which states were read. It is saved as a whole.
//!
//! ```
//! use typelift::LearnedModel;
//!
//! # let workshop = std::path::Path::new("../../examples/workshop/robot");
//! # let types = typelift::read_hierarchy(&workshop.join("types.pddl"))?;
//! # let shown = typelift::read_dataset(&[workshop.into()], types, Default::default(), &Default::default())?;
//! # let (learned, _) = typelift::learn_dataset(&shown, &Default::default())?;
//! let text = learned.to_json()?;
//! assert_eq!(LearnedModel::from_json(&text)?, learned);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Plan, with and without imagination
//!
//! A [`Task`] is a state and a goal. [`propose`] looks for a plan and checks it. Where there is none, the proposal
//! explains why; with [`ImagineOptions`] it first imagines actions that were never demonstrated (Algorithm 2).
//!
//! ```
//! use typelift::{Budget, Explanation, ImagineOptions, Options, Outcome, Parser, Restrictions, propose, read_task};
//!
//! # let workshop = std::path::Path::new("../../examples/workshop/robot");
//! # let types = typelift::read_hierarchy(&workshop.join("types.pddl"))?;
//! # let shown = typelift::read_dataset(&[workshop.into()], types, Default::default(), &Default::default())?;
//! # let (learned, _) = typelift::learn_dataset(&shown, &Default::default())?;
//! let model = &learned.model;
//! let mut parser = Parser::new(model.hierarchy.clone(), learned.parse.clone());
//! let task = read_task(&workshop.join("cut-a-rod.json"))?.task(&mut parser, &model.predicates)?;
//! let (nothing_avoided, no_limits) = (Restrictions::default(), Budget::unlimited());
//!
//! let proposal = propose(model, &task, &nothing_avoided, &Options::default(), &no_limits)?;
//! assert_eq!(proposal.outcome, Outcome::Unsolvable); // only wood was ever cut, and a rod is of metal
//! let why = proposal.explain();
//! assert!(matches!(why, Explanation::Unreachable(_)));
//! assert!(why.to_string().contains("rod_1 is of type rod, not wooden"));
//!
//! let imagining = Options { imagine: Some(ImagineOptions::default()), ..Options::default() };
//! let proposal = propose(model, &task, &nothing_avoided, &imagining, &no_limits)?;
//! let Outcome::Solved(plan) = proposal.outcome else { panic!("no plan") };
//! assert_eq!(plan.imagined_steps(), 1);
//! assert_eq!(plan.steps[2].call.to_string(), "press(robot_1, switch_3)");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Check a plan
//!
//! [`check()`] replays a [`Plan`] as the planner gives it, [`validate`] one that names its steps by [`GroundCall`]s, as plan
//! files do. Neither shares any code with the planner.
//!
//! ```
//! use typelift::{GroundCall, Plan, check, validate};
//!
//! # let domain = typelift::DomainFile::from_text("d".as_ref(), "(define (domain d) (:predicates (on))
//! #     (:action press :parameters () :effect (on)))".to_owned())?;
//! # let (model, task) = domain.problem_from_text("p".as_ref(), "(define (problem p) (:domain d) (:init) (:goal (on)))")?;
//! let press = GroundCall { name: "press".into(), args: vec![] };
//! let valid = validate(&model, &task, &[press]).map_err(|(_, invalid)| invalid)?;
//! assert!(check(&model, &task, &valid.plan).is_ok());
//! let error = check(&model, &task, &Plan::default()).unwrap_err();
//! assert_eq!(error.to_string(), "the goal on() does not hold in the end");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Run an episode in a world of your own
//!
//! A [`World`] is set up, observed and acted in. [`run`] drives an [`Episode`] over it: propose, act, compare what
//! happened with what was expected, exclude what failed, plan again. What was found out is the [`Experience`] that the
//! next episode begins with. With a [`Recorder`], each step is written down as it happens, for learning.
//!
//! ```
//! use typelift::{
//!     Acted, Budget, Confirmation, Ending, Episode, Event, Experience, GroundAtom, GroundCall, LearnOptions, Options,
//!     Parser, Recorder, Reset, Scene, TraceHeader, World, WorldError, evidence_of, learn_evidence, read_dataset, run,
//! };
//!
//! /// A lamp that a switch turns on.
//! struct Room {
//!     lit: bool,
//! }
//!
//! impl World for Room {
//!     fn name(&self) -> String {
//!         "a room".to_owned()
//!     }
//!     fn reset(&mut self, _: &Reset) -> Result<Scene, WorldError> {
//!         self.lit = false;
//!         self.observe()
//!     }
//!     fn observe(&mut self) -> Result<Scene, WorldError> {
//!         let lamp = serde_json::json!({"id": "lamp_1", "type": "lamp", "attributes": {"lit": self.lit}});
//!         let scene = serde_json::from_value(serde_json::json!({"entities": [lamp]}));
//!         scene.map_err(|error| WorldError::Failed { account: error.to_string() })
//!     }
//!     fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError> {
//!         self.lit |= call.name == *"switch";
//!         Ok(Acted { scene: self.observe()?, executed: true, reason: None })
//!     }
//! }
//!
//! # let shown = tempfile::tempdir()?;
//! # let shown = shown.path();
//! # let folder = tempfile::tempdir()?;
//! # let folder = folder.path();
//! let types = typelift::model::Hierarchy::from_edges([("lamp", "object")])?;
//! let (mut world, reset) = (Room { lit: false }, Reset::default());
//!
//! // Show it once, by hand, and learn from that.
//! let switch = GroundCall { name: "switch".into(), args: vec!["lamp_1".into()] };
//! let mut recorder = Recorder::new(shown, "shown", TraceHeader::default());
//! recorder.begin(&world.reset(&reset)?)?;
//! recorder.step(&switch.clone().into(), &world.act(&switch)?.scene)?;
//! let demonstrations = read_dataset(&[shown.into()], types, Default::default(), &Default::default())?;
//! let mut evidence = evidence_of(&demonstrations);
//! let options = LearnOptions::default();
//! let (learned, _) = learn_evidence(&demonstrations.hierarchy, &demonstrations.parse, evidence.clone(), &options)?;
//!
//! // Let it act, and write down what happens.
//! let goal = vec![GroundAtom::parse("lit(lamp_1)")?];
//! let model = std::sync::Arc::new(learned.model);
//! let mut parser = Parser::new(model.hierarchy.clone(), learned.parse);
//! let mut episode = Episode::new(model, goal, Options::default(), Experience::new(), Budget::unlimited());
//! let mut approve = |_: &typelift::Plan| Confirmation::Approve;
//! let mut events: Vec<Event> = Vec::new();
//! let mut recorder = Recorder::new(folder, "acted", TraceHeader::default());
//! let account = run(&mut episode, &mut world, &reset, &mut parser, &mut approve, &mut events, &mut [&mut recorder])?;
//! assert_eq!(account.ending, Ending::Solved);
//! assert!(matches!(events.last(), Some(Event::Ended { solved: true, .. })));
//!
//! // Learn from that as well.
//! let acted = read_dataset(&[folder.into()], demonstrations.hierarchy, Default::default(), &Default::default())?;
//! evidence.merge(&evidence_of(&acted))?;
//! let (_, report) = learn_evidence(&acted.hierarchy, &acted.parse, evidence, &options)?;
//! assert_eq!(report.transitions, 2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Drive an episode yourself
//!
//! An [`Episode`] has no thread, clock or world of its own. A page, a notebook or a robot's own loop does what each
//! [`Command`] says, and answers with an [`Input`] that names the command.
//!
//! ```
//! use typelift::{Budget, Command, Episode, Experience, GroundAtom, Input, Options, Parser, Scene};
//!
//! # let domain = typelift::DomainFile::from_text("d".as_ref(), "(define (domain d) (:predicates (on))
//! #     (:action press :parameters () :effect (on)))".to_owned())?;
//! # let model = std::sync::Arc::new(domain.model);
//! let goal = vec![GroundAtom::parse("on()")?];
//! let mut parser = Parser::new(model.hierarchy.clone(), Default::default());
//! let mut observe = |text| parser.parse(&serde_json::from_str::<Scene>(text).expect("a scene"));
//! let mut episode = Episode::new(model, goal, Options::default(), Experience::new(), Budget::unlimited());
//!
//! let Command::Reset { id } = episode.step(Input::Started, &mut ())? else { panic!() };
//! let state = observe(r#"{"objects": {}, "atoms": []}"#)?;
//! let Command::Propose { id, plan } = episode.step(Input::Reset { id, state, instance: None }, &mut ())? else {
//!     panic!()
//! };
//! assert_eq!(plan.len(), 1);
//! let Command::Act { id, call } = episode.step(Input::Approve { id }, &mut ())? else { panic!() };
//! assert_eq!(call.to_string(), "press()");
//! let state = observe(r#"{"objects": {}, "atoms": ["on()"]}"#)?;
//! let Command::Done(account) = episode.step(Input::Observation { id, state }, &mut ())? else { panic!() };
//! assert!(account.solved());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # PDDL in and out
//!
//! A [`DomainFile`] reads a domain and its problems; [`export`] writes a model and a task for other planners.
//!
//! ```
//! use typelift::{ActionModel, Budget, DomainFile, ExportOptions, Options, Task, export, propose};
//!
//! let domain = DomainFile::from_text(
//!     "blocks".as_ref(),
//!     "(define (domain blocks)
//!        (:types block)
//!        (:predicates (on-table ?b - block) (held ?b - block))
//!        (:action pick :parameters (?b - block) :precondition (on-table ?b)
//!          :effect (and (held ?b) (not (on-table ?b)))))"
//!         .to_owned(),
//! )?;
//! let (model, task): (ActionModel, Task) = domain.problem_from_text(
//!     "one".as_ref(),
//!     "(define (problem one) (:domain blocks) (:objects a - block) (:init (on-table a)) (:goal (held a)))",
//! )?;
//! let proposal = propose(&model, &task, &Default::default(), &Options::default(), &Budget::with_expansions(1_000))?;
//! assert_eq!(proposal.outcome.word(), "solved");
//!
//! let options = ExportOptions { domain: "blocks".into(), problem: "one".into(), level: Default::default() };
//! let exported = export(&model, Some(&task), &options)?;
//! assert!(exported.domain.to_string().contains("(:action pick"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Show what came of it
//!
//! [`AnswerView`] and [`AccountView`] are what the command line prints with `--json`. What it says to people is in
//! [`words`].
//!
//! ```
//! use typelift::{AccountView, AnswerView};
//!
//! # use typelift::{Budget, Episode, Experience, Input, Command, Outcome, propose, Options};
//! # let domain = typelift::DomainFile::from_text("d".as_ref(), "(define (domain d) (:predicates (on))
//! #     (:action press :parameters () :effect (on)))".to_owned())?;
//! # let (model, task) = domain.problem_from_text("p".as_ref(), "(define (problem p) (:domain d) (:init) (:goal (on)))")?;
//! # let proposal = propose(&model, &task, &Default::default(), &Options::default(), &Budget::unlimited())?;
//! # let Outcome::Solved(plan) = proposal.outcome.clone() else { panic!() };
//! let answer = AnswerView::of(&proposal, &[plan], &proposal.outcome, 0, 0.0);
//! assert_eq!(serde_json::to_value(&answer)?["outcome"], "solved");
//!
//! # let mut episode = Episode::new(model.into(), task.goal, Options::default(), Experience::new(), Budget::unlimited());
//! # let Command::Done(account) = episode.step(Input::Stop, &mut ())? else { panic!() };
//! let view = AccountView::of("press it", &account, &episode, 0.0);
//! assert_eq!(serde_json::to_value(&view)?["solved"], false);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What lies deeper
//!
//! The crates that these names come from are modules here. They hold the types of fields and results, and the parts that
//! the laboratory and the command line take apart: a single step of learning, a search, a heuristic's counts.
//!
//! | module      | what it holds                                                                    |
//! |-------------|----------------------------------------------------------------------------------|
//! | [`model`]   | the vocabulary: types, atoms, states, actions, models, tasks, plans               |
//! | [`world`]   | snapshots and how they become states, traces, tasks, environments, their protocol |
//! | [`pddl`]    | PDDL types, domains and trajectories                                              |
//! | [`learn`]   | Algorithm 1: individual and type-generalized actions from demonstrations          |
//! | [`imagine`] | Algorithm 2: imagined actions for goals that cannot be reached                    |
//! | [`plan`]    | grounding, landmarks, heuristic search, why there is no plan                      |
//! | [`belief`]  | how likely a call works, and what speaks against it                               |
//! | [`check`](mod@check) | replays plans by the plainest semantics                                  |
//! | [`agent`]   | an episode: propose, act, monitor, exclude, retry, replan                         |
//! | [`words`]   | what is said of plans, answers, accounts and events, for people and programs      |
//! | [`bridge`]  | an environment or a planner in a child process                                    |
#![deny(missing_docs)]

#[cfg(feature = "schema")]
mod schemas;

#[cfg(feature = "schema")]
pub use schemas::schemas;

#[doc(inline)]
pub use typelift_agent::{Command, Confirmation, Ending, Episode, Event, Experience, Input, Options, propose, run};
#[doc(inline)]
pub use typelift_check::{check, validate};
#[doc(inline)]
pub use typelift_imagine::Options as ImagineOptions;
#[doc(inline)]
pub use typelift_learn::{Options as LearnOptions, evidence_of, learn_dataset, learn_evidence};
#[doc(inline)]
pub use typelift_model::{ActionModel, Budget, GroundAtom, GroundCall, LearnedModel, Plan, Task};
#[doc(inline)]
pub use typelift_pddl::{ExportOptions, export};
#[doc(inline)]
pub use typelift_plan::{Explanation, Outcome, Restrictions};
#[doc(inline)]
pub use typelift_words::{AccountView, AnswerView};
#[doc(inline)]
pub use typelift_world::{
    Acted, DomainFile, Parser, Recorder, Reset, Scene, TraceHeader, World, WorldError, read_dataset, read_hierarchy,
    read_task,
};

pub use typelift_agent as agent;
pub use typelift_belief as belief;
pub use typelift_bridge as bridge;
pub use typelift_check as check;
pub use typelift_imagine as imagine;
pub use typelift_learn as learn;
pub use typelift_model as model;
pub use typelift_pddl as pddl;
pub use typelift_plan as plan;
pub use typelift_words as words;
pub use typelift_world as world;
