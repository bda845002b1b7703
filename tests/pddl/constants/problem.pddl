; cost 7: glue, x and y to the bench, fix y to z, glue again, fix x to y; z back.
(define (problem constants-1)
  (:domain constants)
  (:objects x y z - part)
  (:init (at glue store) (at x store) (at y store) (at z bench))
  (:goal (and (whole x) (whole y) (whole z) (at z store) (not (exists (?a - part) (fixed z ?a))))))
