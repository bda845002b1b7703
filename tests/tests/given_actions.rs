//! Actions that nobody learned, as a PDDL domain gives them: conditions in their effects, parameters that may be equal.

use typelift::model::{
    ActionModel, ActionSchema, Budget, Effect, GroundAtom, Hierarchy, LiftedAtom, LiftedCall, Literal, Parameter,
    Provenance, Task, Term,
};
use typelift::plan::{Ban, Outcome, Planner, Restrictions};

fn lifted(text: &str) -> LiftedAtom {
    LiftedAtom::parse(text).expect("an atom")
}

/// `flip(?0, ?1)`: where lit(?0), not lit(?1); it always makes done(?1), and deletes done(?0).
fn world() -> (ActionModel, Task) {
    let hierarchy = Hierarchy::from_edges([("lamp", "object")]).expect("a tree");
    let lamp = hierarchy.id("lamp").expect("declared");
    let parameter = |name: &str| Parameter { name: name.into(), ty: lamp };
    let flip = ActionSchema {
        name: "flip".into(),
        call: LiftedCall { name: "flip".into(), args: vec![Term::Param(0), Term::Param(1)] },
        parameters: vec![parameter("a"), parameter("b")],
        preconditions: Vec::new(),
        distinct: Vec::new(),
        effects: vec![
            Effect::always(Literal::negative(lifted("done(?0)"))),
            Effect::always(Literal::positive(lifted("done(?1)"))),
            Effect {
                condition: vec![Literal::positive(lifted("lit(?0)"))],
                literal: Literal::negative(lifted("lit(?1)")),
            },
        ],
        cost: 1,
        provenance: Provenance::Given,
    };
    let mut task = Task { goal: vec![GroundAtom::parse("done(x)").expect("an atom")], ..Task::default() };
    task.init.objects.extend([("x".into(), lamp), ("y".into(), lamp)]);
    (ActionModel { hierarchy, actions: vec![flip], ..ActionModel::default() }, task)
}

#[test]
fn what_is_banned_is_not_planned_again() {
    let (model, task) = world();
    for unconditional in [false, true] {
        let mut model = model.clone();
        if unconditional {
            model.actions[0].effects.retain(|effect| effect.condition.is_empty());
        }
        let mut restrictions = Restrictions::default();
        let mut found = Vec::new();
        let explanation = loop {
            let mut planner = Planner::new(&model, &task, &restrictions, &Default::default(), &Budget::unlimited())
                .expect("no limits");
            let Outcome::Solved(plan) = planner.next_plan(&Budget::unlimited()) else { break planner.explain() };
            let step = &plan.steps[0];
            let action = model.actions[0].instantiate(&step.objects, &task.init, &model.hierarchy).expect("it fits");
            found.push(step.call.to_string());
            restrictions.banned.insert(Ban::of(&action));
            assert!(found.len() < 5, "the same again: {found:?}");
        };
        // A lamp may stand for both parameters: then it is done, since what is added is not deleted.
        assert_eq!(found, ["flip(x, x)", "flip(y, x)"]);
        assert!(explanation.to_string().contains("was tried and failed"), "{explanation}");
    }
}
