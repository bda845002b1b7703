; A van drives where a road leads, unless its end is closed or the tank is empty; at home and with friends it fills up.
(define (domain roads)
  (:requirements :adl :action-costs)
  (:types van place - object garage - place)
  (:constants home - garage)
  (:predicates (at ?v - van ?p - place) (road ?a ?b - place) (closed ?p - place) (fuel ?v - van)
               (friend ?p - place) (visited ?p - place))
  (:functions (total-cost) - number (length ?a ?b - place) - number)
  (:action Drive
    :parameters (?v - van ?a ?b - place)
    :precondition (and (at ?v ?a) (or (road ?a ?b) (road ?b ?a)) (not (closed ?b)) (fuel ?v) (not (= ?a ?b)))
    :effect (and (not (at ?v ?a)) (at ?v ?b) (visited ?b) (not (fuel ?v)) (increase (total-cost) (length ?a ?b))))
  (:action fill-up
    :parameters (?v - van)
    :precondition (exists (?p - place) (and (at ?v ?p) (or (friend ?p) (= ?p home))))
    :effect (and (fuel ?v) (increase (total-cost) 2)))
  (:action open-all
    :parameters ()
    :precondition (forall (?v - van) (not (fuel ?v)))
    :effect (and (forall (?p - place) (when (visited ?p) (not (closed ?p)))) (increase (total-cost) 1))))
