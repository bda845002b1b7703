use typelift::agent::*;
use typelift::model::*;
use typelift_kitchen::*;
use typelift_tests::*;
#[test]
fn s() {
    let model = kitchen_model(false);
    for (what, options) in [
        ("restart", paper_options(true)),
        ("restart-noimag", paper_options(false)),
        ("go on", Options { imagine: Some(Default::default()), ..Options::default() }),
        ("go on noimag", Options::default()),
    ] {
        println!("== {what}");
        for task in faults() {
            for seed in 0..5 {
                let t = std::time::Instant::now();
                let a = solve(&model, &task, seed, &options, &Budget::with_expansions(200_000));
                let fails: Vec<String> = a
                    .failures
                    .iter()
                    .map(|f| {
                        format!(
                            "{}#{}:{:?} {}",
                            f.call,
                            f.step,
                            f.result,
                            f.excluded.iter().map(|e| e.object.to_string()).collect::<Vec<_>>().join(",")
                        )
                    })
                    .collect();
                println!(
                    "{:40} {seed} solved={} prop={} act={} plan={:?} exp={} rel={} lift={} {:?} {} | {}",
                    task.name,
                    a.solved(),
                    a.proposals,
                    a.actions,
                    a.plan.as_ref().map(|p| p.len()),
                    a.expansions,
                    a.relaxed,
                    a.lifted,
                    t.elapsed(),
                    if a.solved() { String::new() } else { format!("{:?}", a.ending) },
                    fails.join("; ")
                );
            }
        }
    }
}
