//! The episode's state machine, fed by hand: what it answers to observations, refusals, time-outs, rejections, and to
//! inputs that do not fit. A saw cuts rods and planks; there are two saws, and a beam.

use std::collections::BTreeSet;
use std::sync::Arc;
use typelift::agent::{Account, Command, Ending, Episode, Experience, Input, Options, StepResult};
use typelift::learn::{evidence_of, learn};
use typelift::model::{ActionModel, Budget, GroundAtom, GroundCall, Hierarchy, ParseConfig, Plan, State, Stop, Symbol};
use typelift::plan::Exclusion;
use typelift::world::{Dataset, Parser, Scene, Trace, TraceAction, Verdict};

fn failed_calls(account: &Account) -> Vec<String> {
    account.failures.iter().map(|failure| failure.call.to_string()).collect()
}

fn has_reason(ending: &Ending) -> bool {
    matches!(ending, Ending::NoPlan(why) if !why.to_string().is_empty())
}

fn saws() -> (Arc<ActionModel>, Parser) {
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
    let learned = learn(&hierarchy, &evidence_of(&shown), &Default::default()).expect("a model");
    (Arc::new(learned.model), parser)
}

fn cut(saw: &str, it: &str) -> GroundCall {
    GroundCall { name: Symbol::new("cut"), args: vec![Symbol::new(saw), Symbol::new(it)] }
}

fn bench(parser: &mut Parser, objects: &[(&str, &str)], atoms: &[&str]) -> State {
    let objects = objects.iter().map(|(o, t)| (Symbol::new(o), Symbol::new(t))).collect();
    let atoms = atoms.iter().map(|atom| GroundAtom::parse(atom).expect("an atom")).collect();
    parser.parse(&Scene::Symbolic { objects, atoms, unknown: BTreeSet::new() }).expect("a state")
}

/// An episode with a beam and two saws, and the states in which the beam is whole and cut.
struct ByHand {
    episode: Episode,
    whole: State,
    cut: State,
    parser: Parser,
}

const BENCH: [(&str, &str); 3] = [("saw_1", "saw"), ("saw_2", "saw"), ("b", "beam")];

impl ByHand {
    fn new(options: Options) -> Self {
        let (model, mut parser) = saws();
        let goal = vec![GroundAtom::parse("cut(b)").expect("an atom")];
        let episode = Episode::new(model, goal, options, Experience::new(), Budget::unlimited());
        let (whole, cut) = (bench(&mut parser, &BENCH, &["whole(b)"]), bench(&mut parser, &BENCH, &["cut(b)"]));
        Self { episode, whole, cut, parser }
    }

    /// One that has started to cut with the first saw.
    fn cutting(options: Options) -> Self {
        let mut this = Self::new(options);
        assert_eq!(this.step(Input::Started), Command::Reset);
        let whole = this.whole.clone();
        assert_eq!(this.proposed(Input::Observation(whole)), [cut("saw_1", "b")]);
        assert_eq!(this.step(Input::Approve), Command::Act(cut("saw_1", "b")));
        this
    }

    fn step(&mut self, input: Input) -> Command {
        self.episode.step(input, &mut ()).expect("the planner does not err")
    }

    fn proposed(&mut self, input: Input) -> Vec<GroundCall> {
        match self.step(input) {
            Command::Propose(plan) => plan.steps.into_iter().map(|step| step.call).collect(),
            other => panic!("{other:?}"),
        }
    }

    fn done(&mut self, input: Input) -> Account {
        match self.step(input) {
            Command::Done(account) => *account,
            other => panic!("{other:?}"),
        }
    }

    fn refused(&self) -> Input {
        Input::Refused { reason: "jammed".to_owned(), state: self.whole.clone() }
    }
}

#[test]
fn a_goal_that_holds_needs_nothing() {
    let mut it = ByHand::new(Options::default());
    assert_eq!(it.step(Input::Started), Command::Reset);
    let cut = it.cut.clone();
    let account = it.done(Input::Observation(cut));
    assert!(account.solved() && account.proposals == 0 && account.plan == Some(Plan::default()));
}

#[test]
fn a_refusal_is_tried_again_then_blamed() {
    let mut it = ByHand::cutting(Options::default());
    let refused = it.refused();
    assert_eq!(it.step(refused.clone()), Command::Act(cut("saw_1", "b")), "once more");
    assert_eq!(it.proposed(refused), [cut("saw_2", "b")]);
    assert_eq!(it.step(Input::Approve), Command::Act(cut("saw_2", "b")));
    let after = it.cut.clone();
    let account = it.done(Input::Observation(after));
    assert!(account.solved());
    assert_eq!((account.proposals, account.actions), (2, 3));
    let [failure] = account.failures.as_slice() else { panic!("{:?}", account.failures) };
    assert_eq!((failure.result, failure.reason.as_deref()), (StepResult::Tried(Verdict::Refused), Some("jammed")));
    let blamed = Exclusion { object: Symbol::new("saw_1"), call: Some(Symbol::new("cut")) };
    assert_eq!(failure.excluded, [blamed]);
    let (_, why) = it.episode.experience().exclusions().next().expect("one");
    assert_eq!((why.reason.as_str(), why.count), ("cut(saw_1, b) jammed", 1));
}

