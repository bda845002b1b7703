; cost 5: p2 to w1, a colour for p2, a brush for each, start.
(define (problem forall-exists-1)
  (:domain forall-exists)
  (:objects w1 w2 - wall p1 p2 - painter red blue - colour b1 b2 - brush)
  (:init (at p1 w2) (has p1 red) (at p2 w2))
  (:goal (and (started) (forall (?w - wall) (painted ?w)))))
