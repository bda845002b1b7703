; A door opens to whoever has its key, or is strong and has rested. The cases overlap.
(define (domain disjunctive-precondition)
  (:requirements :adl)
  (:types room door)
  (:predicates (in ?r - room) (open ?d - door) (joins ?d - door ?a ?b - room) (key ?d - door) (strong) (rested))
  (:action rest :parameters () :precondition () :effect (rested))
  (:action open
    :parameters (?d - door ?r - room)
    :precondition (and (in ?r)
      (exists (?s - room) (or (joins ?d ?r ?s) (joins ?d ?s ?r)))
      (or (key ?d) (and (strong) (rested))))
    :effect (and (open ?d) (not (rested))))
  (:action go
    :parameters (?d - door ?a ?b - room)
    :precondition (and (in ?a) (open ?d) (or (joins ?d ?a ?b) (joins ?d ?b ?a)))
    :effect (and (not (in ?a)) (in ?b)))
  (:action take
    :parameters (?d - door ?r - room)
    :precondition (or (and (in ?r) (joins ?d ?r ?r)) (key ?d))
    :effect (key ?d)))
