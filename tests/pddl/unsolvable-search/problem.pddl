; unsolvable
(define (problem unsolvable-search-1)
  (:domain unsolvable-search)
  (:objects bread milk salt - ware)
  (:init (coin))
  (:goal (and (exists (?a ?b - ware) (and (has ?a) (has ?b) (not (= ?a ?b)))))))
