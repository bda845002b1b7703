(define (domain lamps)
  (:requirements :adl :typing :derived-predicates :action-costs)
  (:types room lamp - object hall - room)
  (:constants home - hall)
  (:predicates (at ?r - room) (lit ?l - lamp) (in ?l - lamp ?r - room) (near ?a ?b - room)
    (safe ?r - room) (kept ?x - (either room lamp)))
  (:functions (total-cost) - number (steps ?a ?b - room) - number)
  ; dark corners are not
  (:derived (safe ?r - room) (forall (?l - lamp) (imply (in ?l ?r) (lit ?l))))
  (:action go
    :parameters (?a ?b - room)
    :precondition (and (at ?a) (or (near ?a ?b) (near ?b ?a)) (not (= ?a ?b)))
    :effect (and (not (at ?a)) (at ?b) (when (safe ?b) (kept ?b)) (increase (total-cost) (steps ?a ?b))))
  (:action switch
    :parameters (?l - lamp)
    :precondition (exists (?r - room) (and (at ?r) (in ?l ?r)))
    :effect (and (when (lit ?l) (not (lit ?l))) (when (not (lit ?l)) (lit ?l)) (increase (total-cost) 1)))
  (:action keep
    :parameters (?x - (either hall lamp))
    :effect (and (kept ?x) (forall (?y - lamp) (when (lit ?y) (kept ?y))))))
