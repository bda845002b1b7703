; Over no object a universal condition holds; actions that take one are never used, effects on all of them do nothing.
(define (domain empty-type)
  (:requirements :adl)
  (:types door window)
  (:predicates (open ?x - object) (checked))
  (:action open :parameters (?d - door) :precondition (forall (?w - window) (open ?w)) :effect (open ?d))
  (:action check :parameters (?d - door) :precondition (open ?d)
    :effect (and (checked) (not (open ?d)) (forall (?w - window) (not (checked)))))
  (:action smash :parameters (?w - window) :precondition () :effect (and (checked) (open ?w))))
