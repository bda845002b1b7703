//! Laying texts out anew.

use proptest::prelude::*;
use typelift_model::testing::cases;
use typelift_pddl::{Document, format};

#[track_caller]
fn formatted(text: &str) -> String {
    let once = format(text).expect("balanced");
    assert_eq!(format(&once).as_deref(), Ok(once.as_str()), "laying it out twice changes something");
    once
}

#[test]
fn only_white_space_of_ascii_ends_a_word() {
    for text in ["(p\u{A0} q\u{85})\n", "\u{B}\n", "\u{2003}(a)\n"] {
        let laid_out = formatted(text);
        let words = |text: &str| text.split([' ', '\n', '(', ')']).map(str::to_owned).collect::<String>();
        assert_eq!(words(&laid_out), words(text), "{text:?}");
    }
}

#[test]
fn a_domain() {
    let text = "; the top\r
;second line\r


(DEFINE (domain Blocks) ; a name
(:requirements :strips\t:typing) (:types block - object crate
 ; heavy ones
 box - block)
(:constants A B - block)
(:predicates (on ?x ?y - block)(clear ?x)

 (held ?x)) ; trailing
; first action
;   with two lines
(:action Pick :parameters (?x - block?y) :precondition (and (clear ?x) (or (held ?x) (forall (?z - block) (not (on ?z ?x)))))
:effect (and (held ?x) ; now
 (not (clear ?x)))
)
(:action noop :parameters ())(:derived (held ?x) (and (on ?x ?x) (clear ?x)))
)
; the end";
    let expected = "\
; the top
;second line

(DEFINE (domain Blocks) ; a name
  (:requirements :strips :typing)
  (:types
    block - object
    crate
    ; heavy ones
    box - block)
  (:constants A B - block)
  (:predicates
    (on ?x ?y - block)
    (clear ?x)

    (held ?x)) ; trailing

  ; first action
  ;   with two lines
  (:action Pick
    :parameters (?x - block ?y)
    :precondition (and
      (clear ?x)
      (or (held ?x) (forall (?z - block) (not (on ?z ?x)))))
    :effect (and
      (held ?x) ; now
      (not (clear ?x))))

  (:action noop
    :parameters ())

  (:derived (held ?x)
    (and
      (on ?x ?x)
      (clear ?x)))
)
; the end
";
    assert_eq!(formatted(text), expected);
}

#[test]
fn a_problem_and_long_lines() {
    let objects: Vec<String> = (0..30).map(|i| format!("object{i}")).collect();
    let text = format!(
        "(define (problem p) (:domain d) (:objects {} - t a b - u) (:init (p a)(= (total-cost) 0)) (:goal (and (p b)))
(:metric minimize (total-cost)))",
        objects.join(" ")
    );
    let expected = "\
(define (problem p)
  (:domain d)
  (:objects
    object0 object1 object2 object3 object4 object5 object6 object7 object8 object9 object10
    object11 object12 object13 object14 object15 object16 object17 object18 object19 object20
    object21 object22 object23 object24 object25 object26 object27 object28 object29 - t
    a b - u)
  (:init
    (p a)
    (= (total-cost) 0))
  (:goal (and
    (p b)))
  (:metric minimize (total-cost))
)
";
    assert_eq!(formatted(&text), expected);
}

#[test]
fn odd_texts() {
    for (text, expected) in [
        ("", ""),
        ("; only this", "; only this\n"),
        ("()", "()\n"),
        ("a (b)c", "a\n(b)\nc\n"),
        ("(a ; x\n)", "(a ; x\n)\n"),
        ("( ; x\n a)", "( ; x\n  a)\n"),
        ("(\n\n;y\n\n\n;z\n\na)", "(\n  ;y\n  ;z\n  a)\n"),
    ] {
        assert_eq!(formatted(text), expected, "{text}");
    }
    assert_eq!(
        format("(a").map_err(|error| error.to_string()),
        Err("line 1, column 1: this `(` is never closed".into())
    );
}

#[test]
fn depth_costs_no_stack() {
    for open in ["(", "(not ", "(and (p) "] {
        let text = format!("{}{}", open.repeat(100_000), ")".repeat(100_000));
        assert_eq!(words(&formatted(&text)), words(&text));
    }
}

/// The text without white space and comments.
fn words(text: &str) -> Vec<String> {
    let document = Document::read(text).expect("balanced");
    let mut words = Vec::new();
    let mut stack = vec![document.roots()];
    while let Some(parts) = stack.last_mut() {
        match parts.next() {
            Some(part) if part.is_list() => {
                words.push("(".to_owned());
                stack.push(part.children());
            }
            Some(part) => words.push(part.text().to_owned()),
            None => {
                words.push(")".to_owned());
                stack.pop();
            }
        }
    }
    words
}

fn comments(text: &str) -> Vec<&str> {
    text.lines().filter_map(|line| line.find(';').map(|at| line[at..].trim_end())).collect()
}

fn text() -> impl Strategy<Value = String> {
    let word = prop::sample::select(vec![
        "(define ",
        "(domain d)",
        "(:action ",
        ":effect ",
        "(:types ",
        "(:init ",
        "(:goal ",
        "(and ",
        "(forall ",
        "(",
        "(",
        ")",
        ")",
        ")",
        "a ",
        "bb ",
        "- ",
        "?x",
        "; c\n",
        ";",
        "\n",
        "\n\n",
        "\r\n",
        "\t",
        "é",
        "a-very-long-name-of-a-thing-that-fills-a-line ",
    ]);
    prop::collection::vec(word, 0..60).prop_map(|words| {
        let text = words.concat() + "\n";
        // Balanced, with what is missing.
        let (mut depth, mut prefix) = (0_usize, 0);
        for line in text.lines() {
            for c in line.chars().take_while(|c| *c != ';') {
                match c {
                    '(' => depth += 1,
                    ')' if depth == 0 => prefix += 1,
                    ')' => depth -= 1,
                    _ => {}
                }
            }
        }
        format!("{}{text}{}", "(".repeat(prefix), ")".repeat(depth))
    })
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn words_and_comments_stay(text in text()) {
        let once = format(&text).expect("balanced");
        prop_assert_eq!(words(&once), words(&text));
        prop_assert_eq!(comments(&once), comments(&text));
        prop_assert_eq!(format(&once), Ok(once));
    }
}
