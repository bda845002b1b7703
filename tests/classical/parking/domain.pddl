; Cars stand at curbs, one behind another, and only the last can move.
(define (domain parking)
  (:requirements :strips :typing)
  (:types car curb)
  (:predicates (at-curb ?c - car ?k - curb) (behind ?c ?front - car) (first ?c - car) (car-clear ?c - car) (curb-clear ?k - curb))
  (:action curb-to-curb
    :parameters (?c - car ?from ?to - curb)
    :precondition (and (car-clear ?c) (curb-clear ?to) (at-curb ?c ?from) (first ?c))
    :effect (and (at-curb ?c ?to) (curb-clear ?from) (not (curb-clear ?to)) (not (at-curb ?c ?from))))
  (:action curb-to-car
    :parameters (?c - car ?from - curb ?to - car)
    :precondition (and (car-clear ?c) (car-clear ?to) (at-curb ?c ?from) (first ?c) (first ?to))
    :effect (and (behind ?c ?to) (curb-clear ?from) (not (car-clear ?to)) (not (at-curb ?c ?from)) (not (first ?c))))
  (:action car-to-curb
    :parameters (?c ?from - car ?to - curb)
    :precondition (and (car-clear ?c) (curb-clear ?to) (behind ?c ?from))
    :effect (and (at-curb ?c ?to) (first ?c) (car-clear ?from) (not (curb-clear ?to)) (not (behind ?c ?from))))
  (:action car-to-car
    :parameters (?c ?from ?to - car)
    :precondition (and (car-clear ?c) (car-clear ?to) (behind ?c ?from) (first ?to))
    :effect (and (behind ?c ?to) (car-clear ?from) (not (car-clear ?to)) (not (behind ?c ?from)))))
