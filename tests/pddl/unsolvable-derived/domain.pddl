; What has to be false is derived from what cannot be avoided.
(define (domain unsolvable-derived)
  (:requirements :adl :derived-predicates)
  (:types switch)
  (:predicates (up ?s - switch) (pair ?a ?b - switch) (light))
  (:derived (light) (exists (?a ?b - switch) (and (pair ?a ?b) (or (and (up ?a) (not (up ?b))) (and (up ?b) (not (up ?a)))))))
  (:action flip-both :parameters (?a ?b - switch) :precondition (pair ?a ?b)
    :effect (and (when (up ?a) (not (up ?a))) (when (not (up ?a)) (up ?a)) (when (up ?b) (not (up ?b))) (when (not (up ?b)) (up ?b)))))
