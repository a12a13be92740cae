"""A robot that drives: where it went, and what it was told."""
