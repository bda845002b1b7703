; Pednault's briefcase: what is inside moves along.
(define (domain universal-effect)
  (:requirements :adl)
  (:types place thing)
  (:predicates (at ?t - thing ?p - place) (in ?t - thing) (is-at ?p - place))
  (:action move
    :parameters (?a ?b - place)
    :precondition (and (is-at ?a) (not (= ?a ?b)))
    :effect (and (is-at ?b) (not (is-at ?a)) (forall (?t - thing) (when (in ?t) (and (at ?t ?b) (not (at ?t ?a)))))))
  (:action put-in
    :parameters (?t - thing ?p - place)
    :precondition (and (at ?t ?p) (is-at ?p) (not (in ?t)))
    :effect (in ?t))
  (:action take-out :parameters (?t - thing) :precondition (in ?t) :effect (not (in ?t))))
