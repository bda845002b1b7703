(define (problem sandwiches-small)
  (:domain sandwiches)
  (:objects
    c0 c1 c2 - child
    b0 b1 b2 - bread
    f0 f1 f2 - filling
    s0 s1 s2 s3 - sandwich
    t0 t1 - tray
    table bench - place)
  (:init
    (at t0 counter) (at t1 counter) (bread-left b0) (bread-left b1) (bread-left b2) (filling-left f0)
    (filling-left f1) (filling-left f2) (without-gluten b2) (without-gluten f0) (unmade s0) (unmade s1)
    (unmade s2) (unmade s3) (allergic c1) (waits c0 table) (waits c1 bench) (waits c2 bench))
  (:goal (and
    (served c0) (served c1) (served c2))))
