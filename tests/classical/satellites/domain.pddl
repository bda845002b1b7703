; Satellites turn to a calibration target with an instrument switched on, then to what is to be pictured.
(define (domain satellites)
  (:requirements :strips :typing)
  (:types satellite instrument mode direction)
  (:predicates (aboard ?i - instrument ?s - satellite) (supports ?i - instrument ?m - mode)
    (target ?i - instrument ?d - direction) (points ?s - satellite ?d - direction) (power-left ?s - satellite)
    (on ?i - instrument) (calibrated ?i - instrument) (have ?d - direction ?m - mode))
  (:action turn
    :parameters (?s - satellite ?to ?from - direction)
    :precondition (points ?s ?from)
    :effect (and (points ?s ?to) (not (points ?s ?from))))
  (:action switch-on
    :parameters (?i - instrument ?s - satellite)
    :precondition (and (aboard ?i ?s) (power-left ?s))
    :effect (and (on ?i) (not (calibrated ?i)) (not (power-left ?s))))
  (:action switch-off
    :parameters (?i - instrument ?s - satellite)
    :precondition (and (aboard ?i ?s) (on ?i))
    :effect (and (power-left ?s) (not (on ?i))))
  (:action calibrate
    :parameters (?s - satellite ?i - instrument ?d - direction)
    :precondition (and (aboard ?i ?s) (target ?i ?d) (points ?s ?d) (on ?i))
    :effect (calibrated ?i))
  (:action picture
    :parameters (?s - satellite ?d - direction ?i - instrument ?m - mode)
    :precondition (and (aboard ?i ?s) (calibrated ?i) (on ?i) (supports ?i ?m) (points ?s ?d))
    :effect (have ?d ?m)))
