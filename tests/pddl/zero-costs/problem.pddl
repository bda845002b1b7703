; cost 2: walk s1 s2 s3 s4, ride s4 s5 for 2, walk back to s3; the rides s1 s5 and s1 s3 cost 3 and 5.
(define (problem zero-costs-1)
  (:domain zero-costs)
  (:objects s1 s2 s3 s4 s5 - spot)
  (:init (at s1) (path s1 s2) (path s2 s3) (path s3 s4) (path s5 s4) (path s4 s3) (line s1 s5) (line s1 s3) (line s4 s5)
    (= (fare s1 s5) 3) (= (fare s1 s3) 5) (= (fare s4 s5) 2) (= (total-cost) 0))
  (:goal (and (at s3) (stamped)))
  (:metric minimize (total-cost)))
