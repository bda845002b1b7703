; unsolvable
(define (problem unsolvable-derived-1)
  (:domain unsolvable-derived)
  (:objects s1 s2 s3 s4 - switch)
  (:init (pair s1 s2) (pair s2 s3) (pair s3 s4) (up s1))
  (:goal (not (light))))
