"""Rooms that are fair: three designs have all points in each, along the wall on either side.

The program `tests/lab_folders/wander/fair_rooms.py` has found them: it drove each design through
each room. In another room a right node may lose its wall, or meet none.
"""

FAIR: tuple[int, ...] = (
    1001,
    1002,
    1003,
    1006,
    1007,
    1008,
    1011,
    1012,
    1013,
    1015,
    1017,
    1018,
    1019,
    1020,
    1021,
    1022,
    1023,
    1025,
    1027,
    1031,
    1032,
    1033,
    1035,
    1037,
    1038,
    1040,
    1041,
    1042,
)
