//! The paper's Table I.

use typelift::model::Budget;
use typelift_kitchen::tasks;
use typelift_tests::{VARIANTS, kitchen_model, paper_options, solve};

#[test]
fn explore() {
    let seeds: u64 = std::env::var("SEEDS").ok().and_then(|s| s.parse().ok()).unwrap_or(1);
    let models = [kitchen_model(false), kitchen_model(true)];
    eprintln!("{} {}", models[0].actions.len(), models[1].actions.len());
    let only = std::env::var("ONLY").unwrap_or_default();
    for task in tasks() {
        if !task.name.contains(&only) { continue; }
        let mut line = format!("{:5}", task.name);
        for (name, individual, imagine) in VARIANTS {
            if std::env::var("V").is_ok_and(|v| !v.split(',').any(|v| v == name)) { continue; }
            for seed in 0..seeds {
                let t = std::time::Instant::now();
                let a = solve(&models[usize::from(individual)], &task, seed, &paper_options(imagine), &Budget::with_expansions(200_000));
                let cell = a.plan.as_ref().map_or("-".to_owned(), |p| format!("{}/{}", a.proposals, p.len()));
                line += &format!(" | {cell} {} {:?}", a.expansions, t.elapsed());
                if cell == "-" && std::env::var("WHY").is_ok() { line += &format!("{:?}", a.ending); }
            }
        }
        eprintln!("{line}");
    }
}
