//! Models and tasks as PDDL: what is written at each level, that it reads as what was written, and what is refused.

use typelift_model::{
    ActionModel, ActionSchema, Axiom, Cost, Effect, Goal, GroundAtom, Hierarchy, LiftedAtom, LiftedCall, Literal,
    Parameter, Provenance, Replacement, State, Symbol, Task, Term,
};
use typelift_pddl::{ExportError, ExportOptions, Exported, Level, compile_domain, export, read_domain, read_problem};

fn lifted(text: &str) -> LiftedAtom {
    LiftedAtom::parse(text).expect(text)
}

fn ground(text: &str) -> GroundAtom {
    GroundAtom::parse(text).expect(text)
}

/// `p(?0)`, or `not p(?0)`.
fn literal(text: &str) -> Literal {
    match text.strip_prefix("not ") {
        Some(atom) => Literal::negative(lifted(atom)),
        None => Literal::positive(lifted(text)),
    }
}

fn literals(texts: &[&str]) -> Vec<Literal> {
    texts.iter().map(|text| literal(text)).collect()
}

fn effects(texts: &[&str]) -> Vec<Effect> {
    texts.iter().map(|text| Effect::always(literal(text))).collect()
}

fn hierarchy() -> Hierarchy {
    let edges = [("agent", "object"), ("Saw", "machine"), ("machine", "station"), ("shelf", "station")];
    Hierarchy::from_edges(edges).expect("a tree")
}

fn parameters(list: &[(&str, &str)]) -> Vec<Parameter> {
    let types = hierarchy();
    let parameter = |(name, ty): &(&str, &str)| Parameter { name: Symbol::new(name), ty: types.id(ty).expect(ty) };
    list.iter().map(parameter).collect()
}

/// Declares a predicate.
fn declare(model: &mut ActionModel, predicate: &str, types: &[&str]) {
    let types = types.iter().map(|ty| model.hierarchy.id(ty).expect(ty)).collect();
    model.predicates.insert(predicate.into(), types);
}

/// An imagined action and a given one.
fn model() -> ActionModel {
    let types = hierarchy();
    let ty = |name: &str| types.id(name).expect(name);
    let imagined = ActionSchema {
        name: "USE-machine".into(),
        call: LiftedCall { name: "USE".into(), args: vec![Term::Param(0), Term::Param(1)] },
        parameters: parameters(&[("agent", "agent"), ("machine", "machine"), ("Station 2", "station")]),
        preconditions: literals(&["near(?1,?2)", "not is_Ready(?1)"]),
        distinct: ActionSchema::all_distinct(3),
        effects: effects(&["is_Ready(?1)", "not near(?1,?2)"]),
        cost: Cost::UNIT,
        strict: true,
        named_by_call: false,
        provenance: Provenance::Imagined {
            from: "USE-saw".into(),
            replaced: vec![Replacement { parameter: 1, from: ty("Saw"), to: ty("machine") }],
            goal: ground("is_Ready(x)"),
            positive: true,
            observations: 5,
        },
    };
    let given = ActionSchema {
        name: "wait".into(),
        call: LiftedCall { name: "wait".into(), args: vec![Term::Param(0)] },
        parameters: parameters(&[("who", "agent")]),
        preconditions: literals(&["at(?0,Home)"]),
        distinct: Vec::new(),
        effects: effects(&["not is_Ready(saw_1)", "not dark()"]),
        cost: Cost::UNIT,
        strict: false,
        named_by_call: true,
        provenance: Provenance::Given,
    };
    let mut model = ActionModel { actions: vec![imagined, given], hierarchy: types.clone(), ..ActionModel::default() };
    declare(&mut model, "near", &["machine", "station"]);
    declare(&mut model, "is_Ready", &["Saw"]);
    declare(&mut model, "dark", &[]);
    declare(&mut model, "at", &["agent", "station"]);
    declare(&mut model, "unused", &["shelf"]);
    model
}

