"""What only the lab "wander" measures: which rooms a grading drives in."""
