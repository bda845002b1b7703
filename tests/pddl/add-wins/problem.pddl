; cost 3: from a to c, staying in a, which is sticky; from a to b, which puts c out; toggle a.
(define (problem add-wins-1)
  (:domain add-wins)
  (:objects a b c - place)
  (:init (at a) (sticky a) (lit b))
  (:goal (and (at a) (at b) (at c) (lit a) (lit b) (not (lit c)) (seen b))))
