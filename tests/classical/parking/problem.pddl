(define (problem parking-small)
  (:domain parking)
  (:objects
    c0 c1 c2 c3 c4 c5 - car
    k0 k1 k2 k3 - curb)
  (:init
    (at-curb c4 k0) (behind c0 c4) (at-curb c5 k1) (behind c3 c5) (at-curb c1 k2) (behind c2 c1)
    (first c4) (car-clear c0) (first c5) (car-clear c3) (first c1) (car-clear c2)
    (curb-clear k3))
  (:goal (and
    (at-curb c2 k0) (behind c3 c2) (at-curb c1 k1) (behind c5 c1) (at-curb c4 k2) (behind c0 c4))))
