(define (problem blocks-small)
  (:domain blocks)
  (:objects b0 b1 b2 b3 b4 b5 b6 b7)
  (:init
    (hand-empty) (on-table b6) (clear b4) (on b3 b6) (on b1 b3) (on b7 b1)
    (on b2 b7) (on b4 b2) (on-table b0) (clear b0) (on-table b5) (clear b5))
  (:goal (and
    (on b2 b4) (on b5 b2) (on b7 b5) (on b0 b7) (on b1 b0) (on b6 b1))))
