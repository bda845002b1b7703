//! `diff`: what two models have in common, and what not.

use crate::common::{Folder, Transcript};

const LOADING: &str = "
(define (domain depot)
  (:requirements :typing :negative-preconditions :equality :conditional-effects)
  (:types truck place - object crate - object)
  (:predicates (at ?t - truck ?p - place) (in ?c - crate ?t - truck) (stands ?c - crate ?p - place) (wet ?c - crate))
  (:action load
    :parameters (?t - truck ?c - crate ?p - place)
    :precondition (and (at ?t ?p) (stands ?c ?p))
    :effect (and (in ?c ?t) (not (stands ?c ?p)) (when (wet ?c) (not (wet ?c)))))
  (:action drive
    :parameters (?t - truck ?from ?to - place)
    :precondition (and (at ?t ?from) (not (= ?from ?to)))
    :effect (and (at ?t ?to) (not (at ?t ?from)))))
";

#[test]
fn the_names_of_parameters_make_no_difference() {
    let folder = Folder::new();
    folder.write("a.pddl", LOADING);
    let renamed =
        LOADING.replace("?from", "?start").replace("?to", "?p2").replace("?c ", "?box ").replace("?c)", "?box)");
    folder.write("b.pddl", renamed.to_uppercase());
    let ended = folder.run("diff a.pddl b.pddl");
    assert_eq!((ended.code, ended.out.as_str()), (0, "the same\n"), "{ended}");
}

#[test]
fn what_differs_is_said_in_the_names_of_the_first() {
    let folder = Folder::new();
    folder.write("a.pddl", LOADING);
    let changed = LOADING
        .replace("truck place - object crate - object", "vehicle place crate - object truck - vehicle")
        .replace("(at ?t - truck ?p", "(at ?t - vehicle ?p")
        .replace("?t - truck ?from ?to - place", "?v - vehicle ?a ?b - place")
        .replace("(and (at ?t ?from) (not (= ?from ?to)))", "(at ?v ?a)")
        .replace("(and (at ?t ?to) (not (at ?t ?from)))))", "(and (at ?v ?b) (not (at ?v ?a))))")
        .replace(" (when (wet ?c) (not (wet ?c)))", "")
        + "(:action dry :parameters (?c - crate) :precondition (wet ?c) :effect (not (wet ?c))))";
    folder.write("b.pddl", changed);
    folder.write("bad.pddl", "(define (domain depot");
    let mut transcript = Transcript::default();
    for (code, command) in [
        (12, "diff a.pddl b.pddl"),
        (12, "diff b.pddl a.pddl --json"),
        (31, "diff a.pddl bad.pddl"),
        (31, "diff nowhere.json a.pddl"),
    ] {
        let ended = folder.run(command);
        assert_eq!(ended.code, code, "{command}: {ended}");
        transcript.add(command, &ended);
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn a_learned_model_is_its_export_and_no_other() {
    let folder = Folder::kitchen();
    folder.run("export kitchen.json -o exported -q").succeeds();
    let shown = folder.run("show kitchen.json --pddl");
    folder.write("shown.pddl", &shown.out);
    folder.run("diff kitchen.json exported/domain.pddl").succeeds();
    folder.run("diff shown.pddl kitchen.json --not-strict").succeeds();
    let ended = folder.run("diff kitchen.json shown.pddl");
    assert_eq!(ended.code, 12, "{ended}");
    assert!(ended.out.contains("    - not holding_holds(?x0,?x2)\n"), "{ended}");
    assert_eq!(ended.err, "hint: with --not-strict they are the same: the domain is not strict.\n");
    let ended = folder.run("diff kitchen.json exported/domain.pddl");
    assert_eq!(ended.err, "", "{ended}");
    folder
        .run("learn K/demos/cut_banana.jsonl K/demos/blend_carrot.jsonl --types K/types.pddl -o part.json -q")
        .succeeds();
    let ended = folder.run("diff kitchen.json part.json");
    assert_eq!(ended.code, 12, "{ended}");
    insta::assert_snapshot!(ended.out);
}

#[test]
fn models_act_alike_whatever_types_their_predicates_are_known_of() {
    let folder = Folder::new();
    folder.write("a.pddl", LOADING);
    folder.write("b.pddl", LOADING.replace("(wet ?c - crate)", "(wet ?c - object)"));
    let ended = folder.run("diff a.pddl b.pddl");
    let said = "- a.pddl\n+ b.pddl\nthe same, but for the types of which predicates are known\npredicates\n  \
                - wet(crate)\n  + wet(object)\n";
    assert_eq!((ended.code, ended.out.as_str()), (0, said), "{ended}");
    folder.write("c.pddl", LOADING.replace("(wet ?c - crate)", "(wet ?c - crate) (sold ?c - crate)"));
    let ended = folder.run("diff a.pddl c.pddl");
    assert_eq!(ended.code, 12, "another goal can be asked for: {ended}");
}
