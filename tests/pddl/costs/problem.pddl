; cost 17: drive t1 t2 (3), buy in t2 (4), fly to t4 (10); buying in t1 costs 9, driving costs 24.
(define (problem costs-1)
  (:domain costs)
  (:objects t1 t2 t3 t4 - town)
  (:init (at t1) (road t1 t2) (road t2 t3) (road t3 t4) (= (total-cost) 0)
    (= (length t1 t2) 3) (= (length t2 t3) 1) (= (length t3 t4) 20) (= (toll t1) 9) (= (toll t2) 4) (= (toll t3) 5) (= (toll t4) 0))
  (:goal (at t4))
  (:metric minimize (total-cost)))
