; cost 2: the dear way of two steps, not the cheap one of three.
(define (problem no-metric-1)
  (:domain no-metric)
  (:objects s1 s2 s3 s4 - spot)
  (:init (at s1) (path s1 s2) (path s2 s3) (path s3 s4) (path s2 s4) (= (total-cost) 0)
    (= (length s1 s2) 1) (= (length s2 s3) 1) (= (length s3 s4) 1) (= (length s2 s4) 50))
  (:goal (at s4)))
