//! Environments in other programs, and how they fail.
#![cfg(unix)]

use crate::common::{Folder, Transcript};

#[test]
fn the_kitchen_as_another_program() {
    let folder = Folder::kitchen();
    let serve = format!("'{} kitchen serve'", env!("CARGO_BIN_EXE_typelift"));
    let inside = folder.run("run kitchen.json K/faults/broken_cutboard_lettuce.json --kitchen --imagine");
    let outside =
        folder.run(&format!("run kitchen.json K/faults/broken_cutboard_lettuce.json --env {serve} --imagine"));
    inside.succeeds();
    assert_eq!(inside.to_string(), outside.to_string());
}

#[test]
fn environments_that_fail() {
    let folder = Folder::kitchen();
    let hello = r#"read x; echo "{\"id\":1,\"ok\":true,\"name\":\"test\",\"reset\":true}""#;
    let fixed = r#"read x; echo "{\"id\":1,\"ok\":true,\"name\":\"test\",\"reset\":false}""#;
    let scripts = [
        ("garbage.sh", "echo garbage; cat".to_owned()),
        ("dies.sh", format!("{hello}; read x; echo on my way out >&2; exit 3")),
        (
            "refuses.sh",
            format!("{hello}; read x; echo '{{\"id\":2,\"ok\":false,\"error\":\"the arm is unplugged\"}}'; cat"),
        ),
        (
            "strange.sh",
            format!(
                "{hello}; read x; echo '{{\"id\":2,\"ok\":true,\"state\":{{\"objects\":{{\"a\":\"robot\"}}}}}}'; cat"
            ),
        ),
        ("silent.sh", "cat >/dev/null".to_owned()),
        ("fixed.sh", format!("{fixed}; cat")),
    ];
    for (name, script) in scripts {
        folder.write(name, script);
    }
    folder.write("events.jsonl", "from an earlier run\n");
    let mut transcript = Transcript::default();
    for (code, options) in [
        (35, "--env no-such-program --events events.jsonl"),
        (35, "--env '\"'"),
        (35, "--env true"),
        (35, "--env 'sh garbage.sh' --events events.jsonl"),
        (35, "--env 'sh dies.sh'"),
        (35, "--env 'sh refuses.sh'"),
        (35, "--env 'sh strange.sh'"),
        (35, "--env 'sh silent.sh' --env-timeout hello=50ms"),
        (35, "--env 'sh silent.sh' --env-timeout observe=1s,hello=70ms,act=1h"),
        (31, "--env 'sh fixed.sh' --restart"),
    ] {
        let command = if options.contains('"') {
            // A quotation that is never closed cannot be written within one.
            "run kitchen.json K/tasks/T1.1.json -q --env \"".to_owned()
        } else {
            format!("run kitchen.json K/tasks/T1.1.json -q {options}")
        };
        let ended = folder.run(&command);
        assert_eq!((ended.code, ended.out.as_str()), (code, ""), "{command}: {ended}");
        transcript.add(options, &ended);
    }
    assert_eq!(folder.read("events.jsonl"), "from an earlier run\n");
    // Whoever reads JSON reads an object for this task as well.
    let ended = folder.run("run kitchen.json K/tasks/T1.1.json -q --json --env 'sh dies.sh'");
    let begins = r#"{"task":"T1.1","solved":false,"ending":"broken_off","why":""#;
    assert!(ended.code == 35 && ended.out.starts_with(begins), "{ended}");
    insta::assert_snapshot!(transcript.0);
}

/// No shell reads the command line of an environment or a planner.
#[test]
fn a_command_line_for_a_shell_is_told_from_a_missing_program() {
    let folder = Folder::kitchen();
    for (option, code) in [("--env", 35), ("--planner", 38)] {
        for (command, sign) in [
            ("cd robots && ./robot {domain} {problem}", "cd"),
            ("~/robot {domain} {problem}", "~/robot"),
            ("no-such-robot {domain} {problem} | tee log", "|"),
        ] {
            let kitchen = if option == "--env" { "" } else { "--kitchen" };
            let ended = folder.run(&format!("run kitchen.json K/tasks/T1.1.json -q {kitchen} {option} '{command}'"));
            let hint = format!("No shell reads the command line, and `{sign}` is for a shell: write sh -c '…'");
            assert!(ended.code == code && ended.err.contains(&hint), "{option} {command}: {ended}");
        }
    }
}

