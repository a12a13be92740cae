"""These tests span packages; what they share with those of one lies there."""

from __future__ import annotations

import sys

from sources import ROOT

sys.path.insert(0, str(ROOT / "packages/roslings-launcher/tests"))

from courses import (
    bare_python,
    course,
    index,
    make_course,
    online,
    ready,
    standing,
    wheels,
    wheels_for_all,
)

__all__ = [
    "bare_python",
    "course",
    "index",
    "make_course",
    "online",
    "ready",
    "standing",
    "wheels",
    "wheels_for_all",
]
