; cost 3: open d2, check with it, open it again.
(define (problem empty-type-1)
  (:domain empty-type)
  (:objects d1 d2 - door)
  (:init (open d1))
  (:goal (and (checked) (forall (?d - door) (open ?d)) (forall (?w - window) (not (open ?w))))))
