(:types
  entity - object
  equipment piece - entity
  switch machine - equipment
  cutting_machine painting_machine drying_machine - machine
  saw laser - cutting_machine
  sprayer dip_tank - painting_machine
  oven fan - drying_machine
  wooden metal - piece
  plank beam dowel - wooden
  rod sheet - metal)
