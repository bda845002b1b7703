; Constants in preconditions, effects, derived predicates and conditions; two things that are no constants never match.
(define (domain constants)
  (:requirements :adl :derived-predicates)
  (:types part place)
  (:constants bench store - place glue - part)
  (:predicates (at ?x - part ?p - place) (fixed ?a ?b - part) (ready) (whole ?a - part))
  (:derived (ready) (and (at glue bench) (exists (?x - part) (and (at ?x bench) (not (= ?x glue))))))
  (:derived (whole ?a - part) (exists (?b - part) (or (fixed ?a ?b) (fixed ?b ?a))))
  (:action bring :parameters (?x - part) :precondition (at ?x store) :effect (and (at ?x bench) (not (at ?x store))))
  (:action return :parameters (?x - part) :precondition (and (at ?x bench) (not (= ?x glue))) :effect (and (at ?x store) (not (at ?x bench))))
  (:action fix
    :parameters (?a ?b - part)
    :precondition (and (ready) (at ?a bench) (at ?b bench) (not (= ?a ?b)) (not (= ?a glue)) (not (= glue ?b)) (not (whole ?a)))
    :effect (and (fixed ?a ?b) (not (at glue bench)) (at glue store))))
