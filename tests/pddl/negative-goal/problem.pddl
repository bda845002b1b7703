; cost 5: wait; l3 and l2 break, then l1 hands on to l2, which breaks again: l1 itself may not.
(define (problem negative-goal-1)
  (:domain negative-goal)
  (:objects l1 l2 l3 - lamp)
  (:init (on l1) (on l2) (on l3) (next l1 l2) (next l2 l3))
  (:goal (and (not (on l1)) (not (on l2)) (not (on l3)) (not (broken l1)) (dark))))
