//! Predicates of one name with different numbers of arguments: from a demonstration to plans, other planners and back.

use crate::common::{Folder, Transcript};

const TYPES: &str = r#"{"arm": "object", "box": "object", "shelf": "object"}"#;

fn state(atoms: &str) -> String {
    let objects = r#"{"arm_1":"arm","box_1":"box","box_2":"box","low":"shelf","high":"shelf"}"#;
    let atoms: Vec<String> = atoms.split_whitespace().map(|atom| format!("\"{atom}\"")).collect();
    format!(r#"{{"objects":{objects},"atoms":[{}]}}"#, atoms.join(","))
}

/// A trace of these states, with an action between each two.
fn trace(steps: &[&str]) -> String {
    let line = |(i, step): (usize, &&str)| match i % 2 {
        0 => format!("{{\"state\":{}}}\n", state(step)),
        _ => {
            let (name, args) = step.split_once(' ').expect("an action");
            let args: Vec<String> = args.split(' ').map(|arg| format!("\"{arg}\"")).collect();
            format!("{{\"action\":{{\"name\":\"{name}\",\"args\":[{}]}}}}\n", args.join(","))
        }
    };
    "{\"format\":\"trace/1\"}\n".to_owned() + &steps.iter().enumerate().map(line).collect::<String>()
}

fn task(goal: &str) -> String {
    format!("{{\"format\":\"task/1\",\"goal\":[\"{goal}\"],\"state\":{}}}", state("on(box_1,low) on(box_2,high)"))
}

/// `busy` is said of an arm alone, and of an arm and what it holds.
fn storage() -> Folder {
    let folder = Folder::new();
    folder.write("types.json", TYPES);
    let (on, held) = ("on(box_1,low)", "busy(arm_1) busy(arm_1,box_1)");
    folder.write("moved.jsonl", trace(&[on, "grab arm_1 box_1", held, "put arm_1 box_1 high", "on(box_1,high)"]));
    folder.write("woken.jsonl", trace(&["", "start arm_1", "busy(arm_1)", "stop arm_1", ""]));
    folder.run("learn moved.jsonl woken.jsonl --types types.json -o all.json -q").succeeds();
    folder
}

#[test]
fn from_a_demonstration_to_a_plan_and_another_planner() {
    let folder = storage();
    let mut transcript = Transcript::default();
    transcript.add("a dry run", &folder.run("learn moved.jsonl woken.jsonl --types types.json --dry-run"));
    transcript.add("predicates", &folder.run("show all.json --predicates"));
    transcript.add("an action", &folder.run("show all.json --action grab-box-shelf"));
    folder.write("task.json", task("busy(arm_1,box_2)"));
    transcript.add("plan", &folder.run("plan all.json task.json -o plan"));
    transcript.add("validate", &folder.run("validate all.json task.json plan"));
    folder.write("as_shown.json", task("busy/2(arm_1,box_2)"));
    folder.run("plan all.json as_shown.json -o as_shown.plan").succeeds();
    assert_eq!(folder.read("plan"), folder.read("as_shown.plan"), "the goal may be written as it is shown");
    for level in ["adl", "strips"] {
        folder.run(&format!("export all.json task.json --level {level} -o {level} -q")).succeeds();
        folder.run(&format!("validate {level}/domain.pddl {level}/problem.pddl plan")).succeeds();
        let domain = folder.read(&format!("{level}/domain.pddl"));
        for number in 1..=2 {
            let line = format!("; busy_{number} stands for busy/{number}\n");
            assert!(domain.contains(&line) && domain.contains(&format!("(busy_{number} ?")), "{domain}");
        }
    }
    folder.run("plan all.json adl/problem.pddl -o back.plan").succeeds();
    assert_eq!(folder.read("plan"), folder.read("back.plan"), "an exported problem is a task for the model");
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn adding_and_taking_out_is_as_learning_at_once() {
    let folder = storage();
    let learn = |traces: &str, to: &str| {
        folder.run(&format!("learn {traces} --types types.json -o {to} -q")).succeeds();
        folder.json(to)["parse"]["by_arity"].clone()
    };
    assert_eq!(learn("moved.jsonl woken.jsonl", "all.json"), serde_json::json!(["busy"]));
    assert_eq!(learn("woken.jsonl", "woken.json"), serde_json::Value::Null, "one name for one predicate");
    folder.write("sum.json", folder.read("woken.json"));
    folder.run("learn --into sum.json moved.jsonl -q").succeeds();
    assert!(folder.read("sum.json") == folder.read("all.json"), "told apart from now on");
    folder.run("learn --into sum.json woken.jsonl -q").succeeds();
    assert!(folder.read("sum.json") == folder.read("all.json"), "the same trace again");
    folder.run("learn --into sum.json --forget moved.jsonl -q").succeeds();
    assert!(folder.read("sum.json") == folder.read("woken.json"), "no longer");
    // In the one trace `busy` is said of one, in the other of two.
    folder.write("held.jsonl", trace(&["on(box_1,low)", "grab arm_1 box_1", "busy(arm_1,box_1)"]));
    learn("held.jsonl", "held.json");
    learn("held.jsonl woken.jsonl", "both.json");
    for (into, more) in [("held.json", "woken.jsonl"), ("woken.json", "held.jsonl")] {
        folder.run(&format!("learn --into {into} {more} -o sum.json -q")).succeeds();
        assert!(folder.read("sum.json") == folder.read("both.json"), "{into}");
        folder.run(&format!("learn --into {into} --compact -o compact.json -q")).succeeds();
        folder.run(&format!("learn --into compact.json {more} -q")).succeeds();
        assert_eq!(folder.json("compact.json")["predicates"], folder.json("both.json")["predicates"]);
    }
}

#[test]
fn what_is_refused() {
    let folder = storage();
    let mut transcript = Transcript::default();
    for (title, goal) in
        [("another number of arguments", "busy(arm_1,box_1,low)"), ("as PDDL has it", "busy_2(arm_1,box_1)")]
    {
        folder.write("task.json", task(goal));
        transcript.add(title, &folder.refuses(31, "plan all.json task.json"));
    }
    folder.write("clash.jsonl", trace(&["busy(arm_1) busy(arm_1,low)", "grab arm_1 box_1", "busy_2(arm_1,low)"]));
    transcript
        .add("a name of its own in PDDL", &folder.refuses(31, "learn clash.jsonl --types types.json -o clash.json"));
    insta::assert_snapshot!(transcript.0);
}

/// An environment whose states say `busy` of one and of two, as long as the model's do, and where they do not.
#[cfg(unix)]
#[test]
fn an_environment_is_read_as_the_demonstrations_were() {
    let folder = storage();
    let answer = |id: usize, atoms: &str| {
        let (state, done) = (state(atoms), if id == 2 { "" } else { r#","executed":true"# });
        format!("read x; echo '{{\"id\":{id},\"ok\":true{done},\"state\":{state}}}'; ")
    };
    let script = |atoms: [&str; 2]| {
        let hello = r#"read x; echo '{"id":1,"ok":true,"name":"test","reset":true}'; "#;
        hello.to_owned() + &answer(2, atoms[0]) + &answer(3, atoms[1]) + r#"read x; echo '{"id":4,"ok":true}'"#
    };
    let run = |model: &str| folder.run(&format!("run {model} task.json --env 'sh env.sh' --record R -q"));
    folder.write("task.json", task("busy(arm_1,box_2)"));
    folder.write("env.sh", script(["on(box_2,high)", "busy(arm_1) busy(arm_1,box_2)"]));
    run("all.json").succeeds();
    folder.run("learn --into all.json R/task.jsonl -o more.json -q").succeeds();
    assert_eq!(folder.json("more.json")["predicates"], folder.json("all.json")["predicates"]);
    // A model that knows one of them only takes the other for something that it does not know.
    folder.run("learn woken.jsonl --types types.json -o woken.json -q").succeeds();
    folder.write("task.json", task("busy(arm_1)"));
    folder.write("env.sh", script(["busy(box_1,low)", "busy(box_1,low) busy(arm_1)"]));
    run("woken.json").succeeds();
}
