; cost 4: unstack a and b, b on a, d on c.
(define (problem derived-quantifiers-1)
  (:domain derived-quantifiers)
  (:objects a b c d - block)
  (:init (on a b) (on b c) (table c) (table d) (red a) (red c))
  (:goal (and (tidy) (above d c) (above b a) (not (above c a)))))
