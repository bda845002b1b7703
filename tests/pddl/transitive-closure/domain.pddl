; Signals reach what is connected: a recursive derived predicate; links can be moved.
(define (domain transitive-closure)
  (:requirements :adl :derived-predicates)
  (:types node)
  (:predicates (link ?a ?b - node) (reaches ?a ?b - node) (free ?a - node) (sent ?a ?b - node))
  (:derived (reaches ?a ?b - node) (or (link ?a ?b) (exists (?c - node) (and (reaches ?a ?c) (reaches ?c ?b)))))
  (:action cut :parameters (?a ?b - node) :precondition (link ?a ?b) :effect (and (not (link ?a ?b)) (free ?a)))
  (:action join :parameters (?a ?b - node) :precondition (and (free ?a) (not (reaches ?b ?a))) :effect (and (link ?a ?b) (not (free ?a))))
  (:action send :parameters (?a ?b - node) :precondition (reaches ?a ?b) :effect (sent ?a ?b)))
