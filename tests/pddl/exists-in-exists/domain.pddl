; Somebody may enter a room if a friend of a friend of theirs is there: nested quantifiers of one name.
(define (domain exists-in-exists)
  (:requirements :adl)
  (:types person room)
  (:predicates (friend ?a ?b - person) (in ?p - person ?r - room) (welcome ?r - room))
  (:action enter
    :parameters (?p - person ?r - room)
    :precondition (and
      (not (exists (?r - room) (in ?p ?r)))
      (or (welcome ?r)
        (exists (?q - person) (and (friend ?p ?q)
          (exists (?p - person) (and (friend ?q ?p) (in ?p ?r)))))))
    :effect (in ?p ?r))
  (:action leave
    :parameters (?p - person ?r - room)
    :precondition (in ?p ?r)
    :effect (not (in ?p ?r))))
