"""What was handed in: a package, alone or packed, for a grading that is not the student's own."""
