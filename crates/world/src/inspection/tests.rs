use std::collections::VecDeque;

use super::*;
use crate::Acted;

/// A world that shows these scenes, one after the other; the last one for ever.
struct Scripted {
    scenes: VecDeque<Scene>,
    executes: bool,
    /// What it was set up as; from the third time on it is set up as the second time.
    set_up: Vec<Scene>,
}

impl Scripted {
    fn showing(scenes: &[&str]) -> Self {
        let scene = |json: &&str| serde_json::from_str(json).unwrap_or_else(|error| panic!("{json}: {error}"));
        Self { scenes: scenes.iter().map(scene).collect(), executes: true, set_up: Vec::new() }
    }

    fn next(&mut self) -> Scene {
        let scene = if self.scenes.len() > 1 { self.scenes.pop_front() } else { self.scenes.front().cloned() };
        scene.expect("a scene")
    }
}

impl World for Scripted {
    fn name(&self) -> String {
        "scripted".to_owned()
    }

    fn reset(&mut self, _: &Reset) -> Result<Scene, WorldError> {
        if let [_, second, ..] = self.set_up.as_slice() {
            return Ok(second.clone());
        }
        let scene = self.next();
        self.set_up.push(scene.clone());
        Ok(scene)
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        Ok(self.next())
    }

    fn act(&mut self, _: &GroundCall) -> Result<Acted, WorldError> {
        Ok(Acted { scene: self.next(), executed: self.executes, reason: None })
    }
}

/// A scene of one pump with this in its attributes, and this in its relations.
fn pump(attributes: &str, relations: &str) -> String {
    format!(
        r#"{{"entities":[{{"id":"pump_1","type":"pump","attributes":{{{attributes}}},"relations":{{{relations}}}}},
                         {{"id":"tank_1","type":"tank"}}]}}"#
    )
}

fn findings(mut world: Scripted, options: &InspectOptions) -> Vec<String> {
    let inspection = inspect(&mut world, options).expect("the world does not fail");
    inspection.findings.iter().map(|finding| format!("{}: {}", finding.place, finding.problem)).collect()
}

fn shown(scenes: &[&str]) -> Vec<String> {
    findings(Scripted::showing(scenes), &InspectOptions::default())
}

fn calling() -> InspectOptions {
    let call = GroundCall { name: Symbol::new("start"), args: vec![Symbol::new("pump_1")] };
    InspectOptions { calls: vec![call], ..InspectOptions::default() }
}

/// Two resets, then five observations.
const BEFORE_CALLS: usize = 7;

