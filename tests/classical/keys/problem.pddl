(define (problem keys-small)
  (:domain keys)
  (:objects
    p00 p01 p02 p03 p10 p11 p12 p13 p20 p21 p22 p23 p30 p31 p32 p33 - place
    k0 k1 k2 k3 - key
    round square - shape)
  (:init
    (next p00 p10) (next p00 p01) (next p01 p11) (next p01 p02) (next p01 p00) (next p02 p12)
    (next p02 p03) (next p02 p01) (next p03 p13) (next p03 p02) (next p10 p20) (next p10 p11)
    (next p10 p00) (next p11 p21) (next p11 p12) (next p11 p01) (next p11 p10) (next p12 p22)
    (next p12 p13) (next p12 p02) (next p12 p11) (next p13 p23) (next p13 p03) (next p13 p12)
    (next p20 p30) (next p20 p21) (next p20 p10) (next p21 p31) (next p21 p22) (next p21 p11)
    (next p21 p20) (next p22 p32) (next p22 p23) (next p22 p12) (next p22 p21) (next p23 p33)
    (next p23 p13) (next p23 p22) (next p30 p31) (next p30 p20) (next p31 p32) (next p31 p21)
    (next p31 p30) (next p32 p33) (next p32 p22) (next p32 p31) (next p33 p23) (next p33 p32)
    (at-robot p00) (hand-empty) (open p00) (open p01) (open p02) (locked p03)
    (lock p03 square) (open p10) (open p11) (open p12) (open p13) (locked p20)
    (lock p20 round) (locked p21) (lock p21 square) (locked p22) (lock p22 round) (locked p23)
    (lock p23 round) (open p30) (open p31) (open p32) (open p33) (at k0 p03)
    (at k1 p11) (at k2 p33) (at k3 p10) (fits k0 round) (fits k1 square) (fits k2 square)
    (fits k3 round))
  (:goal (and
    (at k0 p30) (at k2 p01) (at k1 p32))))
