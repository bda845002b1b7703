//! Command lines that are wrong.

use crate::common::{Folder, Transcript};

#[test]
fn wrong_command_lines() {
    let folder = Folder::new();
    let mut transcript = Transcript::default();
    for command in [
        "",
        "lern",
        "learn",
        "learn a.jsonl --types types.pddl",
        "learn a.jsonl --types t --problems p --objects o -o m",
        "learn a.jsonl --types t -o ''",
        "show",
        "show m.json --action X --pddl",
        "show m.json --bogus",
        "plan m.json",
        "plan m.json t.json --plans 0",
        "plan m.json t.json --plans x",
        "plan m.json t.json --plans 3 --better",
        "plan m.json t.json --time-limit -1",
        "plan m.json t.json --time-limit soon",
        "plan m.json t.json --time-limit 5parsecs",
        "plan m.json t.json --time-limit 1e999",
        "plan m.json t.json --max-expansions -5",
        "plan m.json t.json --memory-limit 1.5",
        "plan m.json t.json --memory-limit lots",
        "plan m.json t.json --memory-limit 2X",
        "run m.json t.json",
        "run m.json t.json --kitchen --env cat",
        "run m.json t.json --env ''",
        "run m.json t.json --kitchen --seed -1",
        "run m.json t.json --kitchen --retries 99999999999",
        "run m.json t.json --kitchen --confirm=perhaps",
        "run m.json t.json --env cat --env-timeout soon",
        "run m.json t.json --env cat --env-timeout act=soon",
        "run m.json t.json --env cat --env-timeout dance=1s",
        "export m.json --name 9lives -o x",
        "export m.json --imagine -o x",
        "export m.json --max-expansions 3 -o x",
        "completions",
        "completions tcsh",
        "man a b",
        "kitchen",
        "kitchen clean",
        "kitchen export K --seed 18446744073709551616",
        "demo --seed x",
        "lab",
        "lab table",
        "lab table -o ''",
        "lab table -o T --jobs 0",
        "lab table -o T --runs 0",
        "lab faults -o F --runs 0",
        "lab faults -o F --max-proposals -1",
        "lab demonstrations -o D --variant special",
    ] {
        let ended = folder.run(command);
        assert_eq!((ended.code, ended.out.as_str()), (36, ""), "{command}: {ended}");
        transcript.add(command, &ended);
    }
    assert_eq!(folder.names(), [""; 0]);
    insta::assert_snapshot!(transcript.0);
}
