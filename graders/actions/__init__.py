"""Goals on a floor: a rover that a node drives to a point, and what becomes of each goal."""
