//! Traces of the kitchen that somebody else recorded, in the folder that `TYPELIFT_TRACES` names.

use std::path::PathBuf;

use crate::common::{Folder, names};

#[test]
fn recorded_traces_agree_with_the_simulator_and_with_the_paper() {
    let Some(traces) = std::env::var_os("TYPELIFT_TRACES").map(PathBuf::from) else {
        println!("skipped: TYPELIFT_TRACES is not set");
        return;
    };
    // What the tests are started in is not what the program is started in.
    let traces = traces.canonicalize().expect("TYPELIFT_TRACES names a folder");
    let shown = traces.display();
    let folder = Folder::kitchen();
    let ignore = "location,orientation,interacts_with";
    let learned = folder.run(&format!("learn '{shown}' --types K/types.pddl --ignore {ignore} -o m.json"));
    learned.succeeds();
    assert!(learned.out.starts_with("68 transitions, "), "{learned}");
    assert!(learned.out.contains("\n39 individual actions\n13 generalized actions:"), "{learned}");
    let mut replayed = 0;
    for name in names(&traces).iter().filter(|name| name.ends_with(".jsonl")) {
        let replay = folder.run(&format!("kitchen replay '{shown}/{name}'"));
        replay.succeeds();
        assert!(replay.out.contains(": no difference in "), "{replay}");
        replayed += 1;
    }
    assert!(replayed > 0, "there are no traces in {shown}");
}
