; cost 7: to the base, fill it, to p1, fill that, which empties the base, back, fill it again, to the depot.
(define (problem equality-1)
  (:domain equality)
  (:objects p1 p2 - place h1 - home)
  (:init (at p2))
  (:goal (and (full base) (full p1) (at depot) (fuel) (not (= base depot)) (exists (?h - home) (not (full ?h))))))
