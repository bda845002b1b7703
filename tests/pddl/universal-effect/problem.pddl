; cost 8: pen and paper in, to the bank, paper out, cheque in, to the office, pen out, home. The cheque may stay inside.
(define (problem universal-effect-1)
  (:domain universal-effect)
  (:objects home office bank - place pen paper cheque - thing)
  (:init (is-at home) (at pen home) (at paper home) (at cheque bank))
  (:goal (and (at pen office) (at paper bank) (at cheque home) (forall (?t - thing) (imply (in ?t) (= ?t cheque))))))
