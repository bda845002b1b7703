; cost 5: send n1 n3 and n3 n2 in the ring, cut n3 n1, join n3 to n5, send n1 n5.
(define (problem transitive-closure-1)
  (:domain transitive-closure)
  (:objects n1 n2 n3 n4 n5 - node)
  (:init (link n1 n2) (link n2 n3) (link n3 n1) (link n4 n5))
  (:goal (and (sent n1 n3) (sent n3 n2) (sent n1 n5) (not (reaches n3 n1)))))
