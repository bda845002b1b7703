(define (problem logistics-small)
  (:domain logistics)
  (:objects
    c0 c1 c2 - city
    p0-1 p0-2 p1-1 p1-2 p2-1 p2-2 - place
    p0-0 p1-0 p2-0 - airport
    t0 t1 t2 - truck
    a0 - aeroplane
    x0 x1 x2 x3 x4 - package)
  (:init
    (within p0-0 c0) (within p0-1 c0) (within p0-2 c0) (within p1-0 c1) (within p1-1 c1) (within p1-2 c1)
    (within p2-0 c2) (within p2-1 c2) (within p2-2 c2) (at t0 p0-1) (at t1 p1-1) (at t2 p2-1)
    (at a0 p1-0) (at x0 p2-2) (at x1 p1-1) (at x2 p2-1) (at x3 p2-1) (at x4 p1-2))
  (:goal (and
    (at x0 p0-1) (at x1 p1-1) (at x2 p0-0) (at x3 p0-0) (at x4 p2-0))))
