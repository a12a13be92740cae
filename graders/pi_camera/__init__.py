"""A node that finds a ball in pictures: what is shown to it, and what it must answer."""
