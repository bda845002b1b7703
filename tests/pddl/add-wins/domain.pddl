; What one action adds and deletes holds afterwards, also if conditions decide, and if two names mean one place.
(define (domain add-wins)
  (:requirements :adl)
  (:types place)
  (:predicates (at ?p - place) (lit ?p - place) (sticky ?p - place) (seen ?p - place))
  (:action go
    :parameters (?a ?b - place)
    :precondition (at ?a)
    :effect (and (at ?b) (not (at ?a)) (seen ?b)
      (when (sticky ?a) (at ?a))
      (forall (?p - place) (when (lit ?p) (not (lit ?p))))
      (when (not (lit ?b)) (lit ?b))))
  (:action toggle
    :parameters (?p - place)
    :precondition (at ?p)
    :effect (and (when (lit ?p) (not (lit ?p))) (when (not (lit ?p)) (lit ?p)) (when (seen ?p) (lit ?p)))))
