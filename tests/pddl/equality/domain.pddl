; Constants, variables that have to be equal or different, and an equality in an effect's condition.
(define (domain equality)
  (:requirements :adl)
  (:types place - object home - place)
  (:constants base - home depot - place)
  (:predicates (at ?p - place) (full ?p - place) (fuel))
  (:action go
    :parameters (?a ?b - place)
    :precondition (and (at ?a) (not (= ?a ?b)) (or (= ?a base) (= ?b base)))
    :effect (and (not (at ?a)) (at ?b) (when (= ?b depot) (fuel)) (when (not (= ?b depot)) (not (fuel)))))
  (:action fill
    :parameters (?h - home ?p - place)
    :precondition (and (= ?h ?p) (at ?p) (forall (?q - place) (imply (full ?q) (not (= ?q ?p)))))
    :effect (full ?h))
  (:action fill-elsewhere
    :parameters (?p - place)
    :precondition (and (at ?p) (not (= ?p base)) (not (= depot ?p)) (full base))
    :effect (and (full ?p) (forall (?q - place) (when (and (full ?q) (not (= ?q ?p))) (not (full ?q)))))))
