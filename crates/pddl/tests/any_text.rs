//! Whatever the text, it is read or refused with a place that can be shown.

use proptest::prelude::*;
use typelift_model::testing::cases;
use typelift_pddl::{
    Domain, PddlError, format as lay_out, read_domain, read_hierarchy, read_objects, read_plan, read_problem,
    read_trajectory,
};

fn shown<T>(read: Result<T, PddlError>, text: &str) {
    if let Err(error) = read {
        assert!(error.render("file", text).starts_with(&format!("file:{}:", error.position.line)));
    }
}

/// Texts of the words that the readers look for.
fn text() -> impl Strategy<Value = String> {
    let word = prop::sample::select(vec![
        "(",
        ")",
        "(",
        ")",
        "-",
        " ",
        "\n",
        "\t",
        "a ",
        "b ",
        "?x",
        "é",
        ";",
        ":types ",
        "(either ",
        "object ",
        "(define ",
        "(domain d)",
        "(problem p)",
        "(:objects ",
        "(:trajectory ",
        "(:state ",
        "(:action ",
        "(:init ",
        "(operator: ",
        "(:transition_status ",
        "(not ",
        "(= ",
        "(:predicates ",
        "(a ?x)",
        "(:constants ",
        "(:derived ",
        ":parameters ",
        ":precondition ",
        ":effect ",
        "(and ",
        "(forall (?x)",
        "(when ",
        "(increase (total-cost)",
        "(:functions (total-cost))",
        "(:goal ",
        "(:domain d)",
        "(a b)",
    ]);
    prop_oneof![prop::collection::vec(word, 0..24).prop_map(|words| words.concat()), "\\PC{0,30}"]
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn any_text_is_read_or_refused(text in text()) {
        shown(read_hierarchy(&text), &text);
        shown(read_objects(&text), &text);
        shown(read_trajectory(&text), &text);
        shown(read_domain(&text), &text);
        shown(read_problem(&text, &Domain::default()), &text);
        shown(read_plan(&text), &text);
        shown(lay_out(&text), &text);
        // Balanced, and within a definition.
        let closed = |text: String| {
            let open = text.matches('(').count().saturating_sub(text.matches(')').count());
            format!("{text}\n{}", ")".repeat(open))
        };
        let domain = closed(format!("(define (domain d) {text}"));
        shown(read_domain(&domain), &domain);
        let problem = closed(format!("(define (problem p) (:domain d) (:objects b) (:init {text}"));
        let declared = read_domain("(define (domain d) (:predicates (a ?x)))").expect("a domain");
        shown(read_problem(&problem, &declared), &problem);
    }
}

#[test]
fn deep_nesting_is_refused_without_overflow() {
    let deep = format!("{}{}", "(".repeat(100_000), ")".repeat(100_000));
    for text in [deep.clone(), format!("(:types {deep})"), format!("(:trajectory (:state {deep}))")] {
        assert!(read_domain(&text).is_err() && read_problem(&text, &Domain::default()).is_err());
        assert!(read_hierarchy(&text).is_err() && read_objects(&text).is_err() && read_trajectory(&text).is_err());
    }
}
