; cost 5: fetch and build twice, from f1 to f4 and from f2 to f3; settle in f3.
(define (problem stratified-negation-1)
  (:domain stratified-negation)
  (:objects f0 f1 f2 f3 f4 f5 - field)
  (:init (spring f1) (lower f2 f1) (lower f3 f2) (lower f4 f3) (lower f4 f1) (lower f5 f4))
  (:goal (and (house f3) (flooded f2) (safe f5))))
