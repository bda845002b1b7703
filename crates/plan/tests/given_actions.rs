//! Actions that were given, not learned, as a PDDL domain gives them: conditions in their effects, parameters that may be equal.

use typelift_model::testing::Tiny;
use typelift_model::{
    ActionModel, ActionSchema, Budget, Effect, GroundAction, GroundAtom, Hierarchy, LiftedAtom, LiftedCall, Literal,
    Parameter, Provenance, State, Task, Term,
};
use typelift_plan::{Ban, Exclusion, Options, Outcome, Planner, Restrictions, Strategy};

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
            Effect::when(vec![Literal::positive(lifted("lit(?0)"))], Literal::negative(lifted("lit(?1)"))),
        ],
        cost: 1.into(),
        strict: false,
        named_by_call: true,
        provenance: Provenance::Given,
    };
    let mut task = Task::new(State::default(), vec![GroundAtom::parse("done(x)").expect("an atom")]);
    task.init.objects.extend([("x".into(), lamp), ("y".into(), lamp)]);
    (ActionModel { hierarchy, actions: vec![flip], ..ActionModel::default() }, task)
}

#[test]
fn what_is_banned_is_not_planned_again() {
    let (model, task) = world();
    // By what it was expected to do, or whatever that was.
    let by_effect = |restrictions: &mut Restrictions, action: &GroundAction| {
        restrictions.banned.insert(Ban::of(action));
    };
    let by_call = |restrictions: &mut Restrictions, action: &GroundAction| {
        restrictions.calls.insert(action.call.clone());
    };
    for (unconditional, ban) in
        [(false, by_effect as fn(&mut _, &_)), (true, by_effect), (false, by_call), (true, by_call)]
    {
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
            ban(&mut restrictions, &action);
            assert!(found.len() < 5, "the same again: {found:?}");
        };
        // A lamp may stand for both parameters: then it is done, since what is added is not deleted.
        assert_eq!(found, ["flip(x, x)", "flip(y, x)"]);
        assert!(explanation.to_string().contains("what fits it may not be used any more"), "{explanation}");
    }
}

#[test]
fn goals_that_exclude_each_other_are_not_searched_for() {
    let action = |name: &str, effects: &[(&str, bool)]| ActionSchema {
        name: name.into(),
        call: LiftedCall { name: name.into(), args: Vec::new() },
        parameters: Vec::new(),
        preconditions: Vec::new(),
        distinct: Vec::new(),
        effects: effects
            .iter()
            .map(|&(atom, positive)| Effect::always(Literal { atom: lifted(atom), positive }))
            .collect(),
        cost: 1.into(),
        strict: false,
        named_by_call: true,
        provenance: Provenance::Given,
    };
    let cut = action("cut", &[("cut()", true), ("whole()", false)]);
    let mend = action("mend", &[("whole()", true)]);
    let left = action("left", &[("left()", true), ("right()", false)]);
    let right = action("right", &[("right()", true), ("left()", false)]);
    let outcome = |actions: &[&ActionSchema], init: &[&str], goal: &[&str]| {
        let model = ActionModel { actions: actions.iter().map(|&a| a.clone()).collect(), ..ActionModel::default() };
        let ground = |texts: &[&str]| texts.iter().map(|t| GroundAtom::parse(t).expect("an atom")).collect::<Vec<_>>();
        let mut task = Task::new(State::default(), ground(goal));
        task.init.atoms.extend(ground(init));
        let (none, no_limit) = (Restrictions::default(), Budget::unlimited());
        let mut planner = Planner::new(&model, &task, &none, &Default::default(), &no_limit).expect("no limits");
        let solved = matches!(planner.next_plan(&no_limit), Outcome::Solved(_));
        (solved, planner.report().expansions, if solved { String::new() } else { planner.explain().to_string() })
    };
    let (solved, expansions, why) = outcome(&[&cut], &["whole()"], &["cut()", "whole()"]);
    assert!(!solved && expansions == 0 && why.contains("cannot hold together"), "{why}");
    let (solved, expansions, _) = outcome(&[&left, &right], &[], &["left()", "right()"]);
    assert!(!solved && expansions == 0);
    // What can be mended, or holds already, excludes nothing.
    assert!(outcome(&[&cut, &mend], &["whole()"], &["cut()", "whole()"]).0);
    assert!(outcome(&[&cut], &["whole()", "cut()"], &["cut()", "whole()"]).0);
}

#[test]
fn what_may_not_be_used_is_not_like_the_rest() {
    // Three cups of which the task says the same, the first of which leaks: no search may leave the others out for it.
    let Tiny { model, task } = Tiny::written(
        "init: clean(a) clean(b) clean(c)
         goal: tea
         fill(?0): clean(?0) -> full(?0) !clean(?0)
         drink(?0): full(?0) -> tea !full(?0)",
    );
    let excluded = [Exclusion { object: "a".into(), call: Some("fill".into()) }].into();
    let restrictions = Restrictions { excluded, ..Restrictions::default() };
    for strategy in Strategy::ALL {
        let options = Options { strategy, ..Options::default() };
        let planner = Planner::new(&model, &task, &restrictions, &options, &Budget::unlimited());
        let outcome = planner.expect("no limits").next_plan(&Budget::unlimited());
        let Outcome::Solved(plan) = outcome else { panic!("{strategy}: {outcome:?}") };
        let calls: Vec<String> = plan.steps.iter().map(|step| step.call.to_string()).collect();
        assert_eq!(calls, ["fill(b)", "drink(b)"], "{strategy}");
    }
}
