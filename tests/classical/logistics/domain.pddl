; Trucks carry packages within a city, an aeroplane between cities.
(define (domain logistics)
  (:requirements :strips :typing)
  (:types place city package vehicle - object airport - place truck aeroplane - vehicle)
  (:predicates (at ?x - (either package vehicle) ?p - place) (in ?x - package ?v - vehicle) (within ?p - place ?c - city))
  (:action load
    :parameters (?x - package ?v - vehicle ?p - place)
    :precondition (and (at ?v ?p) (at ?x ?p))
    :effect (and (in ?x ?v) (not (at ?x ?p))))
  (:action unload
    :parameters (?x - package ?v - vehicle ?p - place)
    :precondition (and (at ?v ?p) (in ?x ?v))
    :effect (and (at ?x ?p) (not (in ?x ?v))))
  (:action drive
    :parameters (?t - truck ?from ?to - place ?c - city)
    :precondition (and (at ?t ?from) (within ?from ?c) (within ?to ?c))
    :effect (and (at ?t ?to) (not (at ?t ?from))))
  (:action fly
    :parameters (?a - aeroplane ?from ?to - airport)
    :precondition (at ?a ?from)
    :effect (and (at ?a ?to) (not (at ?a ?from)))))