fn task() -> Task {
    let types = hierarchy();
    let objects = [("bob", "agent"), ("Home", "station"), ("saw_1", "Saw"), ("saw_2", "Saw"), ("shelf_1", "shelf")];
    let objects = objects.map(|(name, ty)| (Symbol::new(name), types.id(ty).expect(ty)));
    let atoms = ["at(bob,Home)", "at(saw_1,Home)", "dark()", "is_Ready(saw_2)", "near(saw_1,shelf_1)"].map(ground);
    let init = State { objects: objects.into(), atoms: atoms.into(), ..State::default() };
    let goal = Goal { required: vec![ground("is_Ready(saw_1)")], forbidden: vec![ground("near(saw_1,shelf_1)")] };
    Task::new(init, goal)
}

/// The task, something in whose initial state keeps what must hold from saying what may not.
fn task_that_implies_nothing() -> Task {
    let mut task = task();
    task.init.atoms.insert(ground("near(saw_2,shelf_1)"));
    task
}

fn exported(model: &ActionModel, task: Option<&Task>, level: Level) -> Result<Exported, ExportError> {
    export(model, task, &ExportOptions { domain: "Small world".into(), problem: "first".into(), level })
}

/// What is written is read as what was written, but for comments.
#[track_caller]
fn written(model: &ActionModel, task: Option<&Task>, level: Level) -> (String, Option<String>) {
    let Exported { domain, problem, .. } = exported(model, task, level).expect("it can be exported");
    let text = domain.to_string();
    let read = read_domain(&text).unwrap_or_else(|error| panic!("{}", error.render("domain.pddl", &text)));
    let mut uncommented = domain;
    uncommented.comment.clear();
    uncommented.actions.iter_mut().for_each(|action| action.comment.clear());
    assert_eq!(read, uncommented);
    let problem = problem.map(|mut problem| {
        let text = problem.to_string();
        let again = read_problem(&text, &read).unwrap_or_else(|error| panic!("{}", error.render("p.pddl", &text)));
        problem.comment.clear();
        assert_eq!(again, problem);
        text
    });
    (text, problem)
}

const ADL_DOMAIN: &str = "\
; written by typelift, level adl
; small_world stands for Small world
(define (domain small_world)
  (:requirements :strips :typing :negative-preconditions :equality)
  (:types
    agent station - object
    machine shelf - station
    saw - machine)
  (:constants
    home - station
    saw_1 - saw)
  (:predicates
    (at ?a0 - object ?a1 - station)
    (dark)
    (is_ready ?a0 - machine)
    (near ?a0 - machine ?a1 - station)
    (unused ?a0 - shelf))

  ; imagined: machine for Saw, from USE-saw
  ; executes USE(?agent, ?machine)
  (:action use-machine
    :parameters (?agent - agent ?machine - machine ?station_2 - station)
    :precondition (and
      (near ?machine ?station_2)
      (not (is_ready ?machine))
      (not (= ?machine ?station_2)))
    :effect (and
      (is_ready ?machine)
      (not (near ?machine ?station_2))))

  ; given
  (:action wait
    :parameters (?who - agent)
    :precondition (and
      (at ?who home))
    :effect (and
      (not (is_ready saw_1))
      (not (dark))))
)
";

const ADL_PROBLEM: &str = "\
; written by typelift
(define (problem first)
  (:domain small_world)
  (:objects
    bob - agent
    saw_2 - saw
    shelf_1 - shelf)
  (:init
    (at bob home)
    (at saw_1 home)
    (dark)
    (is_ready saw_2)
    (near saw_1 shelf_1))
  (:goal (and
    (is_ready saw_1)
    (not (near saw_1 shelf_1))))
)
";

