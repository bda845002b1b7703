//! Files that come through pipes, and so can be read once only.
#![cfg(unix)]

use crate::common::{Ended, Folder};

/// How a command ends that reads this file, and how if it comes through a pipe.
fn both(folder: &Folder, command: &str, file: &str) -> [Ended; 2] {
    let input = folder.read(file);
    [folder.run(&command.replace("PIPE", file)), folder.run_with_input(&command.replace("PIPE", "/dev/stdin"), &input)]
}

#[test]
fn whatever_is_read_may_come_through_a_pipe() {
    let folder = Folder::kitchen();
    folder.run("kitchen export K -q").succeeds();
    folder.run("export kitchen.json K/tasks/T1.1.json -o P").succeeds();
    folder.run("plan P/domain.pddl P/problem.pddl -o lettuce.plan").succeeds();
    folder.run("plan kitchen.json K/tasks/T1.1.json -o learned.plan").succeeds();
    for (command, file) in [
        ("plan kitchen.json PIPE", "K/tasks/T1.1.json"),
        ("plan PIPE K/tasks/T1.1.json", "kitchen.json"),
        ("plan P/domain.pddl PIPE -o p", "P/problem.pddl"),
        ("plan PIPE P/problem.pddl -o p", "P/domain.pddl"),
        ("run kitchen.json PIPE --kitchen --json -q", "K/tasks/T1.1.json"),
        ("validate P/domain.pddl P/problem.pddl PIPE --json", "lettuce.plan"),
        ("validate P/domain.pddl PIPE lettuce.plan", "P/problem.pddl"),
        ("validate kitchen.json PIPE learned.plan", "K/tasks/T1.1.json"),
        ("export PIPE P/problem.pddl -o Q", "P/domain.pddl"),
        ("show PIPE --pddl", "P/domain.pddl"),
        ("show PIPE", "kitchen.json"),
        ("learn PIPE --types K/types.pddl -o m.json -q", "K/demos/cut_lettuce.jsonl"),
        ("learn K/demos --types PIPE -o m.json -q", "K/types.pddl"),
        ("kitchen replay PIPE", "K/demos/cut_lettuce.jsonl"),
        ("pddl format PIPE", "P/problem.pddl"),
        ("pddl check PIPE", "P/domain.pddl"),
        ("pddl check P/domain.pddl PIPE", "P/problem.pddl"),
        ("pddl check PIPE P/problem.pddl", "P/domain.pddl"),
    ] {
        let [mut file_read, mut pipe_read] = both(&folder, command, file);
        for ended in [&mut file_read, &mut pipe_read] {
            ended.out = ended.out.replace(file, "PIPE").replace("/dev/stdin", "PIPE").replace("T1.1", "stdin");
        }
        assert_eq!((pipe_read.code, &pipe_read.out, &pipe_read.err), (0, &file_read.out, &file_read.err), "{command}");
    }
}

#[test]
fn an_environment_cannot_be_told_to_read_a_pipe_again() {
    let folder = Folder::kitchen();
    folder.run("export kitchen.json K/tasks/T1.1.json -o P").succeeds();
    let problem = folder.read("P/problem.pddl");
    let ended = folder.run_with_input("run P/domain.pddl /dev/stdin --env 'sleep 30'", &problem);
    assert_eq!(ended.code, 31, "{ended}");
    assert!(ended.err.contains("the environment is told this file, and would find it read already"), "{ended}");
}
