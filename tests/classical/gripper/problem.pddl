(define (problem gripper-small)
  (:domain gripper)
  (:objects
    here there - room
    b0 b1 b2 b3 b4 b5 - ball
    left right - hand)
  (:init
    (robot-at here) (free left) (free right) (at b0 here) (at b1 here) (at b2 here)
    (at b3 here) (at b4 here) (at b5 here))
  (:goal (and
    (at b0 there) (at b1 there) (at b2 there) (at b3 there) (at b4 there) (at b5 there))))
