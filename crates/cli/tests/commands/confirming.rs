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
fn an_answer_that_means_nothing_is_answered() {
    let folder = Folder::kitchen();
    for (answer, said) in [
        ("n 9", "there is no step 9: they are numbered from 1 to 5"),
        ("n 0 broken", "there is no step 0: they are numbered from 1 to 5"),
        ("n 3x", "there is no step 3x: they are numbered from 1 to 5"),
        ("n 99999999999999999999", "there is no step 99999999999999999999: they are numbered from 1 to 5"),
        ("x", "not understood: x; `?` says what can be answered"),
        ("y 3", "not understood: y 3; `?` says what can be answered"),
        ("n 2 hot", "not understood: n 2 hot; `?` says what can be answered"),
        ("n hot", "not understood: n hot; `?` says what can be answered"),
        ("n 2 now and then", "not understood: n 2 now and then; `?` says what can be answered"),
        ("", "answer y, n, a, h or s; `?` says what can be answered"),
        ("n 2 broken foo", "foo is not in step 2; in it are agent_1, blender_1, apple_1"),
        ("n 2 kind blender_1 cup_1", "cup_1 is not in step 2; in it are agent_1, blender_1, apple_1"),
        ("n 2 while foo(cup_1)", "the model has no predicate `foo`"),
        ("n 2 while content_hold(cup_1)", "the model has no predicate `content_hold`. Did you mean `content_holds`?"),
        (
            "n 2 while content_holds(cup_1)",
            "`content_holds` takes 2 arguments, not 1. Write `content_holds(x1,x2)`, with the names of entities.",
        ),
        (
            "n 2 while (content_holds cup_1 apple_1)",
            "`(content_holds cup_1 apple_1)` is not an atom of the form predicate(entity,entity). Write \
             `content_holds(cup_1,apple_1)`.",
        ),
        ("n 3 instead", "instead with what? Write an object after it"),
        ("n 3 instead blender_1", "blender_1 is in step 3 already"),
        ("n 3 instead breadslicer_2", "breadslicer_2 is not here. Did you mean `breadslicer_1`?"),
        ("n 3 instead breadslicer_1 for cup_1", "cup_1 is not in step 3; in it are agent_1, blender_1, apple_1"),
        ("n 2 while", "while what? Write an atom after it, such as `on(cup_1,table_1)`"),
    ] {
        let ended = asked(&folder, "K/tasks/T4.1.json --imagine --confirm", &format!("{answer}\ny\n"));
        assert!(ended.contains(&format!("[s]top: {answer}\n{said}\nexecute? ")), "{answer}: {ended}");
        assert!(ended.starts_with("exit 0\n"), "{answer}: it is asked again: {ended}");
    }
    let helped = asked(&folder, "K/tasks/T4.1.json --imagine --confirm", "help\n?\ns\n");
    insta::assert_snapshot!("confirm-help", helped);
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
    for asked in
        ["run kitchen.json K/tasks/T4.1.json --kitchen --confirm all", "run --confirm all kitchen.json --kitchen"]
    {
        let ended = folder.refuses(36, asked);
        assert!(ended.err.contains("`all` is taken for a file here\nhint: Write --confirm=all.\n"), "{ended}");
    }
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

#[test]
fn another_object_instead() {
    let folder = Folder::kitchen();
    let apple = "K/tasks/T4.1.json --imagine --confirm --memory m --instance here";
    let answers = "n 3 instead breadslicer_1\nn 3 kind breadslicer_1\nn 3 instead breadslicer_1 for blender_1\ns\n";
    insta::assert_snapshot!("confirm-instead", asked(&folder, apple, answers));
    // It was meant for that task, and the last word counts: nothing speaks against the breadslicer.
    let next = asked(&folder, apple, "n 3 broken\ns\n");
    let (first, second) = next.split_once("n 3 broken").expect("it is asked");
    assert!(first.contains("USE(agent_1, blender_1, apple_1)"), "{next}");
    assert!(second.contains("USE(agent_1, breadslicer_1, apple_1)"), "{next}");
}

#[test]
fn a_person_shows_what_to_do() {
    let folder = Folder::kitchen();
    let apple = "K/tasks/T4.1.json --imagine --confirm=all --memory m --record R";
    let shown = "h\nPICK(agent_1, counter_14, apple_1)\nPLACE(agent_1, blender_9, apple_1)\nwhat\nFLY(agent_1)\n\
                 PLACE(agent_1, blender_1, apple_1)\nUSE(agent_1, blender_1, apple_1)\ndone\ny\n";
    insta::assert_snapshot!("confirm-show", asked(&folder, apple, shown));
    insta::assert_snapshot!("confirm-show-log", folder.run("memory log m").to_string());
    // What was shown is learned, and needs no imagination.
    let next = folder.run("run K/tasks/T4.1.json --kitchen --memory m --json");
    assert!(next.out.contains("\"imagined_steps\":0") && next.out.contains("\"solved\":true"), "{next}");
    folder.run("learn --into kitchen.json R -o learned.json -q").succeeds();
    folder.run("plan learned.json K/tasks/T4.1.json").succeeds();
    // A demonstration may lead to the goal itself, and ends with the answers.
    let lettuce = "K/tasks/T1.1.json --confirm=all";
    let whole = "show\nPICK(agent_1, counter_14, lettuce_1)\nPLACE(agent_1, cutboard_1, lettuce_1)\n\
                 USE(agent_1, cutboard_1, lettuce_1)\nPICK(agent_1, cutboard_1, lettuce_1)\n\
                 PLACE(agent_1, plate_1, lettuce_1)\n";
    let done = asked(&folder, lettuce, &format!("{whole}done\n"));
    assert!(done.starts_with("exit 0\n") && done.contains("T1.1  solved"), "{done}");
    let ended = asked(&folder, lettuce, whole);
    assert!(ended.contains("no answer: done\n") && ended.contains("T1.1  solved"), "{ended}");
}
