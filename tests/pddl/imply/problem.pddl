; cost 4: gloves on, the jar to the shelf, gloves off, the book to the shelf. The pan stays where it is hot.
(define (problem imply-1)
  (:domain imply)
  (:objects jar pan book - thing table shelf oven - place)
  (:init (at jar table) (at pan oven) (at book table) (glass jar) (hot pan) (shelf shelf) (oven oven))
  (:goal (and (not (gloves)) (imply (glass jar) (at jar shelf)) (at book shelf)
    (forall (?t - thing ?p - place) (imply (at ?t ?p) (imply (hot ?t) (oven ?p)))) (hot pan)
    (imply (at jar table) (at book oven)) (exists (?p - place) (and (at pan ?p) (not (shelf ?p)))))))
