"""Serial: a board on a cable, and the lines on it."""
