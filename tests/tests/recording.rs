//! What an agent did is recorded as it happened: the files say what the episode says, refusals and surprises included.

use std::path::Path;
use std::sync::Arc;

use typelift::agent::{
    Account, Command, Confirmation, Episode, Event, Experience, Failed, Input, Observer, Options, Recalled, StepResult,
    run,
};
use typelift::imagine;
use typelift::model::{ActionModel, Budget, ParseConfig, Plan};
use typelift::world::{
    Parser, Record, Recorder, Reset, Trace, TraceHeader, Transition, Verdict, World, WorldError, read_trace,
};
use typelift_kitchen::{KitchenTask, faults, hierarchy, tasks};
use typelift_lab::kitchen_model;
use typelift_tests::Watched;

/// What an episode said, in order.
#[derive(Default)]
struct Heard {
    records: Vec<Record>,
    results: Vec<StepResult>,
    /// What the run knows in the end.
    experience: Experience,
}

impl Observer for Heard {
    fn record(&mut self, record: &Record) {
        self.records.push(record.clone());
    }

    fn event(&mut self, event: &Event) {
        if let Event::Stepped { result, .. } = event {
            self.results.push(*result);
        }
    }
}

/// Runs a task and records it in a folder.
fn recorded(
    model: &Arc<ActionModel>,
    world: &mut dyn World,
    task: &KitchenTask,
    restart: bool,
    folder: &Path,
) -> (Option<Account>, Heard, Recorder) {
    let options = Options { imagine: Some(imagine::Options::default()), restart, ..Options::default() };
    let budget = Budget::with_expansions(20_000);
    let mut episode = Episode::new(Arc::clone(model), task.goal.clone(), options, Experience::new(), budget);
    let reset = Reset { seed: 0, scenario: Some(task.scenario.clone()) };
    let header = TraceHeader { task: task.name.clone(), goal: task.goal.clone().into() };
    let (mut heard, mut recorder) = (Heard::default(), Recorder::new(folder, &task.name, header));
    let mut parser = Parser::new(hierarchy(), ParseConfig::default());
    let mut approve = |_: &Plan| Confirmation::Approve;
    let ran = run(&mut episode, world, &reset, &mut parser, &mut approve, &mut heard, &mut [&mut recorder]);
    heard.experience = episode.experience().clone();
    (ran.ok(), heard, recorder)
}

/// Asserts that the files hold what was heard, and nothing else.
fn assert_same(recorder: &Recorder, heard: &Heard, name: &str) {
    let mut parser = Parser::new(hierarchy(), ParseConfig::default());
    let traces: Vec<_> = recorder.files().iter().map(|file| read_trace(file, &mut parser).expect("a trace")).collect();
    assert!(traces.iter().all(|trace| trace.warnings.is_empty()), "{name}: each is whole");
    let read: Vec<Transition<'_>> = traces.iter().flat_map(Trace::transitions).collect();
    assert_eq!(read.len(), heard.records.len(), "{name}");
    for (read, record) in read.iter().zip(&heard.records) {
        let heard = record.transition();
        assert_eq!((read.before, read.action, read.after), (heard.before, heard.action, heard.after), "{name}");
        assert!(read.action.expected.is_some() && read.action.verdict.is_some(), "{name}");
    }
    for (record, result) in heard.records.iter().zip(&heard.results) {
        let (verdict, result) = (serde_json::to_value(record.action.verdict), serde_json::to_value(result));
        assert_eq!(verdict.expect("JSON"), result.expect("JSON"), "{name}: one spelling");
    }
    let judged = heard.records.iter().filter_map(|record| record.action.verdict).map(StepResult::Tried);
    assert_eq!(judged.collect::<Vec<_>>(), heard.results, "{name}: every step has its record");
}

