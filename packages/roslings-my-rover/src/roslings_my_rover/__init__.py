"""One robot that grows out of a student's own parts."""
