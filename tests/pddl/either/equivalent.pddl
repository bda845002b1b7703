; The same without `either`, which Fast Downward does not read: a type above each pair.
(define (domain either)
  (:requirements :adl)
  (:types carrier crate - movable van ship - carrier lorry - van port town - spot)
  (:predicates (at ?x - movable ?p - spot) (in ?c - crate ?v - carrier))
  (:action sail :parameters (?s - ship ?a ?b - port) :precondition (at ?s ?a) :effect (and (not (at ?s ?a)) (at ?s ?b)))
  (:action drive
    :parameters (?v - van ?a ?b - spot)
    :precondition (at ?v ?a)
    :effect (and (not (at ?v ?a)) (at ?v ?b)))
  (:action load
    :parameters (?c - crate ?v - carrier ?p - spot)
    :precondition (and (at ?c ?p) (at ?v ?p) (not (exists (?d - crate) (in ?d ?v))))
    :effect (and (not (at ?c ?p)) (in ?c ?v)))
  (:action unload-all
    :parameters (?p - spot)
    :precondition ()
    :effect (forall (?c - crate ?v - carrier)
      (when (and (in ?c ?v) (at ?v ?p)) (and (not (in ?c ?v)) (at ?c ?p))))))