#[test]
fn a_model_and_a_task_as_they_are() {
    let (domain, problem) = written(&model(), Some(&task()), Level::Adl);
    assert_eq!(domain, ADL_DOMAIN);
    assert_eq!(problem.as_deref(), Some(ADL_PROBLEM));
    // Without a task, nothing but agents is anywhere, and nobody knows what the constants are.
    let (domain, _) = written(&model(), None, Level::Adl);
    for line in ["(at ?a0 - agent ?a1 - object)", "(is_ready ?a0 - object)", "(:constants home saw_1 - object)"] {
        assert!(domain.contains(line), "{line}\n{domain}");
    }
}

const STRIPS_DOMAIN: &str = "
  ; imagined: machine for Saw, from USE-saw
  ; executes USE(?agent, ?machine)
  (:action use-machine
    :parameters (?agent - agent ?machine - machine ?station_2 - station)
    :precondition (and
      (near ?machine ?station_2)
      (not-is_ready ?machine)
      (differ ?machine ?station_2))
    :effect (and
      (is_ready ?machine)
      (not (near ?machine ?station_2))
      (not (not-is_ready ?machine))
      (not-near ?machine ?station_2)))

  ; given
  (:action wait
    :parameters (?who - agent)
    :precondition (and
      (at ?who home))
    :effect (and
      (not (is_ready saw_1))
      (not (dark))
      (not-is_ready saw_1)))
)
";

const STRIPS_INIT: &str = "  (:init
    (at bob home)
    (at saw_1 home)
    (dark)
    (differ saw_1 home)
    (differ saw_1 saw_2)
    (differ saw_1 shelf_1)
    (differ saw_2 home)
    (differ saw_2 saw_1)
    (differ saw_2 shelf_1)
    (is_ready saw_2)
    (near saw_1 shelf_1)
    (near saw_2 shelf_1)
    (not-is_ready saw_1))
  (:goal (and
    (is_ready saw_1)
    (not-near saw_1 shelf_1)))
)
";

#[test]
fn strips_has_no_negation() {
    let task = task_that_implies_nothing();
    let (domain, problem) = written(&model(), Some(&task), Level::Strips);
    assert!(domain.contains("(:requirements :strips :typing)\n"), "{domain}");
    for note in [
        "; differ holds of things that are not the same\n",
        "; not-is_Ready holds where is_Ready does not\n",
        "; not-near holds where near does not\n",
    ] {
        assert!(domain.contains(note), "{note}\n{domain}");
    }
    assert!(domain.ends_with(STRIPS_DOMAIN), "{domain}");
    let problem = problem.expect("a problem");
    assert!(problem.ends_with(STRIPS_INIT), "{problem}");
    // Without a task, the goal does not ask for what is not near.
    let (alone, _) = written(&model(), None, Level::Strips);
    assert!(alone.contains("(not-is_ready ?machine)") && !alone.contains("not-near"), "{alone}");
}

#[test]
fn equal_arguments_give_equal_bytes_and_names_come_back() {
    for level in [Level::Strips, Level::Adl] {
        assert_eq!(written(&model(), Some(&task()), level), written(&model(), Some(&task()), level));
        let names = exported(&model(), Some(&task()), level).expect("it can be exported").names;
        let step = names.step("USE-MACHINE", ["bob", "saw_1", "home"]).expect("known names");
        assert_eq!(step, ("USE-machine".into(), vec!["bob".into(), "saw_1".into(), "Home".into()]));
        let unknown = names.step("wait", ["alice"]).expect_err("nobody");
        assert_eq!(unknown.to_string(), "there is no object `alice`");
        assert_eq!(names.step("rest", []).expect_err("nothing").to_string(), "there is no action `rest`");
    }
}

