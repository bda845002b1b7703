; Lorries of limited room carry packages on roads; driving costs the road's length.
(define (domain transport)
  (:requirements :strips :typing :action-costs)
  (:types place lorry package room)
  (:predicates (road ?p ?q - place) (at ?x - (either lorry package) ?p - place) (in ?x - package ?l - lorry)
    (left ?l - lorry ?r - room) (one-less ?less ?more - room))
  (:functions (length ?p ?q - place) - number (total-cost) - number)
  (:action drive
    :parameters (?l - lorry ?p ?q - place)
    :precondition (and (at ?l ?p) (road ?p ?q))
    :effect (and (at ?l ?q) (not (at ?l ?p)) (increase (total-cost) (length ?p ?q))))
  (:action load
    :parameters (?l - lorry ?x - package ?p - place ?less ?more - room)
    :precondition (and (at ?l ?p) (at ?x ?p) (one-less ?less ?more) (left ?l ?more))
    :effect (and (in ?x ?l) (left ?l ?less) (not (at ?x ?p)) (not (left ?l ?more)) (increase (total-cost) 1)))
  (:action unload
    :parameters (?l - lorry ?x - package ?p - place ?less ?more - room)
    :precondition (and (at ?l ?p) (in ?x ?l) (one-less ?less ?more) (left ?l ?less))
    :effect (and (at ?x ?p) (left ?l ?more) (not (in ?x ?l)) (not (left ?l ?less)) (increase (total-cost) 1))))
