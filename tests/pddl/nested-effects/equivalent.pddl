; The same with quantifiers outside of conditions, as Fast Downward reads it.
(define (domain nested-effects)
  (:requirements :adl)
  (:types tank)
  (:predicates (full ?t - tank) (pipe ?a ?b - tank) (valve ?a ?b - tank) (alarm) (pump))
  (:action turn :parameters (?a ?b - tank) :precondition (pipe ?a ?b)
    :effect (and (when (valve ?a ?b) (not (valve ?a ?b))) (when (not (valve ?a ?b)) (valve ?a ?b))))
  (:action run :parameters () :precondition ()
    :effect (and
      (forall (?a ?b - tank)
        (when (and (pump) (full ?a) (pipe ?a ?b) (valve ?a ?b) (not (full ?b))) (and (full ?b) (not (full ?a)))))
      (when (exists (?a ?b - tank) (and (pipe ?a ?b) (not (valve ?a ?b)) (full ?a)
          (forall (?c - tank) (or (not (pipe ?b ?c)) (not (= ?c ?a)))))) (alarm))
      (when (not (pump)) (pump)))))
