//! Costs of several parts, which no file of PDDL has, are exported as one function.

use proptest::prelude::*;
use typelift_model::testing::cases;
use typelift_model::{ActionModel, Cost, LiftedAtom, Symbol, Task};
use typelift_pddl::{
    ExportError, ExportOptions, Exported, Level, MOST_FACTS, compile_domain, compile_problem, export, read_domain,
    read_problem,
};

/// The model and the task of two texts.
fn compiled(domain: &str, problem: &str) -> (ActionModel, Task) {
    let domain = read_domain(domain).unwrap_or_else(|error| panic!("{}", error.render("domain.pddl", domain)));
    let problem =
        read_problem(problem, &domain).unwrap_or_else(|error| panic!("{}", error.render("problem.pddl", problem)));
    let mut model = compile_domain(&domain).expect("a domain");
    let task = compile_problem(&problem, &mut model).expect("a problem");
    (model, task)
}

fn exported(model: &ActionModel, task: Option<&Task>) -> Result<Exported, ExportError> {
    export(model, task, &ExportOptions { domain: "roads".into(), problem: "trip".into(), level: Level::Adl })
}

/// The texts of an export with a problem.
fn written(model: &ActionModel, task: &Task) -> (String, String) {
    let Exported { domain, problem, .. } = exported(model, Some(task)).expect("it can be exported");
    (domain.to_string(), problem.expect("a problem").to_string())
}

fn cost(fixed: u32, functions: &[&str]) -> Cost {
    Cost { fixed, functions: functions.iter().map(|text| LiftedAtom::parse(text).expect(text)).collect() }
}

/// Two actions, of which `go` costs this. Its parameters are a car, a place and another place.
fn roads(of_go: Cost, values: &str) -> (ActionModel, Task) {
    let domain = "
        (define (domain roads)
          (:types car place - object garage - place)
          (:constants home - garage)
          (:predicates (at ?c - car ?p - place) (cost-of-go-2))
          (:functions (total-cost) - number (length ?a ?b - place) - number (toll ?p - place) - number
            (tax) - number (cost-of-go ?p) - number)
          (:action go :parameters (?c - car ?a - garage ?b - place)
            :precondition (at ?c ?a)
            :effect (and (not (at ?c ?a)) (at ?c ?b) (increase (total-cost) 1)))
          (:action pay :parameters () :effect (and (increase (total-cost) (tax)))))";
    let problem = format!(
        "(define (problem trip) (:domain roads)
          (:objects v - car depot - garage inn mill - place)
          (:init (at v home) {values})
          (:goal (at v inn))
          (:metric minimize (total-cost)))"
    );
    let (mut model, task) = compiled(domain, &problem);
    model.actions[0].cost = of_go;
    (model, task)
}

const VALUES: &str = "(= (tax) 4) (= (toll inn) 5) (= (toll home) 0)
    (= (length home inn) 10) (= (length home home) 0) (= (length inn home) 20) (= (length home mill) 30)";

#[test]
fn a_sum_is_one_function() {
    let (model, task) = roads(cost(2, &["toll(?2)", "length(?1,?2)"]), VALUES);
    let (domain, problem) = written(&model, &task);
    for part in [
        "; cost-of-go is what go costs: 2 + toll + length\n",
        "
  (:functions
    (total-cost) - number
    (cost-of-go ?a0 - garage ?a1 - place) - number
    (tax) - number)
",
        "(increase (total-cost) (cost-of-go ?a ?b))",
        "(increase (total-cost) (tax))",
    ] {
        assert!(domain.contains(part), "{part}\n{domain}");
    }
    // The inn is no garage to go from, and for the mill no toll is stated.
    let values = "
    (= (total-cost) 0)
    (= (cost-of-go home home) 2)
    (= (cost-of-go home inn) 17)
    (= (tax) 4))
";
    assert!(problem.contains(values), "{problem}");
}

#[test]
fn without_a_task_too_there_is_one_function() {
    let (model, _) = roads(cost(1, &["tax()"]), VALUES);
    let domain = exported(&model, None).expect("it can be exported").domain.to_string();
    assert!(domain.contains("(increase (total-cost) (cost-of-go))"), "{domain}");
    read_domain(&domain).expect("a domain");
}

#[test]
fn its_name_is_nobody_elses() {
    let (model, task) = roads(cost(1, &["cost-of-go(?2)"]), "(= (cost-of-go inn) 6)");
    let (domain, problem) = written(&model, &task);
    // A second function would be called as a predicate is.
    assert!(domain.contains("(increase (total-cost) (cost-of-go-3 ?b))"), "{domain}");
    assert!(problem.contains("(= (cost-of-go-3 inn) 7)"), "{problem}");
}

#[test]
fn more_values_than_a_file_should_hold_are_refused() {
    let (model, mut task) = roads(cost(0, &["toll(?2)", "toll(?1)"]), "");
    let garage = model.hierarchy.id("garage");
    for number in 0_u32..2300 {
        let name = Symbol::from(format!("garage-{number}"));
        task.init.objects.extend(garage.map(|garage| (name, garage)));
    }
    assert!(2300_u64.pow(2) > MOST_FACTS);
    assert_eq!(
        exported(&model, Some(&task)).expect_err("too many").to_string(),
        "the cost of `go` is a sum, whose value for every choice of objects is written down, here 5303808"
    );
}

const PARTS: [&str; 8] = [
    "tax()",
    "toll(?1)",
    "toll(?2)",
    "toll(home)",
    "length(?1,?2)",
    "length(?2,?2)",
    "length(mill,?1)",
    "cost-of-go(?2)",
];

const PLACES: [&str; 4] = ["home", "depot", "inn", "mill"];

/// These values, where there is one, of all the functions.
fn stated(values: &[Option<u32>]) -> String {
    let ones = PLACES.iter().flat_map(|p| [format!("(toll {p})"), format!("(cost-of-go {p})")]);
    let pairs = PLACES.iter().flat_map(|p| PLACES.iter().map(move |q| format!("(length {p} {q})")));
    let functions = ones.chain(pairs).chain(["(tax)".to_owned()]).zip(values);
    functions.filter_map(|(function, value)| value.map(|value| format!("(= {function} {value})"))).collect()
}

/// What going costs from each garage to each place; `None` where it cannot be used.
fn costs(model: &ActionModel, task: &Task) -> Vec<Option<u32>> {
    let go = model.action("go").expect("an action");
    let ways = PLACES[..2].iter().flat_map(|a| PLACES.iter().map(move |b| ["v", a, b].map(Symbol::new)));
    ways.map(|objects| go.cost.of(&objects, &task.values)).collect()
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn each_instance_costs_what_it_cost(
        fixed in prop_oneof![Just(0), 1..9_u32, Just(u32::MAX)],
        parts in prop::collection::vec(prop::sample::select(&PARTS[..]), 0..5),
        values in prop::collection::vec(prop::option::weighted(0.8, 0_u32..50), 25),
    ) {
        let (model, task) = roads(cost(fixed, &parts), &stated(&values));
        let (domain, problem) = written(&model, &task);
        let (again, task_again) = compiled(&domain, &problem);
        prop_assert_eq!(costs(&again, &task_again), costs(&model, &task), "{}\n{}", domain, problem);
    }
}
