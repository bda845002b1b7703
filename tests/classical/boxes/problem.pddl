(define (problem boxes-small)
  (:domain boxes)
  (:objects
    p00 p01 p02 p03 p04 p10 p11 p12 p13 p14 p20 p21 p23 p24 p30 p31 p32 p33 p34 p40 p41 p42 p43 p44 - place
    up down left right - direction
    b0 b1 - box)
  (:init
    (next p00 p01 down) (next p00 p10 right) (next p01 p00 up) (next p01 p02 down) (next p01 p11 right) (next p02 p01 up)
    (next p02 p03 down) (next p02 p12 right) (next p03 p02 up) (next p03 p04 down) (next p03 p13 right) (next p04 p03 up)
    (next p04 p14 right) (next p10 p11 down) (next p10 p00 left) (next p10 p20 right) (next p11 p10 up) (next p11 p12 down)
    (next p11 p01 left) (next p11 p21 right) (next p12 p11 up) (next p12 p13 down) (next p12 p02 left) (next p13 p12 up)
    (next p13 p14 down) (next p13 p03 left) (next p13 p23 right) (next p14 p13 up) (next p14 p04 left) (next p14 p24 right)
    (next p20 p21 down) (next p20 p10 left) (next p20 p30 right) (next p21 p20 up) (next p21 p11 left) (next p21 p31 right)
    (next p23 p24 down) (next p23 p13 left) (next p23 p33 right) (next p24 p23 up) (next p24 p14 left) (next p24 p34 right)
    (next p30 p31 down) (next p30 p20 left) (next p30 p40 right) (next p31 p30 up) (next p31 p32 down) (next p31 p21 left)
    (next p31 p41 right) (next p32 p31 up) (next p32 p33 down) (next p32 p42 right) (next p33 p32 up) (next p33 p34 down)
    (next p33 p23 left) (next p33 p43 right) (next p34 p33 up) (next p34 p24 left) (next p34 p44 right) (next p40 p41 down)
    (next p40 p30 left) (next p41 p40 up) (next p41 p42 down) (next p41 p31 left) (next p42 p41 up) (next p42 p43 down)
    (next p42 p32 left) (next p43 p42 up) (next p43 p44 down) (next p43 p33 left) (next p44 p43 up) (next p44 p34 left)
    (at b0 p11) (at b1 p31) (person p24) (clear p00) (clear p01) (clear p02)
    (clear p03) (clear p04) (clear p10) (clear p12) (clear p13) (clear p14)
    (clear p20) (clear p21) (clear p23) (clear p30) (clear p32) (clear p33)
    (clear p34) (clear p40) (clear p41) (clear p42) (clear p43) (clear p44))
  (:goal (and
    (at b0 p13) (at b1 p33))))
