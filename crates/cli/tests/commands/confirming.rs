//! `run --confirm`: a person is asked before a plan is executed.

use crate::common::Folder;

fn asked(folder: &Folder, options: &str, answers: &str) -> String {
    folder.run_with_input(&format!("run kitchen.json {options} --kitchen"), answers).to_string()
}

#[test]
fn each_answer() {
    let folder = Folder::kitchen();
    let apple = "K/tasks/T4.1.json --imagine --confirm";
    insta::assert_snapshot!("confirm-yes", asked(&folder, apple, "y\n"));
    insta::assert_snapshot!("confirm-no", asked(&folder, apple, "n\ns\n"));
    insta::assert_snapshot!("confirm-not-step", asked(&folder, apple, "n 2\nstop\n"));
    insta::assert_snapshot!("confirm-stop", asked(&folder, apple, "s\n"));
    insta::assert_snapshot!("confirm-nobody", asked(&folder, apple, ""));
    insta::assert_snapshot!("confirm-unclear", asked(&folder, apple, "what?\n\nn 99\nn 0\ny 3\nyes\n"));
}

#[test]
fn who_is_asked_about_what() {
    let folder = Folder::kitchen();
    let plain = asked(&folder, "K/tasks/T1.1.json --confirm", "");
    assert!(plain.starts_with("exit 0\n") && !plain.contains("execute?"), "nothing is imagined here: {plain}");
    let all = asked(&folder, "K/tasks/T1.1.json --confirm=all", "y\n");
    assert!(all.starts_with("exit 0\n") && all.contains("execute?"), "{all}");
}

#[test]
fn the_option_takes_nothing_that_stands_behind_it() {
    let folder = Folder::kitchen();
    let ended = folder.run_with_input("run --confirm kitchen.json K/tasks/T4.1.json --imagine --kitchen", "s\n");
    assert!(ended.code == 12 && ended.err.contains("execute?"), "{ended}");
    let between = folder.run("run kitchen.json --confirm K/tasks/T1.1.json --kitchen");
    assert!(between.code == 0 && !between.err.contains("execute?"), "{between}");
}

#[test]
fn a_rejected_plan_is_not_executed() {
    let folder = Folder::kitchen();
    let ended = folder.run_with_input("run kitchen.json K/tasks/T1.1.json --kitchen --confirm=all --json", "s\n");
    assert_eq!(ended.code, 12);
    assert!(ended.out.contains("\"ending\":\"stopped\"") && ended.out.contains("\"actions\":0"), "{ended}");
}
