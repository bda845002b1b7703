; cost 5: the heavy b1 goes down where the others stand, for p1 alone is not weak; they move to a pad each.
(define (problem quantified-goal-1)
  (:domain quantified-goal)
  (:objects b1 b2 b3 - box p1 p2 p3 - pad)
  (:init (carried b1) (heavy b1) (on b2 p1) (on b3 p1) (weak p2) (weak p3))
  (:goal (and
    (forall (?b - box) (exists (?p - pad) (on ?b ?p)))
    (forall (?p - pad ?a ?b - box) (imply (and (on ?a ?p) (on ?b ?p)) (= ?a ?b)))
    (exists (?p - pad) (forall (?b - box) (imply (on ?b ?p) (heavy ?b)))))))
