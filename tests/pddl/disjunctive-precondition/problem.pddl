; cost 6: rest, open d1, rest, open d3, through it into the cellar, open d2 with its key.
(define (problem disjunctive-precondition-1)
  (:domain disjunctive-precondition)
  (:objects hall kitchen cellar - room d1 d2 d3 - door)
  (:init (in hall) (strong) (joins d1 hall kitchen) (joins d2 cellar kitchen) (joins d3 hall cellar) (key d2))
  (:goal (and (in cellar) (open d1) (open d2) (open d3))))
