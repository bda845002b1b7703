//! `--planner`: an external planner.
#![cfg(unix)]

use crate::common::Folder;

/// The kitchen with planners that are shell scripts.
fn planners() -> Folder {
    let folder = Folder::kitchen();
    folder.run("plan kitchen.json K/tasks/T1.1.json -o own.plan -q").succeeds();
    let own = folder.read("own.plan");
    let script = |name: &str, text: &str| folder.write(name, text);
    script("good.sh", &format!("test -s $1 && test -s $2 && cat > $3 <<END\n{own}END\n"));
    script("anytime.sh", &format!("echo '(nonsense)' > $3.1\ncat > $3.2 <<END\n{own}END\nsleep 60\n"));
    script("soln.sh", &format!("cat > $2.soln <<END\n{own}END\n"));
    script("wrong.sh", &format!("cat > $3 <<END\n{}END\n", own.lines().skip(1).collect::<Vec<_>>().join("\n") + "\n"));
    script("unknown.sh", "echo '(fly agent_1)' > $3\n");
    script("torn.sh", "echo '(pick-station-food' > $3\n");
    script("crash.sh", "echo searching\necho 'out of ideas' >&2\nexit 7\n");
    script("silent.sh", "exit 0\n");
    script("none.sh", "exit 11\n");
    script("gave-up.sh", "exit 12\n");
    script("memory.sh", "exit 22\n");
    script("slow.sh", "sleep 60\n");
    folder
}

fn command(planner: &str, more: &str) -> String {
    format!("plan kitchen.json K/tasks/T1.1.json {more} --planner 'sh ./{planner}.sh {{domain}} {{problem}} {{plan}}'")
}

#[test]
fn its_plan_comes_back_and_is_used() {
    let folder = planners();
    let own = folder.run("plan kitchen.json K/tasks/T1.1.json").out;
    let steps = |out: &str| out.lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
    for (planner, more) in
        [("good", ""), ("soln", ""), ("anytime", "--time-limit 500ms"), ("good", "--planner-level strips")]
    {
        let plan = folder.run(&command(planner, more));
        plan.succeeds();
        assert_eq!(steps(&plan.out), steps(&own), "{planner}");
    }
    let run = "run kitchen.json K/tasks/T1.1.json --kitchen --planner 'sh ./good.sh {domain} {problem} {plan}'";
    insta::assert_snapshot!("planner-run", folder.run(run));
}

#[test]
fn a_program_that_is_a_link_is_started_as_that() {
    let folder = planners();
    let own = folder.read("own.plan");
    // As the interpreter of a virtual environment, it is another program by its own name.
    folder.write("target.sh", format!("case $0 in */link.sh) cat > $3 <<END\n{own}END\nesac\n"));
    std::os::unix::fs::symlink("target.sh", folder.path("link.sh")).expect("a link");
    folder.run(&command("link", "")).succeeds();
    folder.refuses(38, &command("target", ""));
}

#[test]
fn each_way_to_fail_is_told_apart() {
    let folder = planners();
    let mut all = String::new();
    for (code, planner, more) in
        [(38, "crash", ""), (38, "silent", ""), (39, "wrong", ""), (39, "unknown", ""), (39, "torn", "")]
    {
        all.push_str(&format!("{planner}: {}", folder.refuses(code, &command(planner, more)).err));
    }
    for (code, planner, more) in
        [(11, "none", ""), (12, "gave-up", ""), (22, "memory", ""), (23, "slow", "--time-limit 300ms")]
    {
        let ended = folder.run(&command(planner, more));
        assert_eq!(ended.code, code, "{planner}: {ended}");
        all.push_str(&format!("{planner}: {}", ended.err));
    }
    for words in ["'no-such-planner {domain} {problem}'", "'sh good.sh {domain}'", "'sh \"good.sh {domain} {problem}'"]
    {
        let ended = folder.run(&format!("plan kitchen.json K/tasks/T1.1.json --planner {words}"));
        assert!([36, 38].contains(&ended.code), "{ended}");
        all.push_str(&format!("{words}: {}", ended.err));
    }
    insta::assert_snapshot!("planner-failures", all);
}
