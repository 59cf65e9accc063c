"""How long something takes, and in how many processes; and plain twins to be compared with."""