#[test]
fn a_world_that_stays_as_it_is_has_nothing_wrong() {
    let scene = pump(r#""state":"Idle","on":false,"flow":0.25"#, r#""feeds":null,"near":[]"#);
    assert_eq!(shown(&[&scene]), Vec::<String>::new());
}

#[test]
fn the_first_difference_is_told_from_chance_unrest_and_flicker() {
    let (on, off) = (pump(r#""on":true"#, ""), pump(r#""on":false"#, ""));
    let (on, off) = (on.as_str(), off.as_str());
    assert_eq!(shown(&[on, off]), ["reset: two resets with seed 0 differ: -on(pump_1)"]);
    assert_eq!(shown(&[on, on, off]), ["reset: what is observed right after the answer differs from it: -on(pump_1)"]);
    let flicker = "observe: nothing was done, and on changed: -on(pump_1)";
    assert_eq!(shown(&[on, on, on, off]), [flicker]);
    // What flickers is not told again as something else.
    assert_eq!(shown(&[on, off, on, off, on, off, on]), [flicker]);
    let ignoring = ParseConfig { ignore: BTreeSet::from([Symbol::new("on")]), ..ParseConfig::default() };
    let options = InspectOptions { parse: ignoring, ..InspectOptions::default() };
    assert_eq!(findings(Scripted::showing(&[on, off, on, off]), &options), Vec::<String>::new());
}

#[test]
fn an_attribute_that_flickers_is_named_not_its_words() {
    let poses: Vec<String> = (0..12).map(|i| pump(&format!(r#""pose":"p{i}""#), "")).collect();
    let poses: Vec<&str> = poses.iter().map(String::as_str).collect();
    let found = findings(Scripted::showing(&poses), &calling());
    let flicker = "observe: nothing was done, and pose changed: +pose_p3(pump_1) -pose_p2(pump_1)";
    // The action changes nothing but what changes by itself.
    let nothing = "start(pump_1): it was executed, and no atom changed";
    let many = "state: the attribute `pose` had 9 different words for 1 entity, such as `p0`";
    assert_eq!(found, [flicker, nothing, many]);
}

#[test]
fn what_values_are_over_all_scenes() {
    let cases = [
        (r#""on":0"#, r#""on":1"#, "the attribute `on` is a number, which gives no atom, and was only ever 0, 1"),
        (r#""on":true"#, r#""on":"Yes""#, "the attribute `on` is now true or false and now a word"),
        (
            r#""level":"0.5""#,
            r#""level":"0.5""#,
            "the attribute `level` is the word `0.5`, which is a number in quotation marks",
        ),
    ];
    for (first, then, expected) in cases {
        let found = shown(&[&pump(first, ""), &pump(first, ""), &pump(then, "")]);
        assert_eq!(found.last().map(String::as_str), Some(format!("state: {expected}").as_str()), "{found:?}");
    }
    let masses: Vec<String> = (0..9).map(|i| pump(&format!(r#""mass":{i}"#), "")).collect();
    let masses: Vec<&str> = masses.iter().map(String::as_str).collect();
    assert_eq!(shown(&masses), Vec::<String>::new(), "a number with many values is one");
    assert_eq!(shown(&[&pump(r#""mass":0.5"#, "")]), Vec::<String>::new());
}

/// Each state says a word of two words, another one each time.
#[test]
fn states_that_cannot_be_read_for_one_cause_are_one_finding() {
    let scenes: Vec<String> = (0..4).map(|n| pump(&format!(r#""said":"it ran {n} times""#), "")).collect();
    let said = shown(&scenes.iter().map(String::as_str).collect::<Vec<_>>());
    let unreadable = "this is no state: entity pump_1: `said_it ran 0 times` cannot be a name: it holds white space";
    let found: Vec<&String> = said.iter().filter(|finding| finding.contains("no state")).collect();
    assert!(matches!(found.as_slice(), [only] if only.ends_with(unreadable)), "{said:?}");
}

#[test]
fn lists_and_ids_are_told_apart() {
    let (list, none, empty) = (r#""feeds":["tank_1"]"#, r#""feeds":null"#, r#""feeds":[]"#);
    let last = |first: &str, then: &str| {
        shown(&[&pump("", first), &pump("", first), &pump("", then)]).last().cloned().unwrap_or_default()
    };
    assert_eq!(
        last(list, none),
        "state: the relation `feeds` is now a list, as of pump_1, and now an id or null, as of pump_1"
    );
    let of_one = "state: the relation `feeds` is a list, but never held more than one entity, and none of pump_1";
    assert_eq!(last(list, empty), of_one);
    assert_eq!(shown(&[&pump("", empty)]), Vec::<String>::new(), "it may come to hold several");
}

#[test]
fn types_and_names() {
    let hierarchy = Hierarchy::from_edges([("pump", "object"), ("tanks", "object")]).expect("a tree");
    let options = InspectOptions { hierarchy: Some(hierarchy), ..InspectOptions::default() };
    let mut world = Scripted::showing(&[&pump("", r#""feeds":"tank_2""#)]);
    let inspection = inspect(&mut world, &options).expect("the world does not fail");
    let told: Vec<(String, String)> =
        inspection.findings.iter().map(|f| (f.problem.to_string(), f.problem.hint())).collect();
    assert_eq!(told[0].0, "the types do not have `tank`, the type of tank_1");
    assert_eq!(told[0].1, "Did you mean `tanks`?");
    assert_eq!(
        told[1].0,
        "this is no state: entity pump_1: the relation `feeds` mentions `tank_2`, which is not among the entities"
    );
    assert_eq!(told.len(), 2, "each thing is told once, however many scenes show it: {told:?}");
    let becomes = pump("", "").replace(r#""type":"tank""#, r#""type":"barrel""#);
    assert_eq!(shown(&[&pump("", ""), &becomes]), ["second reset: tank_1 was a tank before, and is a barrel now"]);
}

#[test]
fn actions_that_cannot_be_learned_from() {
    let (on, off) = (pump(r#""on":true"#, ""), pump(r#""on":false"#, ""));
    let mut scenes = vec![off.as_str(); BEFORE_CALLS];
    scenes.push(&on);
    assert_eq!(findings(Scripted::showing(&scenes), &calling()), Vec::<String>::new());
    let refusing = Scripted { executes: false, ..Scripted::showing(&scenes) };
    assert_eq!(
        findings(refusing, &calling()),
        ["start(pump_1): it was not executed, and yet something changed: +on(pump_1)"]
    );
    let gone = r#"{"entities":[{"id":"pump_1","type":"pump"}]}"#;
    scenes[BEFORE_CALLS] = gone;
    assert_eq!(
        findings(Scripted::showing(&scenes), &calling()),
        ["start(pump_1): entities appeared or vanished: tank_1"]
    );
    scenes[BEFORE_CALLS] = &on;
    scenes.push(&off);
    assert_eq!(
        findings(Scripted::showing(&scenes), &calling()),
        ["start(pump_1): what is observed right after the answer differs from it: -on(pump_1)"]
    );
}

#[test]
fn what_is_asked_for_and_not_there_is_said() {
    let call = GroundCall { name: Symbol::new("start"), args: vec![Symbol::new("pump_2"), Symbol::new("tank_1")] };
    let parse = ParseConfig { ignore: [Symbol::new("flwo"), Symbol::new("on")].into(), ..ParseConfig::default() };
    let scenes = [pump(r#""on":true,"flow":"High""#, "")];
    let world = Scripted { executes: false, ..Scripted::showing(&[&scenes[0]]) };
    let found = findings(world, &InspectOptions { parse, calls: vec![call], ..InspectOptions::default() });
    assert_eq!(
        found,
        ["start(pump_2, tank_1): there is no entity `pump_2`", "state: `flwo`, which is to be left out, was never met"]
    );
}

#[test]
fn what_is_left_out_at_times_is_found_where_it_gives_an_atom() {
    let told = |attributes: [&str; 2], relations: [&str; 2]| {
        let scenes = [0, 1].map(|at| pump(attributes[at], relations[at]));
        let found = shown(&[&scenes[0], &scenes[0], &scenes[1]]);
        found.into_iter().filter(|line| line.starts_with("state: ")).collect::<Vec<_>>()
    };
    assert_eq!(
        told([r#""mode":"Idle""#, ""], [r#""feeds":"tank_1""#, ""]),
        [
            "state: the relation `feeds` of pump_1 is left out in some states, and in others it is there",
            "state: the attribute `mode` of pump_1 is left out in some states, and in others it is there",
        ]
    );
    // False, an empty list and a number give no atom, nor does what is left out.
    assert_eq!(told([r#""on":true,"flow":0.25"#, ""], [r#""near":["tank_1","pump_1"]"#, ""]), Vec::<String>::new());
    assert_eq!(told(["", ""], [r#""feeds":"tank_1""#, r#""feeds":null"#]), Vec::<String>::new(), "null is there");
    let two = r#"{"entities":[{"id":"a","type":"pump","attributes":{"mode":"Idle"}},{"id":"b","type":"pump"}]}"#;
    assert_eq!(
        shown(&[two]),
        ["state: the attribute `mode` is left out of b, and a, which is of type pump too, has it"]
    );
    let ignoring = ParseConfig { ignore: BTreeSet::from([Symbol::new("pump.mode")]), ..ParseConfig::default() };
    let options = InspectOptions { parse: ignoring, ..InspectOptions::default() };
    let of_the_type = |found: Vec<String>| found.iter().any(|line| line.contains("left out of b"));
    assert!(!of_the_type(findings(Scripted::showing(&[two]), &options)));
}

#[test]
fn words_that_differ_in_case_only_are_one_name_in_pddl() {
    let two = r#"{"entities":[{"id":"a","type":"pump","attributes":{"mode":"Idle"}},
                              {"id":"b","type":"pump","attributes":{"mode":"idle"}}]}"#;
    assert_eq!(shown(&[two]), ["state: `mode_Idle` and `mode_idle` differ in case only"]);
    let types = r#"{"entities":[{"id":"a","type":"pump"},{"id":"b","type":"Pump"}]}"#;
    assert_eq!(shown(&[types]), ["state: `Pump` and `pump` differ in case only"]);
}

/// A world that is gone after so many answers.
struct Mortal(Scripted, usize);

impl Mortal {
    fn answer(&mut self) -> Result<Scene, WorldError> {
        self.1 = self.1.checked_sub(1).ok_or_else(|| WorldError::Gone { account: "gone".to_owned() })?;
        Ok(self.0.next())
    }
}

impl World for Mortal {
    fn name(&self) -> String {
        "mortal".to_owned()
    }

    fn reset(&mut self, _: &Reset) -> Result<Scene, WorldError> {
        self.answer()
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        self.answer()
    }

    fn act(&mut self, _: &GroundCall) -> Result<Acted, WorldError> {
        Ok(Acted { scene: self.answer()?, executed: true, reason: None })
    }
}

#[test]
fn what_was_found_before_it_broke_off_is_kept() {
    let (on, off) = (pump(r#""on":true"#, ""), pump(r#""on":false"#, ""));
    let scenes = [on.as_str(), off.as_str()];
    let options = InspectOptions {
        parse: ParseConfig { ignore: BTreeSet::from([Symbol::new("flwo")]), ..ParseConfig::default() },
        ..calling()
    };
    for (answers, asked, findings) in
        [(0, "reset", 0), (1, "second reset", 0), (3, "observe", 0), (BEFORE_CALLS, "start(pump_1)", 1)]
    {
        let mut world = Mortal(Scripted::showing(&scenes), answers);
        let BrokenOff { error, found } = inspect(&mut world, &options).expect_err("it ends");
        assert_eq!(error, WorldError::Gone { account: "gone".to_owned() });
        let at = BrokenOffAt { asked: asked.to_owned(), answered: false };
        assert_eq!((found.broken_off.as_ref(), found.findings.len()), (Some(&at), findings), "{found:?}");
    }
}

/// A world that answers an action, and not as the protocol says.
struct Misspeaking(Scripted);

impl World for Misspeaking {
    fn name(&self) -> String {
        self.0.name()
    }

    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError> {
        self.0.reset(reset)
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        self.0.observe()
    }

    fn act(&mut self, _: &GroundCall) -> Result<Acted, WorldError> {
        Err(WorldError::Misspoke { account: "no state".to_owned() })
    }
}

#[test]
fn an_answer_that_cannot_be_used_is_one() {
    let mut world = Misspeaking(Scripted::showing(&[&pump("", "")]));
    let BrokenOff { found, .. } = inspect(&mut world, &calling()).expect_err("it misspeaks");
    assert_eq!(found.broken_off, Some(BrokenOffAt { asked: "start(pump_1)".to_owned(), answered: true }));
}

/// A world in which an action switches the pump on, and a reset leaves it as it is.
struct Keeping {
    on: bool,
}

impl World for Keeping {
    fn name(&self) -> String {
        "keeping".to_owned()
    }

    fn reset(&mut self, _: &Reset) -> Result<Scene, WorldError> {
        self.observe()
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        Ok(serde_json::from_str(&pump(&format!("\"on\":{}", self.on), "")).expect("a scene"))
    }

    fn act(&mut self, _: &GroundCall) -> Result<Acted, WorldError> {
        self.on = true;
        Ok(Acted { scene: self.observe()?, executed: true, reason: None })
    }
}

#[test]
fn a_reset_that_keeps_what_was_done_is_found_after_the_actions() {
    let found = inspect(&mut Keeping { on: false }, &calling()).expect("it does not fail").findings;
    let expected = "reset: a reset after the actions differs from the one before them: +on(pump_1)";
    assert_eq!(found.iter().map(|f| format!("{}: {}", f.place, f.problem)).collect::<Vec<_>>(), [expected]);
    assert!(found[0].problem.is_certain());
    let without_actions = inspect(&mut Keeping { on: false }, &InspectOptions::default()).expect("it does not fail");
    assert_eq!(without_actions.findings, []);
}

#[test]
fn what_an_action_makes_on_demand_is_told_from_what_is_misspelt() {
    let on = [pump(r#""on":false"#, ""), pump(r#""on":true"#, "")];
    let scenes: Vec<&str> = std::iter::repeat_n(on[0].as_str(), BEFORE_CALLS).chain([on[1].as_str()]).collect();
    let call = GroundCall { name: Symbol::new("start"), args: vec!["pump_2".into()] };
    let options = InspectOptions { calls: vec![call], ..InspectOptions::default() };
    assert_eq!(
        findings(Scripted::showing(&scenes), &options),
        ["start(pump_2): it was executed, though no state before it shows `pump_2`"]
    );
    let world = Scripted { executes: false, ..Scripted::showing(&[&on[0]]) };
    assert_eq!(findings(world, &options), ["start(pump_2): there is no entity `pump_2`"]);
}

#[test]
fn numbers_that_the_seed_does_not_decide_may_hurt() {
    let weighing = |mass: &str| pump(&format!(r#""mass":{mass},"on":true"#), "");
    let (light, heavy) = (weighing("1.5"), weighing("2.5"));
    let (light, heavy) = (light.as_str(), heavy.as_str());
    assert_eq!(shown(&[light, heavy]), ["reset: two resets with seed 0 differ in numbers only: mass"]);
    assert_eq!(shown(&[&weighing("[1,2]"), &weighing("[1,3]")]).len(), 1, "a list of numbers, too");
    // A measurement is never the same twice, and where atoms differ, too, that is said.
    assert_eq!(shown(&[light, heavy, light, heavy, light, heavy, light]), Vec::<String>::new());
    let off = pump(r#""mass":2.5,"on":false"#, "");
    assert_eq!(shown(&[light, &off]), ["reset: two resets with seed 0 differ: -on(pump_1)"]);
    let ignoring = ParseConfig { ignore: BTreeSet::from([Symbol::new("pump.mass")]), ..ParseConfig::default() };
    let options = InspectOptions { parse: ignoring, ..InspectOptions::default() };
    assert_eq!(findings(Scripted::showing(&[light, heavy]), &options), Vec::<String>::new());
}

#[test]
fn what_every_action_changes_may_be_no_effect_of_any() {
    let scene = |tick: &str, feeds: &str| pump(&format!(r#""tick":{tick}"#), &format!(r#""feeds":{feeds}"#));
    let (even, odd) = (scene("false", "null"), scene("true", r#""tank_1""#));
    let acting = |calls: &[(&str, &str)]| {
        // The answer to each action, and what is observed after it.
        let mut scenes = vec![even.as_str(); BEFORE_CALLS];
        scenes.extend((0..calls.len()).flat_map(|at| [if at % 2 == 0 { &odd } else { &even }; 2]).map(String::as_str));
        let call = |(name, arg): &(&str, &str)| GroundCall { name: Symbol::new(name), args: vec![Symbol::new(arg)] };
        let calls = calls.iter().map(call).collect();
        findings(Scripted::showing(&scenes), &InspectOptions { calls, ..InspectOptions::default() })
    };
    let told = |n| format!("state: all {n} actions that were executed changed `tick` of pump_1, whatever they were");
    // What it feeds is the tank that the actions are told of.
    assert_eq!(acting(&[("open", "tank_1"), ("shut", "tank_1"), ("open", "tank_1")]), [told(3)]);
    let calls = [("open", "tank_1"), ("start", "pump_1"), ("shut", "tank_1"), ("open", "tank_1")];
    assert_eq!(acting(&calls), [told(4)], "one of them is about the pump");
    assert_eq!(acting(&[("open", "tank_1"), ("shut", "tank_1")]), Vec::<String>::new(), "two are too few");
    assert_eq!(acting(&[("turn", "tank_1"); 3]), Vec::<String>::new(), "the one action may do that");
    assert_eq!(acting(&[("start", "pump_1"), ("stop", "pump_1"), ("start", "pump_1")]), Vec::<String>::new());
}
