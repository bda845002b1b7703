(DEFINE (Domain blocks)
  (:predicates (on ?x ?y) (clear ?x) (hand-empty))
  (:action stack :parameters (?x ?y) :precondition (and (clear ?x) (clear ?y) (hand-empty))
    :effect (and (on ?x ?y) (not (clear ?y)))))
