//! `check-env`: what would hurt learning.
#![cfg(unix)]

use crate::common::{Folder, Transcript};

/// A pump whose `flow` comes and goes, that names its tank now in a list and now not, and that has a type nobody declared.
const PUMP: &str = r#"
n=0
while read -r line; do
  id=${line#*'"id":'}; id=${id%%[,\}]*}; n=$((n+1))
  case $line in
    *'"op":"hello"'*) echo "{\"id\":$id,\"ok\":true,\"name\":\"pump house\",\"reset\":true}"; continue;;
    *'"op":"act"'*) did=',"executed":false,"reason":"it is hot"';;
    *) did='';;
  esac
  feeds='"tank_1"'; [ $n = 3 ] && feeds='["tank_1"]'
  flow=false; [ $n -ge 6 ] && flow=true
  echo "{\"id\":$id,\"ok\":true$did,\"state\":{\"entities\":[{\"id\":\"pump_1\",\"type\":\"Pump\",
    \"attributes\":{\"flow\":$flow,\"rate\":2},\"relations\":{\"feeds\":$feeds}},{\"id\":\"tank_1\",\"type\":\"tank\"}]}}" | tr -d '\n'
  echo
done
"#;

#[test]
fn what_hurts_is_said_with_its_place_and_a_hint() {
    let folder = Folder::new();
    folder.write("pump.sh", PUMP);
    folder.write("types.json", r#"{"pump": "machine", "tank": "object"}"#);
    folder.write("slip.json", r#"{"machine": "object", "Pump": "machin", "tank": "object"}"#);
    folder.write("bad.json", r#"{"pump": 3}"#);
    folder.write("task.json", r#"{"format":"task/1","goal":[],"seed":7}"#);
    let mut transcript = Transcript::default();
    for (code, command) in [
        (12, "check-env 'sh pump.sh' --types types.json --act 'start(pump_1)'"),
        (12, "check-env 'sh pump.sh' --types types.json --json"),
        (12, "check-env 'sh pump.sh' --types slip.json"),
        (12, "check-env 'sh pump.sh' --ignore flow --task task.json"),
        (31, "check-env 'sh pump.sh' --types bad.json"),
        (35, "check-env true"),
        (36, "check-env 'sh pump.sh' --act 'start(pump_1'"),
    ] {
        let ended = folder.run(command);
        assert_eq!(ended.code, code, "{command}: {ended}");
        transcript.add(command, &ended);
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn the_kitchen_hurts_nobody() {
    let folder = Folder::new();
    folder.run("kitchen export K -q").succeeds();
    let serve = format!("'{} kitchen serve'", env!("CARGO_BIN_EXE_typelift"));
    let ended = folder.run(&format!(
        "check-env {serve} --types K/types.pddl --task K/tasks/T1.1.json --act 'PICK(agent_1, counter_3, lettuce_1)'"
    ));
    ended.succeeds();
}
