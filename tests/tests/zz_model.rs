use typelift_tests::*;
#[test]
fn s() {
    let m = kitchen_model(false);
    for a in &m.actions {
        println!(
            "{} {:?} {:?}\n   pre {:?}\n   eff {:?} src {}",
            a.name,
            a.call,
            a.parameters.iter().map(|p| m.hierarchy.name(p.ty).to_string()).collect::<Vec<_>>(),
            a.preconditions,
            a.effects.iter().map(|e| &e.literal).collect::<Vec<_>>(),
            a.provenance.sources().len()
        );
    }
}
