; Roads of different lengths and a toll: the sum of a function and a number, and a way of more steps is cheaper.
(define (domain costs)
  (:requirements :typing :action-costs)
  (:types town)
  (:predicates (at ?t - town) (road ?a ?b - town) (pass))
  (:functions (total-cost) - number (length ?a ?b - town) - number (toll ?t - town) - number)
  (:action drive
    :parameters (?a ?b - town)
    :precondition (and (at ?a) (road ?a ?b))
    :effect (and (not (at ?a)) (at ?b) (increase (total-cost) (length ?a ?b))))
  (:action fly
    :parameters (?a ?b - town)
    :precondition (and (at ?a) (pass))
    :effect (and (not (at ?a)) (at ?b) (increase (total-cost) 10)))
  (:action buy :parameters (?t - town) :precondition (at ?t) :effect (and (pass) (increase (total-cost) (toll ?t)))))