/// A model with everything that is not learned.
fn given_model() -> ActionModel {
    let mut model = model();
    let action = &mut model.actions[1];
    action.cost = Cost { fixed: 0, functions: vec![lifted("way(?0,Home)")] };
    action.effects.push(Effect {
        condition: literals(&["not =(?1,saw_1)"]),
        literal: literal("is_Ready(?1)"),
        parameters: parameters(&[("who", "machine")]),
    });
    declare(&mut model, "busy", &["machine", "station"]);
    let axiom = |head: &str, list: &[(&str, &str)], body: &[&str]| Axiom {
        stratum: 0,
        head: lifted(head),
        parameters: parameters(list),
        body: literals(body),
    };
    model.axioms = vec![
        axiom("busy(?0,?0)", &[("x", "machine"), ("y", "station")], &["near(?0,?1)"]),
        axiom("busy(saw_1,?0)", &[("z", "station")], &["not dark()", "near(?0,?0)"]),
    ];
    model
}

#[test]
fn everything_that_models_have() {
    let mut task = task();
    task.values = [(ground("way(bob,Home)"), 7), (ground("other(bob)"), 1)].into();
    let (domain, problem) = written(&given_model(), Some(&task), Level::Adl);
    for part in [
        "(:requirements :strips :typing :negative-preconditions :equality :existential-preconditions \
         :conditional-effects :derived-predicates :action-costs)",
        "(way ?a0 - agent ?a1 - station) - number",
        "(:derived (busy ?x - machine ?argument1 - machine)\n    \
         (exists (?y - station) (and (near ?x ?y) (= ?argument1 ?x))))",
        "(:derived (busy ?argument0 - saw ?z - station)\n    (and\n      (not (dark))\n      (near ?z ?z)\n      \
         (= ?argument0 saw_1)))",
        "(forall (?who-2 - machine) (when (not (= ?who-2 saw_1)) (is_ready ?who-2)))",
        "(increase (total-cost) 1)",
        "      (increase (total-cost) (way ?who home)))",
    ] {
        assert!(domain.contains(part), "{part}\n{domain}");
    }
    let problem = problem.expect("a problem");
    for part in ["(= (total-cost) 0)\n    (= (way bob home) 7))", "(:metric minimize (total-cost))"] {
        assert!(problem.contains(part), "{part}\n{problem}");
    }
}

#[test]
fn a_formula_that_strips_cannot_say_is_refused_in_its_own_words() {
    let text = "(define (domain d) (:types ward bed) (:predicates (made ?b - bed) (open ?w - ward))
        (:action unlock :parameters (?w - ward) :precondition (forall (?b - bed) (made ?b)) :effect (open ?w)))";
    let model = compile_domain(&read_domain(text).expect("a domain")).expect("a model");
    let refused = exported(&model, None, Level::Strips).expect_err("it is not STRIPS").to_string();
    assert_eq!(refused, "(forall (?b - bed) (made ?b)) is more than a conjunction, which STRIPS cannot say");
}

#[test]
fn what_strips_cannot_say_is_refused_by_name() {
    let refused = |change: &dyn Fn(&mut ActionModel)| {
        let mut model = given_model();
        change(&mut model);
        exported(&model, None, Level::Strips).expect_err("it is not STRIPS").to_string()
    };
    assert_eq!(refused(&|_| {}), "busy is a derived predicate, which STRIPS cannot say");
    let refused = |change: &dyn Fn(&mut ActionSchema)| {
        refused(&|model| {
            model.axioms.clear();
            change(&mut model.actions[1]);
        })
    };
    assert_eq!(refused(&|_| {}), "wait has an effect for every choice of objects, which STRIPS cannot say");
    let conditional = |action: &mut ActionSchema| action.effects[2].parameters.clear();
    assert_eq!(refused(&conditional), "wait has an effect with a condition, which STRIPS cannot say");
    let cost = |action: &mut ActionSchema| drop(action.effects.pop());
    assert_eq!(refused(&cost), "wait has a cost that depends on its objects, which STRIPS cannot say");
}

