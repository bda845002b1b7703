; All conditions are read before anything changes.
(define (domain swap)
  (:requirements :adl)
  (:types cell)
  (:predicates (black ?c - cell) (white ?c - cell) (next ?a ?b - cell))
  (:action swap
    :parameters (?a ?b - cell)
    :precondition (next ?a ?b)
    :effect (and
      (when (black ?a) (and (black ?b) (not (black ?a))))
      (when (black ?b) (and (black ?a) (not (black ?b))))
      (when (white ?a) (and (white ?b) (not (white ?a))))
      (when (white ?b) (and (white ?a) (not (white ?b))))))
  (:action invert
    :parameters ()
    :precondition ()
    :effect (forall (?c - cell) (and
      (when (black ?c) (and (white ?c) (not (black ?c))))
      (when (white ?c) (and (black ?c) (not (white ?c))))))))
