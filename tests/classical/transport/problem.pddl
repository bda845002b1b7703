(define (problem transport-small)
  (:domain transport)
  (:objects
    p0 p1 p2 p3 p4 p5 - place
    l0 l1 - lorry
    x0 x1 x2 x3 - package
    r0 r1 r2 - room)
  (:init
    (road p0 p1) (road p1 p0) (= (length p0 p1) 18) (= (length p1 p0) 18) (road p0 p3) (road p3 p0)
    (= (length p0 p3) 13) (= (length p3 p0) 13) (road p1 p2) (road p2 p1) (= (length p1 p2) 27) (= (length p2 p1) 27)
    (road p1 p4) (road p4 p1) (= (length p1 p4) 15) (= (length p4 p1) 15) (road p2 p3) (road p3 p2)
    (= (length p2 p3) 17) (= (length p3 p2) 17) (road p3 p4) (road p4 p3) (= (length p3 p4) 4) (= (length p4 p3) 4)
    (road p4 p5) (road p5 p4) (= (length p4 p5) 19) (= (length p5 p4) 19) (road p5 p0) (road p0 p5)
    (= (length p5 p0) 6) (= (length p0 p5) 6) (one-less r0 r1) (one-less r1 r2) (at l0 p0) (at l1 p3)
    (left l0 r2) (left l1 r1) (= (total-cost) 0) (at x0 p0) (at x1 p3) (at x2 p2)
    (at x3 p4))
  (:goal (and
    (at x0 p1) (at x1 p1) (at x2 p5) (at x3 p3)))
  (:metric minimize (total-cost)))
