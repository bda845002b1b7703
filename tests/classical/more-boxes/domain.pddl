; A person pushes boxes, and never pulls one.
(define (domain boxes)
  (:requirements :strips :typing)
  (:types place direction box)
  (:predicates (next ?p ?q - place ?d - direction) (person ?p - place) (at ?b - box ?p - place) (clear ?p - place))
  (:action walk
    :parameters (?p ?q - place ?d - direction)
    :precondition (and (person ?p) (next ?p ?q ?d) (clear ?q))
    :effect (and (person ?q) (clear ?p) (not (person ?p)) (not (clear ?q))))
  (:action push
    :parameters (?b - box ?p ?q ?r - place ?d - direction)
    :precondition (and (person ?p) (next ?p ?q ?d) (at ?b ?q) (next ?q ?r ?d) (clear ?r))
    :effect (and (person ?q) (at ?b ?r) (clear ?p) (not (person ?p)) (not (at ?b ?q)) (not (clear ?r)))))
