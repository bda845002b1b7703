//! Episodes that are saved and restored: at whatever point, the commands are the same as without, and what cannot be restored
//! is refused.

use std::collections::BTreeSet;
use std::sync::Arc;

use typelift::agent::{Command, EPISODE_FORMAT, Episode, Experience, Input, Options, RestoreError};
use typelift::imagine;
use typelift::model::{ActionModel, Budget, ParseConfig, Symbol};
use typelift::world::{Parser, Reset, Scene, World};
use typelift_kitchen::{KitchenTask, faults, tasks};
use typelift_tests::schema::Schema;
use typelift_tests::{Watched, kitchen_model, paper_options};

/// The agent that goes on from where it is, which imagines.
fn going_on() -> Options {
    Options { imagine: Some(imagine::Options::default()), ..Options::default() }
}

/// The commands of an episode in a watched kitchen, as text. Before each input, `saved` may put the episode away and take
/// it out again; another plan is asked for once for each plan that rests on imagination.
fn commands(task: &KitchenTask, options: &Options, saved: impl Fn(Episode, usize) -> Episode) -> Vec<String> {
    let model = Arc::new(kitchen_model(false));
    let mut parser = Parser::new(model.hierarchy.clone(), ParseConfig::default());
    let mut world = Watched::new();
    let reset = Reset { seed: 1, scenario: Some(task.scenario.clone()) };
    let budget = Budget::with_expansions(20_000);
    let mut episode = Episode::new(model, task.goal.clone(), options.clone(), Experience::new(), budget);
    let mut state = |scene: &Scene| parser.parse(scene).expect("a state");
    let (mut all, mut asked, mut input) = (Vec::new(), BTreeSet::new(), Input::Started);
    loop {
        episode = saved(episode, all.len());
        let command = episode.step(input, &mut ()).expect("the planner does not err");
        all.push(format!("{command:?}"));
        input = match command {
            Command::Reset { id } => {
                let scene = world.reset(&reset).expect("a room");
                Input::Reset { id, state: state(&scene), instance: Some(Symbol::new("kitchen")) }
            }
            Command::Observe { id } | Command::Await { id, .. } => {
                Input::Observation { id, state: state(&world.observe().expect("a room")) }
            }
            Command::Propose { id, plan } if plan.imagined_steps() > 0 && asked.insert(id) => Input::AnotherPlan { id },
            Command::Propose { id, .. } => Input::Approve { id },
            Command::Act { id, call } => {
                let acted = world.act(&call).expect("a room");
                match acted.reason.filter(|_| !acted.executed) {
                    Some(reason) => Input::Refused { id, reason, state: state(&acted.scene) },
                    None => Input::Observation { id, state: state(&acted.scene) },
                }
            }
            Command::Done(_) => return all,
        };
    }
}

#[test]
fn saving_and_restoring_changes_no_command() {
    let model = Arc::new(kitchen_model(false));
    let schema = Schema::named("episode");
    for task in faults() {
        for options in [paper_options(true), going_on()] {
            let restored = |episode: Episode| {
                let (text, budget) = (episode.save(), Budget::with_expansions(20_000));
                let json = serde_json::from_str(&text).expect("JSON");
                assert_eq!(schema.check(&json), Ok(()), "{}", task.name);
                let again = Episode::restore(&text, Arc::clone(&model), options.clone(), budget).expect("it was saved");
                assert_eq!(again.save(), text, "{}", task.name);
                again
            };
            let plain = commands(&task, &options, |episode, _| episode);
            let context = format!("{}, restart {}", task.name, options.restart);
            assert_eq!(commands(&task, &options, |episode, _| restored(episode)), plain, "{context}: at every point");
            // At one point alone, for some of them: what is not computed again before it is computed as before.
            for at in (0..plain.len()).step_by(5) {
                let once = |episode, now| if now == at { restored(episode) } else { episode };
                assert_eq!(commands(&task, &options, once), plain, "{context}: at {at}");
            }
        }
    }
}

#[test]
fn what_cannot_be_restored_is_refused() {
    let model = Arc::new(kitchen_model(false));
    let restore = |text: &str, model: &Arc<ActionModel>| {
        Episode::restore(text, Arc::clone(model), going_on(), Budget::unlimited()).map(|_| ())
    };
    let begun = |task: &KitchenTask| {
        let mut parser = Parser::new(model.hierarchy.clone(), ParseConfig::default());
        let reset = Reset { seed: 1, scenario: Some(task.scenario.clone()) };
        let scene = Watched::new().reset(&reset).expect("a room");
        let goal = task.goal.clone();
        let mut episode = Episode::new(Arc::clone(&model), goal, going_on(), Experience::new(), Budget::unlimited());
        let Ok(Command::Reset { id }) = episode.step(Input::Started, &mut ()) else { panic!("it begins") };
        let input = Input::Reset { id, state: parser.parse(&scene).expect("a state"), instance: None };
        episode.step(input, &mut ()).expect("a plan");
        episode
    };
    let text = begun(&tasks()[0]).save();
    assert_eq!(restore(&text, &model), Ok(()));
    assert!(matches!(restore("[]", &model), Err(RestoreError::Unreadable(_))));
    assert!(matches!(restore(&text[..text.len() / 2], &model), Err(RestoreError::Unreadable(_))));
    let newer = text.replacen(EPISODE_FORMAT, "episode/9", 1);
    assert_eq!(restore(&newer, &model), Err(RestoreError::Format { found: "episode/9".to_owned() }));
    let forgetful = Arc::new(ActionModel { actions: Vec::new(), ..ActionModel::clone(&model) });
    assert!(matches!(restore(&text, &forgetful), Err(RestoreError::OtherModel(_))));
}
