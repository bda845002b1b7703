; unsolvable
(define (problem unsolvable-forall-1)
  (:domain unsolvable-forall)
  (:objects d1 d2 - door)
  (:init (open d1))
  (:goal (and (open d2) (done))))
