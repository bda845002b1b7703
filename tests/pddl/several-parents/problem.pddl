; cost 10: whet the dagger and wash it, wash the axe, whet the sword, wash the hammer, polish all four, and show them.
(define (problem several-parents-1)
  (:domain several-parents)
  (:objects d - dagger a - axe s - sword h - hammer)
  (:init)
  (:goal (and (shown) (sharp d) (clean a) (forall (?k - knife) (clean ?k)))))
