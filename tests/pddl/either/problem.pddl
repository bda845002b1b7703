; cost 7: load and drive each crate to p2, unload it there, and drive back for the second: no ship is needed.
(define (problem either-1)
  (:domain either)
  (:objects l1 - lorry s1 - ship c1 c2 - crate p1 p2 - port t1 - town)
  (:init (at l1 t1) (at s1 p2) (at c1 t1) (at c2 t1))
  (:goal (and (at c1 p2) (forall (?c - crate) (exists (?p - port) (at ?c ?p))))))
