; Over no object a universal goal holds, and an existential one never does.
(define (domain unsolvable-forall)
  (:requirements :adl)
  (:types door window)
  (:predicates (open ?x - object) (done))
  (:action open :parameters (?d - door) :precondition (forall (?w - window) (open ?w)) :effect (open ?d))
  (:action finish :parameters () :precondition (exists (?w - window) (open ?w)) :effect (done)))
