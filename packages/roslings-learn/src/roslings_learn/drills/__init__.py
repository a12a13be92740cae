"""Drills: tiny programs that do not work, or lack one line. The student mends one, the next comes.

A drill's card alone decides what is judged. Its program is run as a real process, in the same arena
and before the same probe as a lab's nodes. The demands are those of the labs.
"""

from __future__ import annotations

from roslings_learn.drills.course import Drill, NoSuchDrill, all_drills, drill

__all__ = ["Drill", "NoSuchDrill", "all_drills", "drill"]
