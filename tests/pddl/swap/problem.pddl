; cost 3: one inversion, and the white one moves to the end.
(define (problem swap-1)
  (:domain swap)
  (:objects c1 c2 c3 c4 - cell)
  (:init (next c1 c2) (next c2 c3) (next c3 c4) (black c1) (white c2) (black c3) (black c4))
  (:goal (and (white c1) (white c2) (white c3) (black c4) (not (white c4)) (not (exists (?c - cell) (and (black ?c) (white ?c)))))))
