(:types
  entity - object
  gripper support item - entity
  surface container - support
  table shelf tray - surface
  box - container
  vessel block wiper - item
  cup bottle - vessel
  sponge cloth - wiper)
