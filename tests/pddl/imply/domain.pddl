; Glass needs gloves, and what is hot does too: implications in a precondition, and in the goal.
(define (domain imply)
  (:requirements :adl)
  (:types thing place)
  (:predicates (at ?t - thing ?p - place) (glass ?t - thing) (hot ?t - thing) (gloves) (shelf ?p - place) (oven ?p - place))
  (:action put-on :parameters () :precondition (not (gloves)) :effect (gloves))
  (:action put-off :parameters () :precondition (gloves) :effect (not (gloves)))
  (:action move
    :parameters (?t - thing ?a ?b - place)
    :precondition (and (at ?t ?a) (imply (or (glass ?t) (hot ?t)) (gloves)) (imply (gloves) (or (glass ?t) (hot ?t))))
    :effect (and (not (at ?t ?a)) (at ?t ?b) (when (oven ?b) (hot ?t)) (when (not (oven ?b)) (not (hot ?t))))))
