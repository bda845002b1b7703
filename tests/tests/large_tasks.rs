//! A task of the kitchen is planned among the objects of a hundred kitchens as it is in one.

use typelift::agent::{self, propose};
use typelift::imagine;
use typelift::model::{ActionModel, Budget, Symbol, Task};
use typelift::plan::{Outcome, Restrictions};
use typelift_kitchen::tasks;
use typelift_tests::{kitchen_model, planning_task};

/// So many times everything but the agent; only the first are what the task is about.
fn copied(model: &ActionModel, task: &Task, times: usize) -> Task {
    let mut large = task.clone();
    let stays = |name: &Symbol| model.is_actor(task.init.objects[name]);
    for number in 1..times {
        let name = |name: &Symbol| if stays(name) { name.clone() } else { Symbol::from(format!("{name}-{number}")) };
        large.init.objects.extend(task.init.objects.iter().map(|(object, ty)| (name(object), *ty)));
        large.init.atoms.extend(task.init.atoms.iter().map(|atom| atom.map(name)));
    }
    large
}

#[test]
fn a_hundred_kitchens_are_planned_like_one() {
    let model = kitchen_model(false);
    let (mut solved, no_limit) = (0, Budget::unlimited());
    for task in tasks() {
        let small = planning_task(&model, &task, 0);
        let options = agent::Options { imagine: Some(imagine::Options::default()), ..agent::Options::default() };
        let alone = propose(&model, &small, &Restrictions::default(), &options, &no_limit).expect("no limits");
        if !alone.imagination.unreachable.is_empty() || task.goal.len() > 2 {
            continue;
        }
        let large = copied(&model, &small, 100);
        assert!(large.init.objects.len() > 3_000);
        let found = propose(&model, &large, &Restrictions::default(), &options, &no_limit).expect("a valid plan");
        assert!(matches!(found.outcome, Outcome::Solved(_)), "{}", task.name);
        assert!(found.report().ground_actions < 5_000, "{}: {:?}", task.name, found.report());
        solved += 1;
    }
    assert!(solved > 2, "nothing was tested");
}