/// The model with an action that moves something from `?0` to `?1`.
fn moving(preconditions: &[&str], distinct: &[(u32, u32)]) -> ActionModel {
    let mut model = model();
    let action = &mut model.actions[1];
    action.parameters = parameters(&[("from", "machine"), ("to", "station")]);
    action.preconditions = literals(preconditions);
    action.effects = effects(&["not is_Ready(?0)", "is_Ready(?1)"]);
    action.distinct = distinct.to_vec();
    model
}

#[test]
fn what_may_be_added_and_deleted_at_once_has_no_opposite() {
    let refused = exported(&moving(&[], &[]), None, Level::Strips).expect_err("it may be the same");
    assert_eq!(
        refused.to_string(),
        "wait may add what it deletes, where another action needs it not to hold, which STRIPS cannot say"
    );
    for model in
        [moving(&[], &[(0, 1)]), moving(&["not =(?1,?0)"], &[]), moving(&["is_Ready(?0)", "not is_Ready(?1)"], &[])]
    {
        written(&model, Some(&task()), Level::Strips);
    }
}

/// A hand that is empty or holds something, and takes things from where they stand; `USE-machine` is what it does then.
fn with_a_hand() -> ActionModel {
    let mut model = model();
    let action = |name: &str, list: &[(&str, &str)], preconditions: &[&str], all: &[&str]| ActionSchema {
        name: name.into(),
        call: LiftedCall { name: name.into(), args: (0..list.len() as u32).map(Term::Param).collect() },
        parameters: parameters(list),
        preconditions: literals(preconditions),
        distinct: Vec::new(),
        effects: effects(all),
        cost: Cost::UNIT,
        strict: false,
        named_by_call: true,
        provenance: Provenance::Given,
    };
    let places = [("who", "agent"), ("what", "machine"), ("where", "station")];
    model.actions = vec![
        action(
            "take",
            &places,
            &["empty(?0)", "at(?1,?2)", "not holds(?0,?1)"],
            &["not empty(?0)", "not at(?1,?2)", "holds(?0,?1)"],
        ),
        action(
            "put",
            &places,
            &["holds(?0,?1)", "not empty(?0)", "not at(?1,?2)", "not dark()"],
            &["empty(?0)", "at(?1,?2)", "not holds(?0,?1)"],
        ),
    ];
    declare(&mut model, "empty", &["agent"]);
    declare(&mut model, "holds", &["agent", "station"]);
    model
}

#[test]
fn what_must_hold_may_say_what_may_not() {
    let complements = |task: Option<&Task>, model: &ActionModel| {
        let (domain, _) = written(model, task, Level::Strips);
        let names = domain.lines().map(str::trim).filter(|line| line.starts_with("(not-") && line.contains(" - "));
        names.map(|line| line[5..].split(' ').next().unwrap_or_default().to_owned()).collect::<Vec<_>>()
    };
    let mut task = task();
    task.goal.forbidden.clear();
    task.init.atoms = ["empty(bob)", "at(saw_1,Home)", "at(saw_2,Home)"].map(ground).into();
    let model = with_a_hand();
    assert_eq!(complements(Some(&task), &model), Vec::<String>::new());
    // Whether it is dark, nothing else tells.
    let (domain, problem) = written(&model, Some(&task), Level::Strips);
    assert!(domain.contains("(not-dark)") && domain.contains("; what may not hold is left out"), "{domain}");
    assert!(problem.is_some_and(|problem| problem.contains("(not-dark)") && !problem.contains("(not-at")));
    // Without a task nothing says what holds at first.
    assert_eq!(complements(None, &model), ["at", "empty", "holds"]);
    // Two things in the hand, one of them in two places: it is said of none of them.
    task.init.atoms.extend(["holds(bob,saw_1)", "at(saw_2,shelf_1)"].map(ground));
    assert_eq!(complements(Some(&task), &model), ["at", "empty", "holds"]);
    task.init.atoms.retain(|atom| atom.predicate.as_str() != "holds");
    // An empty hand still holds nothing; of what is in two places, one is left when it is taken.
    assert_eq!(complements(Some(&task), &model), ["at"]);
    // An action that breaks it.
    let mut grown = model;
    grown.actions[1].effects.retain(|effect| effect.literal.atom.predicate.as_str() != "holds");
    task.init.atoms.remove(&ground("at(saw_2,shelf_1)"));
    assert_eq!(complements(Some(&task), &grown), ["at", "empty", "holds"]);
}

