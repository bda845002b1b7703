; Parameters that are of either of two types, alone, in a quantifier and in an effect.
(define (domain either)
  (:requirements :adl)
  (:types van ship crate - object lorry - van port town - object)
  (:predicates (at ?x - (either van ship crate) ?p - (either port town)) (in ?c - crate ?v - (either van ship)))
  (:action sail :parameters (?s - ship ?a ?b - port) :precondition (at ?s ?a) :effect (and (not (at ?s ?a)) (at ?s ?b)))
  (:action drive
    :parameters (?v - van ?a ?b - (either port town))
    :precondition (at ?v ?a)
    :effect (and (not (at ?v ?a)) (at ?v ?b)))
  (:action load
    :parameters (?c - crate ?v - (either ship van) ?p - (either port town))
    :precondition (and (at ?c ?p) (at ?v ?p) (not (exists (?d - crate) (in ?d ?v))))
    :effect (and (not (at ?c ?p)) (in ?c ?v)))
  (:action unload-all
    :parameters (?p - (either port town))
    :precondition ()
    :effect (forall (?c - crate ?v - (either van ship))
      (when (and (in ?c ?v) (at ?v ?p)) (and (not (in ?c ?v)) (at ?c ?p))))))
