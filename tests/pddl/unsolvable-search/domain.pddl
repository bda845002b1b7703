; Everything can be reached, but not together: whatever is bought is paid with the one coin.
(define (domain unsolvable-search)
  (:requirements :adl)
  (:types ware)
  (:predicates (coin) (has ?w - ware) (swapped))
  (:action buy :parameters (?w - ware) :precondition (coin) :effect (and (has ?w) (not (coin))))
  (:action swap :parameters (?a ?b - ware) :precondition (and (has ?a) (not (has ?b)) (not (= ?a ?b)))
    :effect (and (not (has ?a)) (has ?b) (swapped))))
