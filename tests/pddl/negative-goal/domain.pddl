; Lights out: negative preconditions and a negative goal, of what holds at first and of what has to hold meanwhile.
(define (domain negative-goal)
  (:requirements :strips :typing :negative-preconditions)
  (:types lamp)
  (:predicates (on ?l - lamp) (next ?a ?b - lamp) (broken ?l - lamp) (dark))
  (:action off
    :parameters (?a ?b - lamp)
    :precondition (and (next ?a ?b) (on ?a) (not (on ?b)) (not (broken ?a)))
    :effect (and (not (on ?a)) (on ?b)))
  (:action last
    :parameters (?a - lamp)
    :precondition (and (on ?a) (not (next ?a ?a)))
    :effect (and (not (on ?a)) (broken ?a)))
  (:action wait :parameters () :precondition (not (dark)) :effect (dark)))