#[test]
fn the_files_say_what_the_episode_says() {
    let model = Arc::new(kitchen_model(false));
    let (mut failures, mut resets) = (0, 0);
    for task in faults() {
        for restart in [false, true] {
            let folder = tempfile::tempdir().expect("a folder");
            let mut world = Watched::new();
            let (account, heard, recorder) = recorded(&model, &mut world, &task, restart, folder.path());
            let account = account.expect("the simulator works");
            assert_same(&recorder, &heard, &task.name);
            // A file from reset to reset; after the last one there may be nothing to do.
            let files = recorder.files().len();
            assert!(files == world.resets || files + 1 == world.resets, "{}: {files}", task.name);
            assert_eq!(heard.records.len() as u64, account.actions, "{}", task.name);
            for failure in &account.failures {
                let number = failure.record.expect("nobody rejects anything");
                let record = heard.records.iter().find(|record| record.step == number).expect("its record");
                assert_eq!(record.action.call, failure.call, "{}", task.name);
                assert_eq!(record.action.verdict.map(StepResult::Tried), Some(failure.result), "{}", task.name);
                failures += 1;
            }
            resets += world.resets - 1;
        }
    }
    assert!(failures > 10 && resets > 5, "{failures} failures, {resets} resets");
}

#[test]
fn who_recalls_a_run_knows_what_the_run_knew() {
    let model = Arc::new(kitchen_model(false));
    let mut failures = 0;
    for (task, restart) in faults().into_iter().zip([false, true].into_iter().cycle()) {
        let folder = tempfile::tempdir().expect("a folder");
        let (account, heard, recorder) = recorded(&model, &mut Watched::new(), &task, restart, folder.path());
        account.expect("the simulator works");
        let mut parser = Parser::new(hierarchy(), ParseConfig::default());
        let mut recalled = Experience::new();
        for (number, file) in recorder.files().iter().enumerate() {
            let trace = read_trace(file, &mut parser).expect("a trace");
            let instance = &heard.experience.successes()[0].deed.instance;
            recalled.recall(&Recalled { trace: &trace, instance, goes_on: number > 0 }, &model);
        }
        assert_eq!(recalled.successes(), heard.experience.successes(), "{}", task.name);
        let known = |experience: &Experience| -> Vec<Failed> {
            let failed = experience.failures().iter().cloned();
            // What is to blame follows from all that is known; the paper's rule is not recorded.
            failed.map(|failed| Failed { suspects: Vec::new(), useless: false, ..failed }).collect()
        };
        assert_eq!(known(&recalled), known(&heard.experience), "{}", task.name);
        failures += recalled.failures().len();
    }
    assert!(failures > 10, "{failures} failures");
}

#[test]
fn what_was_done_before_an_environment_died_is_kept() {
    let model = Arc::new(kitchen_model(false));
    let task = faults().into_iter().find(|task| task.name == "broken_cutboard_lettuce").expect("a fault");
    for lived in 0..4 {
        let folder = tempfile::tempdir().expect("a folder");
        let mut acted = 0;
        let mut world = Watched::with(move |kitchen, call| {
            acted += 1;
            if acted > lived { Err(WorldError::Gone { account: "it died".to_owned() }) } else { kitchen.act(call) }
        });
        let (account, heard, recorder) = recorded(&model, &mut world, &task, false, folder.path());
        assert!(account.is_none(), "the run ends with an error");
        assert_same(&recorder, &heard, &task.name);
        assert_eq!(heard.records.len(), lived);
    }
}

#[test]
fn nothing_is_done_that_cannot_be_recorded() {
    let model = Arc::new(kitchen_model(false));
    let task = faults().into_iter().find(|task| task.name == "broken_cutboard_lettuce").expect("a fault");
    let folder = tempfile::tempdir().expect("a folder");
    let mut world = Watched::new();
    let (account, heard, _) = recorded(&model, &mut world, &task, false, &folder.path().join("missing"));
    assert!(account.is_none() && heard.records.is_empty() && world.told.is_empty());
}

