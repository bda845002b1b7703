; Costs that nothing minimizes: every step counts 1.
(define (domain no-metric)
  (:requirements :typing :action-costs)
  (:types spot)
  (:predicates (at ?s - spot) (path ?a ?b - spot))
  (:functions (total-cost) - number (length ?a ?b - spot) - number)
  (:action go :parameters (?a ?b - spot) :precondition (and (at ?a) (path ?a ?b))
    :effect (and (not (at ?a)) (at ?b) (increase (total-cost) (length ?a ?b)))))
