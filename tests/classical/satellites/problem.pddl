(define (problem satellites-small)
  (:domain satellites)
  (:objects
    s0 s1 - satellite
    i0 i1 i2 - instrument
    colour infrared depth - mode
    d0 d1 d2 d3 d4 d5 d6 - direction)
  (:init
    (aboard i0 s0) (aboard i1 s0) (aboard i2 s1) (supports i0 colour) (supports i1 infrared) (supports i2 infrared)
    (supports i2 depth) (target i0 d1) (target i1 d2) (target i2 d0) (points s0 d5) (points s1 d6)
    (power-left s0) (power-left s1))
  (:goal (and
    (have d3 colour) (have d4 infrared) (have d5 depth) (have d6 colour) (have d2 depth) (points s0 d4))))
