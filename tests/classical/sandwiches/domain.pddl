; Sandwiches are made of bread and filling, put on a tray and brought to the children; some must not have gluten.
(define (domain sandwiches)
  (:requirements :strips :typing :negative-preconditions)
  (:types child bread filling sandwich tray place)
  (:constants counter - place)
  (:predicates (bread-left ?b - bread) (filling-left ?f - filling) (without-gluten ?x - (either bread filling))
    (unmade ?s - sandwich) (ready ?s - sandwich) (harmless ?s - sandwich) (on ?s - sandwich ?t - tray)
    (at ?t - tray ?p - place) (waits ?c - child ?p - place) (allergic ?c - child) (served ?c - child))
  (:action make-harmless
    :parameters (?s - sandwich ?b - bread ?f - filling)
    :precondition (and (bread-left ?b) (filling-left ?f) (without-gluten ?b) (without-gluten ?f) (unmade ?s))
    :effect (and (ready ?s) (harmless ?s) (not (bread-left ?b)) (not (filling-left ?f)) (not (unmade ?s))))
  (:action make
    :parameters (?s - sandwich ?b - bread ?f - filling)
    :precondition (and (bread-left ?b) (filling-left ?f) (unmade ?s))
    :effect (and (ready ?s) (not (bread-left ?b)) (not (filling-left ?f)) (not (unmade ?s))))
  (:action put
    :parameters (?s - sandwich ?t - tray)
    :precondition (and (ready ?s) (at ?t counter))
    :effect (and (on ?s ?t) (not (ready ?s))))
  (:action serve-harmless
    :parameters (?s - sandwich ?c - child ?t - tray ?p - place)
    :precondition (and (allergic ?c) (waits ?c ?p) (on ?s ?t) (at ?t ?p) (harmless ?s))
    :effect (and (served ?c) (not (on ?s ?t))))
  (:action serve
    :parameters (?s - sandwich ?c - child ?t - tray ?p - place)
    :precondition (and (not (allergic ?c)) (waits ?c ?p) (on ?s ?t) (at ?t ?p))
    :effect (and (served ?c) (not (on ?s ?t))))
  (:action carry
    :parameters (?t - tray ?from ?to - place)
    :precondition (at ?t ?from)
    :effect (and (at ?t ?to) (not (at ?t ?from)))))
