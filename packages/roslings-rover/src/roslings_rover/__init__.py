"""Stand-ins for hardware: the rover, its Arduino board, its camera. Knows no lab and no grader."""
