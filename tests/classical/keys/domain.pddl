; A robot opens doors with keys of the right shape and carries one key at a time.
(define (domain keys)
  (:requirements :strips :typing)
  (:types place key shape)
  (:predicates (next ?p ?q - place) (at-robot ?p - place) (at ?k - key ?p - place) (fits ?k - key ?s - shape)
    (lock ?p - place ?s - shape) (locked ?p - place) (open ?p - place) (hand-empty) (holds ?k - key))
  (:action unlock
    :parameters (?p ?door - place ?k - key ?s - shape)
    :precondition (and (next ?p ?door) (at-robot ?p) (locked ?door) (lock ?door ?s) (fits ?k ?s) (holds ?k))
    :effect (and (open ?door) (not (locked ?door))))
  (:action move
    :parameters (?p ?q - place)
    :precondition (and (next ?p ?q) (at-robot ?p) (open ?q))
    :effect (and (at-robot ?q) (not (at-robot ?p))))
  (:action pick-up
    :parameters (?k - key ?p - place)
    :precondition (and (at-robot ?p) (at ?k ?p) (hand-empty))
    :effect (and (holds ?k) (not (at ?k ?p)) (not (hand-empty))))
  (:action put-down
    :parameters (?k - key ?p - place)
    :precondition (and (at-robot ?p) (holds ?k))
    :effect (and (at ?k ?p) (hand-empty) (not (holds ?k))))
  (:action exchange
    :parameters (?k ?other - key ?p - place)
    :precondition (and (at-robot ?p) (holds ?k) (at ?other ?p))
    :effect (and (at ?k ?p) (holds ?other) (not (holds ?k)) (not (at ?other ?p)))))