#[test]
fn a_world_that_does_something_else_is_recorded_with_what_it_did() {
    let model = Arc::new(kitchen_model(false));
    let task = faults().into_iter().find(|task| task.name == "broken_cutboard_lettuce").expect("a fault");
    let folder = tempfile::tempdir().expect("a folder");
    // It says that it did what it did not do.
    let mut world = Watched::with(|kitchen, call| {
        let acted = kitchen.act(call)?;
        Ok(typelift::world::Acted { executed: true, reason: None, ..acted })
    });
    let (_, heard, recorder) = recorded(&model, &mut world, &task, false, folder.path());
    assert_same(&recorder, &heard, &task.name);
    let nothing = heard.records.iter().filter(|record| record.action.verdict == Some(Verdict::Nothing));
    assert!(nothing.clone().count() > 0 && nothing.clone().all(|record| record.action.executed == Some(true)));
}

#[test]
fn an_action_that_is_not_finished_in_time_is_recorded_with_what_is_seen_then() {
    let model = Arc::new(kitchen_model(false));
    let task = faults().into_iter().find(|task| task.name == "broken_cutboard_lettuce").expect("a fault");
    for is_done in [false, true] {
        let folder = tempfile::tempdir().expect("a folder");
        let mut is_first = true;
        let mut world = Watched::with(move |kitchen, call| {
            let late = std::mem::take(&mut is_first);
            let acted = if late && !is_done { None } else { Some(kitchen.act(call)?) };
            let in_time = acted.filter(|_| !late);
            in_time.ok_or_else(|| WorldError::TimedOut { account: "it took too long".to_owned() })
        });
        let (account, heard, recorder) = recorded(&model, &mut world, &task, false, folder.path());
        assert!(account.is_some(), "the world can be observed");
        assert_same(&recorder, &heard, &task.name);
        let action = &heard.records.first().expect("a step").action;
        let verdict = if is_done { Verdict::AsExpected } else { Verdict::TimedOut };
        assert_eq!((action.executed, action.verdict), (None, Some(verdict)));
    }
}

#[test]
fn a_restored_episode_is_recorded_from_its_next_step() {
    let model = Arc::new(kitchen_model(false));
    let task = tasks().into_iter().find(|task| task.name == "T1.1").expect("a task");
    let options = Options { imagine: Some(imagine::Options::default()), ..Options::default() };
    let reset = Reset { seed: 0, scenario: Some(task.scenario.clone()) };
    for is_under_way in [false, true] {
        let mut world = Watched::new();
        let mut parser = Parser::new(hierarchy(), ParseConfig::default());
        let state = parser.parse(&world.reset(&reset).expect("a room")).expect("a state");
        let (goal, budget) = (task.goal.clone(), Budget::unlimited);
        let mut episode = Episode::new(Arc::clone(&model), goal, options.clone(), Experience::new(), budget());
        let Ok(Command::Reset { id }) = episode.step(Input::Started, &mut ()) else { panic!("it begins") };
        let proposed = episode.step(Input::Reset { id, state, instance: None }, &mut ());
        let Ok(Command::Propose { id, .. }) = proposed else { panic!("{proposed:?}") };
        if is_under_way {
            let Ok(Command::Act { call, .. }) = episode.step(Input::Approve { id }, &mut ()) else {
                panic!("approved")
            };
            world.act(&call).expect("a room");
        }
        let restored = Episode::restore(&episode.save(), Arc::clone(&model), options.clone(), budget());
        let mut episode = restored.expect("it was saved");
        let folder = tempfile::tempdir().expect("a folder");
        let mut recorder = Recorder::new(folder.path(), "T1.1", TraceHeader::default());
        let (mut heard, mut approve) = (Heard::default(), |_: &Plan| Confirmation::Approve);
        let account =
            run(&mut episode, &mut world, &reset, &mut parser, &mut approve, &mut heard, &mut [&mut recorder]);
        assert!(account.expect("the simulator works").solved());
        assert_eq!(world.resets, 1, "it goes on where it was");
        if is_under_way {
            // What was observed before that step is not known as the environment told it.
            heard.records.remove(0);
            heard.results.remove(0);
        }
        assert!(!heard.records.is_empty());
        assert_same(&recorder, &heard, "T1.1");
    }
}