#[test]
fn equality_is_a_predicate_of_its_own_in_strips() {
    let (_, problem) = written(&moving(&["=(?0,?1)"], &[(0, 1)]), Some(&task()), Level::Strips);
    let problem = problem.expect("a problem");
    let same: Vec<&str> = problem.lines().map(str::trim).filter(|line| line.starts_with("(same ")).collect();
    // The last fact closes the block.
    assert_eq!(same, ["(same saw_1 saw_1)", "(same saw_2 saw_2))"]);
}

#[test]
fn names_that_are_in_use_are_not_taken_again() {
    let mut model = model();
    declare(&mut model, "Not-Is_ready", &["machine"]);
    declare(&mut model, "differ", &["object", "object"]);
    let task = task_that_implies_nothing();
    let (domain, _) = written(&model, Some(&task), Level::Strips);
    assert!(domain.contains("(not-is_ready-2 ?machine)") && domain.contains("(differ-2 ?machine ?station_2)"));
}

#[test]
fn fixed_costs_are_left_out_of_strips() {
    let mut model = model();
    model.actions[1].cost = 3.into();
    let (domain, _) = written(&model, None, Level::Strips);
    assert!(domain.contains("; costs are left out\n") && !domain.contains("total-cost"), "{domain}");
    let (domain, _) = written(&model, None, Level::Adl);
    for part in [":action-costs)", "(:functions (total-cost) - number)", "(increase (total-cost) 3)"] {
        assert!(domain.contains(part), "{part}\n{domain}");
    }
}

#[test]
fn too_many_facts_are_refused_before_they_are_written() {
    let mut model = model();
    model.actions[0].parameters = parameters(&[("a", "agent"), ("m", "machine"), ("s", "station"), ("t", "station")]);
    model.actions[0].preconditions.push(literal("not wide(?1,?2,?3)"));
    declare(&mut model, "wide", &["machine", "station", "station"]);
    let mut task = task_that_implies_nothing();
    task.init.atoms.insert(ground("wide(saw_1,shelf_1,Home)"));
    let saw = model.hierarchy.id("Saw").expect("a type");
    task.init.objects.extend((0..200).map(|i| (Symbol::from(format!("s{i}")), saw)));
    let error = exported(&model, Some(&task), Level::Strips).expect_err("too many");
    assert_eq!(error.to_string(), "in STRIPS, every case in which `wide` does not hold is written down, here 8406432");
    written(&model, Some(&task), Level::Adl);
}

#[test]
fn colliding_names_are_refused() {
    let mut model = model();
    declare(&mut model, "NEAR", &["object", "object"]);
    let error = exported(&model, None, Level::Adl).expect_err("a collision");
    assert_eq!(error.to_string(), "the predicate names `NEAR` and `near` are the same name in PDDL, `near`");
    let mut task = task();
    let agent = model.hierarchy.id("agent").expect("a type");
    task.init.objects.insert("BOB".into(), agent);
    model.predicates.remove("NEAR");
    let error = exported(&model, Some(&task), Level::Adl).expect_err("a collision");
    assert_eq!(error.to_string(), "the object names `BOB` and `bob` are the same name in PDDL, `bob`");
}

#[test]
fn an_empty_model_is_a_domain() {
    let (domain, _) = written(&ActionModel::default(), None, Level::Strips);
    assert!(domain.ends_with("(define (domain small_world)\n  (:requirements :strips)\n)\n"), "{domain}");
}
