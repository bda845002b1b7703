; A goal in cases of which one is near, one far, and one out of reach.
(define (domain disjunctive-goal)
  (:requirements :adl)
  (:types spot)
  (:predicates (at ?s - spot) (next ?a ?b - spot) (found ?s - spot) (flag ?s - spot))
  (:action go :parameters (?a ?b - spot) :precondition (and (at ?a) (next ?a ?b)) :effect (and (not (at ?a)) (at ?b)))
  (:action dig :parameters (?s - spot) :precondition (at ?s) :effect (and (found ?s) (when (flag ?s) (not (flag ?s))))))
