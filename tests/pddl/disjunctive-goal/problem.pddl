; cost 4: dig in s1, whose flag falls, and on to s4.
(define (problem disjunctive-goal-1)
  (:domain disjunctive-goal)
  (:objects s1 s2 s3 s4 s5 s6 - spot)
  (:init (at s1) (next s1 s2) (next s2 s3) (next s3 s4) (next s4 s5) (next s5 s4) (flag s1) (flag s3))
  (:goal (or (at s6) (and (found s5) (at s4)) (and (at s4) (exists (?s - spot) (and (found ?s) (not (flag ?s)) (not (= ?s s4))))))))
