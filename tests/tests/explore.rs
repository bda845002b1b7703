use typelift::plan::*;
use typelift::model::*;
use typelift::world::*;
use typelift_kitchen::*;
use typelift_tests::*;
#[test]
fn landmarks() {
    let model = kitchen_model(std::env::var("IND").is_ok());
    let want = std::env::var("T").unwrap_or("T1.3".into());
    let task = tasks().into_iter().find(|t| t.name == want).unwrap();
    let mut k = Kitchen::new();
    let scene = k.reset(&Reset{seed:0, scenario: Some(task.scenario.clone())}).unwrap();
    let mut parser = Parser::new(model.hierarchy.clone(), model.parse.clone());
    let t = Task{init: parser.parse(&scene).unwrap(), goal: task.goal.clone()};
    let im = typelift::imagine::imagine(&model, &t, &Restrictions::default(), &Default::default(), &Budget::unlimited()).unwrap();
    for a in &im.actions { println!("imagined {} {:?}", a.name, a.provenance); }
    let m = strict(&im.added_to(&model));
    let g = ground(&m, &t, &Restrictions::default(), TieOrder::default(), &Budget::unlimited()).unwrap();
    println!("ops {} ({}) facts {}", g.op_count(), g.op_count_with_duplicates(), g.fact_count());
    for s in landmark_sequences(&g) { println!("{:?}: {:?}", s.object, s.facts.iter().map(|f| g.atom(*f)).collect::<Vec<_>>()); }
    let mut p = Planner::new(&m, &t, &Restrictions::default(), &Options::default(), &Budget::unlimited()).unwrap();
    if let Outcome::Solved(plan) = p.next_plan(&Budget::with_expansions(200000)) { for s in plan.steps { println!("{} {:?}", s.action, s.call); } }
    println!("{:?}", p.report());
}
