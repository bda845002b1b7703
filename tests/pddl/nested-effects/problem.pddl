; cost 7: three valves, each before its tank is full, or the alarm goes off; a run for the pump, three for the water.
(define (problem nested-effects-1)
  (:domain nested-effects)
  (:objects t1 t2 t3 t4 - tank)
  (:init (full t1) (pipe t1 t2) (pipe t2 t3) (pipe t3 t4))
  (:goal (and (full t4) (not (alarm)) (forall (?t - tank) (imply (full ?t) (= ?t t4))))))