#[test]
fn when_every_saw_is_jammed_it_ends_with_a_reason() {
    for restart in [true, false] {
        let mut it = ByHand::cutting(Options { restart, retries: Some(0), ..Options::default() });
        let (refused, whole) = (it.refused(), it.whole.clone());
        if restart {
            assert_eq!(it.step(refused.clone()), Command::Reset);
            assert_eq!(it.proposed(Input::Observation(whole.clone())), [cut("saw_2", "b")]);
        } else {
            assert_eq!(it.proposed(refused.clone()), [cut("saw_2", "b")]);
        }
        assert_eq!(it.step(Input::Approve), Command::Act(cut("saw_2", "b")));
        let account = if restart {
            assert_eq!(it.step(refused), Command::Reset);
            it.done(Input::Observation(whole))
        } else {
            it.done(refused)
        };
        assert_eq!(failed_calls(&account), ["cut(saw_1, b)", "cut(saw_2, b)"]);
        let Ending::NoPlan(why) = &account.ending else { panic!("{:?}", account.ending) };
        assert!(why.to_string().contains("there is no saw that may be used"), "{why}");
    }
}

#[test]
fn the_state_is_believed_not_the_refusal() {
    let mut it = ByHand::cutting(Options::default());
    let state = it.cut.clone();
    let account = it.done(Input::Refused { reason: "I think it went wrong".to_owned(), state });
    assert!(account.solved() && account.failures.is_empty());
}

#[test]
fn after_a_time_out_it_looks() {
    // It had worked.
    let mut it = ByHand::cutting(Options::default());
    assert_eq!(it.step(Input::TimedOut), Command::Observe);
    assert_eq!(it.step(Input::TimedOut), Command::Observe, "until something is seen");
    let cut_state = it.cut.clone();
    assert!(it.done(Input::Observation(cut_state)).solved());

    // It had not: tried again, then blamed.
    let mut it = ByHand::cutting(Options::default());
    let whole = it.whole.clone();
    assert_eq!(it.step(Input::TimedOut), Command::Observe);
    assert_eq!(it.step(Input::Observation(whole.clone())), Command::Act(cut("saw_1", "b")));
    assert_eq!(it.step(Input::TimedOut), Command::Observe);
    assert_eq!(it.proposed(Input::Observation(whole)), [cut("saw_2", "b")]);
    let account = it.done(Input::Stop);
    assert_eq!(account.ending, Ending::Stopped(Stop::Cancelled));
    assert_eq!(account.failures.iter().map(|f| f.result).collect::<Vec<_>>(), [StepResult::Tried(Verdict::TimedOut)]);
    assert_eq!(account.actions, 2);
}

#[test]
fn a_rejection_before_anything_was_done_needs_no_reset() {
    for restart in [true, false] {
        let mut it = ByHand::new(Options { restart, ..Options::default() });
        let whole = it.whole.clone();
        it.step(Input::Started);
        assert_eq!(it.proposed(Input::Observation(whole)), [cut("saw_1", "b")]);
        let reject = |step| Input::Reject { step, reason: "blunt".to_owned() };
        // A step that there is not counts as the nearest that there is.
        assert_eq!(it.proposed(reject(99)), [cut("saw_2", "b")]);
        let account = it.done(reject(0));
        assert!(has_reason(&account.ending));
        assert_eq!((account.actions, account.failures.len()), (0, 2));
    }
}

#[test]
fn inputs_that_do_not_fit_change_nothing() {
    let mut it = ByHand::new(Options::default());
    let (whole, after) = (it.whole.clone(), it.cut.clone());
    assert_eq!(it.step(Input::Observation(after.clone())), Command::Reset, "nothing is believed before the start");
    assert_eq!(it.step(Input::Approve), Command::Reset);
    assert_eq!(it.step(Input::TimedOut), Command::Reset, "a slow reset is no initial state");
    let plan = it.proposed(Input::Observation(whole));
    assert_eq!(it.proposed(Input::Observation(after.clone())), plan);
    assert_eq!(it.proposed(Input::TimedOut), plan);
    assert_eq!(it.step(Input::Approve), Command::Act(cut("saw_1", "b")));
    assert_eq!(it.step(Input::Approve), Command::Observe, "approved twice is not executed twice");
    let account = it.done(Input::Observation(after));
    assert!(account.solved());
    assert_eq!(account.actions, 1);
    for input in [Input::Started, Input::Approve, Input::TimedOut] {
        assert_eq!(it.done(input), account, "what is over stays over");
    }
}

#[test]
fn objects_come_and_go() {
    let mut it = ByHand::cutting(Options::default());
    // The saw at work vanishes, a cat arrives.
    let objects = [("saw_2", "saw"), ("b", "beam"), ("cat_1", "cat")];
    let state = bench(&mut it.parser, &objects, &["whole(b)"]);
    assert_eq!(it.proposed(Input::Observation(state)), [cut("saw_2", "b")]);
    assert_eq!(it.step(Input::Approve), Command::Act(cut("saw_2", "b")));
    // Then the beam does.
    let state = bench(&mut it.parser, &[("saw_2", "saw")], &[]);
    let account = it.done(Input::Observation(state));
    assert!(has_reason(&account.ending), "{:?}", account.ending);
}

#[test]
fn the_number_of_proposals_is_limited() {
    let mut it = ByHand::cutting(Options { max_proposals: 1, retries: Some(0), ..Options::default() });
    let refused = it.refused();
    assert_eq!(it.done(refused).ending, Ending::ProposalLimit(1));
}

#[test]
fn a_changed_mind_about_the_ending_is_not_recorded() {
    let mut it = ByHand::cutting(Options::default());
    let after = it.cut.clone();
    assert!(it.done(Input::Observation(after)).solved());
    let (episode, account) = (&mut it.episode, Ending::Solved);
    let Ok(Command::Done(again)) = episode.step(Input::Stop, &mut ()) else { panic!("it is over") };
    assert_eq!(again.ending, account, "stopping what is solved does not unsolve it");
}