/// A misspelled key would silently leave out what it was to say.
#[test]
fn a_key_that_nothing_reads_is_told_once() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"cup": "object"}"#);
    folder.write(
        "env.sh",
        r#"while read -r line; do
  id=${line#*'"id":'}; id=${id%%[,\}]*}
  echo "{\"id\":$id,\"ok\":true,\"name\":\"shelf\",\"reset\":true,\"executed\":true,\"state\":{\"entities\":[
    {\"id\":\"a\",\"type\":\"cup\",\"relation\":{\"on\":null}},{\"id\":\"b\",\"type\":\"cup\",\"relation\":{}}]}}" | tr -d '\n'
  echo
done
"#,
    );
    let checked = folder.run("check-env 'sh env.sh' --types types.json");
    assert_eq!(checked.code, 12, "{checked}");
    assert_eq!(checked.out.matches("`relation` of a is not read").count(), 1, "{checked}");
    assert!(checked.out.contains("Did you mean `relations`?"), "{checked}");
    folder.write("domain.pddl", "(define (domain d) (:types cup - object) (:predicates (clean ?x - cup)))");
    folder.write("task.json", r#"{"format":"task/1","goal":["clean(a)"]}"#);
    let run = folder.run("run domain.pddl task.json task.json --env 'sh env.sh'");
    assert_eq!(
        run.err.matches("entity a: `relation` is not read\nhint: Did you mean `relations`?\n").count(),
        1,
        "{run}"
    );
}

/// What is wrong with a state has its own remedy: --types helps against an unknown type only.
#[test]
fn a_state_that_cannot_be_read_comes_with_the_hint_for_what_is_wrong_with_it() {
    let folder = Folder::kitchen();
    for (entities, hint) in [
        (r#"{"id":"a","type":"robot"}"#, "--types FILE adds types to a learned one."),
        (r#"{"id":"a","type":"agent"},{"id":"a","type":"agent"}"#, "Give each entity a name of its own."),
        (
            r#"{"id":"a","type":"agent","relations":{"holding":"b"}}"#,
            "List that entity too; where a relation is to nothing, write null.",
        ),
    ] {
        let hello = r#"{"id":1,"ok":true,"name":"test","reset":true}"#;
        let state = format!(r#"{{"id":2,"ok":true,"state":{{"entities":[{entities}]}}}}"#);
        folder.write("env.sh", format!("read x; echo '{hello}'; read x; echo '{state}'; cat"));
        let ended = folder.run("run kitchen.json K/tasks/T1.1.json -q --env 'sh env.sh'");
        assert!(ended.code == 35 && ended.err.ends_with(&format!("{hint}\n")), "{ended}");
        assert_eq!(ended.err.contains("--types"), entities.contains("robot"), "{ended}");
    }
}

/// Two lamps, the second of which the environment does not survive.
fn two_lamps(then: &str, hello: &str) -> Folder {
    let folder = Folder::new();
    let state = |one: &str, two: &str| {
        let lamp =
            |id: &str, light: &str| format!(r#"{{"id":"{id}","type":"lamp","attributes":{{"light":"{light}"}}}}"#);
        format!(r#"{{"entities":[{},{}]}}"#, lamp("one", one), lamp("two", two))
    };
    folder.write("types.json", r#"{"lamp": "object"}"#);
    let (before, after) = (state("Off", "Off"), state("On", "Off"));
    let press = r#"{"action":{"name":"press","args":["one"]}}"#;
    folder.write(
        "lamps.jsonl",
        format!("{{\"format\":\"trace/1\"}}\n{{\"state\":{before}}}\n{press}\n{{\"state\":{after}}}\n"),
    );
    folder.run("learn lamps.jsonl --types types.json -o model.json -q").succeeds();
    folder.write(
        "task.json",
        r#"{"format":"task/1","goal":["light_On(one)","light_On(two)"],"seed":3,"scenario":"dusk"}"#,
    );
    folder.write("before.json", before);
    folder.write("after.json", after);
    folder.write(
        "lamps.sh",
        format!(
            r#"n=0; acts=0; state=before.json
while read -r line; do
  n=$((n+1))
  case "$line" in
    *'"hello"'*) echo "{{\"id\":$n,\"ok\":true,\"name\":\"lamps\",\"reset\":{hello}}}"; continue;;
    *'"close"'*) echo "{{\"id\":$n,\"ok\":true}}"; continue;;
    *'"act"'*) acts=$((acts+1)); [ $acts = 2 ] && {then}; state=after.json;;
  esac
  echo "{{\"id\":$n,\"ok\":true,\"executed\":true,\"state\":$(cat $state)}}"
done
"#
        ),
    );
    folder
}

#[test]
fn what_was_done_before_an_environment_ended_is_told() {
    let folder = two_lamps("exit 3", "true");
    let run = "run model.json task.json --env 'sh lamps.sh'";
    let ended = folder.run(run);
    assert_eq!(
        (ended.code, ended.out.as_str()),
        (
            35,
            "task  broken off: 1 proposal, 1 action executed, planned in N ms\n  \
             during step 2 of 2 of proposal 1, press(two): what came of it was not observed\n"
        ),
        "{ended}"
    );
    let ended = folder.run(&format!("{run} --json -q"));
    let account: serde_json::Value = serde_json::from_str(&ended.out).expect("one object");
    assert_eq!(account["ending"], "broken_off");
    assert_eq!((&account["proposals"], &account["actions"]), (&1.into(), &1.into()), "{ended}");
    assert_eq!((&account["stopped_at"]["step"], &account["stopped_at"]["begun"]), (&2.into(), &true.into()), "{ended}");
}

#[test]
fn an_action_that_hangs_is_named_where_nothing_can_be_observed_after_it() {
    let folder = two_lamps("sleep 3", "true");
    let ended = folder.run("run model.json task.json --env 'sh lamps.sh' --env-timeout act=300ms,observe=300ms -q");
    let said = "press(two) was not finished in time; after that, environment lamps: it did not answer `observe`";
    assert!(ended.code == 35 && ended.err.contains(said), "{ended}");
}

#[test]
fn what_an_environment_that_cannot_be_reset_ignores_is_said() {
    let folder = two_lamps("exit 3", "false");
    let warning = "lamps cannot be reset: it is taken as it is, whatever scenario and seed is asked for\n";
    for command in ["run model.json task.json --env 'sh lamps.sh'", "check-env 'sh lamps.sh' --task task.json"] {
        let ended = folder.run(command);
        assert!(ended.err.contains(&format!("warning: task.json: {warning}")), "{command}: {ended}");
        assert!(!folder.run(&format!("{command} -q")).err.contains("warning"));
    }
    folder.write("plain.json", r#"{"format":"task/1","goal":["light_On(one)"]}"#);
    let ended = folder.run("run model.json plain.json --env 'sh lamps.sh'");
    assert!(ended.code == 0 && !ended.err.contains("warning"), "{ended}");
}
