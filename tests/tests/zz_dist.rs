use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use typelift_tests::strips::*;
use typelift::plan::*;
use typelift::model::*;
#[test]
fn dist() {
    for most in [3, 4] {
    let mut r = TestRunner::deterministic();
    let (mut unreach, mut trivially, mut solved, mut dead, mut none, mut lm, mut lens) = (0,0,0,0,0,0, vec![0;30]);
    let mut ops = 0; let mut cond=0;
    for _ in 0..2000 {
        let t = tiny(most).new_tree(&mut r).unwrap().current();
        let all = all_instances(&t.model, &t.task);
        let re = reachable_atoms(&all, &t.task);
        let g = ground(&t.model, &t.task, &Restrictions::default(), TieOrder::default(), &Budget::unlimited()).unwrap();
        ops += g.op_count(); cond += g.ops().filter(|(_, o)| !o.conditional.is_empty()).count();
        let s = is_solvable(&all, &t.task, 5000);
        let triv = t.task.goal.iter().all(|g| t.task.init.atoms.contains(g));
        if triv { trivially += 1 } else if t.task.goal.iter().any(|g| !re.contains(g)) { unreach += 1 } else if s.is_none() { none += 1 } else if s == Some(true) { solved += 1;
            let mut p = Planner::new(&t.model, &t.task, &Restrictions::default(), &Options::default(), &Budget::unlimited()).unwrap();
            if let Outcome::Solved(p) = p.next_plan(&Budget::unlimited()) { lens[p.len()] += 1; }
        } else { dead += 1 }
        if g.unreachable_goals().is_empty() && landmark_sequences(&g).iter().any(|s| s.facts.len() > 1) { lm += 1 }
    }
    println!("{most}: unreach {unreach} triv {trivially} solved {solved} dead {dead} none {none} lm>1 {lm} ops {ops} cond {cond} lens {lens:?}");
    }
}
