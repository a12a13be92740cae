"""Rooms that are fair: three designs have all points in each, along the wall on either side.

The program `tests/lab_folders/wander/fair_rooms.py` has found them: it drove each design through
each room. In another room a right node may lose its wall, or meet none.
"""

FAIR: tuple[int, ...] = (1001, 1002, 1003, 1006, 1007)
