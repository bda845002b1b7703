; Types of two kinds: declared twice, below `either`, and one of them through its parent; `either` over types that overlap.
(define (domain several-parents)
  (:requirements :adl :derived-predicates)
  (:types dagger - knife tool weapon - object knife - tool hammer - tool sword axe - (either weapon) axe - tool knife - weapon)
  (:predicates (clean ?t - tool) (sharp ?w - weapon) (shiny ?x - (either tool weapon)) (armed) (shown))
  (:derived (armed) (exists (?w - weapon) (and (sharp ?w) (exists (?t - tool) (= ?t ?w)))))
  (:action whet
    :parameters (?w - weapon)
    :effect (and (sharp ?w) (forall (?t - tool) (when (= ?t ?w) (not (clean ?t))))))
  (:action wash :parameters (?t - tool) :effect (clean ?t))
  (:action polish
    :parameters (?x - (either tool weapon))
    :precondition (or (exists (?t - tool) (and (= ?t ?x) (clean ?t))) (exists (?w - weapon) (and (= ?w ?x) (sharp ?w))))
    :effect (shiny ?x))
  (:action show
    :precondition (and (armed) (forall (?x - (either weapon tool)) (shiny ?x)))
    :effect (shown)))
