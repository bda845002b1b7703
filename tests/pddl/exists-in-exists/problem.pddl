; cost 4: carl enters the club, for eve is there; ann leaves the foyer and enters it, for carl is; dora enters the foyer.
(define (problem exists-in-exists-1)
  (:domain exists-in-exists)
  (:objects ann bob carl dora eve - person foyer club - room)
  (:init (welcome foyer) (friend ann bob) (friend bob carl) (friend carl dora) (friend dora eve) (in eve club) (in ann foyer))
  (:goal (and (in ann club) (in carl club) (in dora foyer) (exists (?p - person) (in ?p foyer))
    (exists (?p ?q - person) (and (in ?p club) (in ?q foyer) (friend ?p ?q) (not (= ?p ?q)))))))
