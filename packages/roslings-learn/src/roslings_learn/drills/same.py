"""When two values of messages count as equal."""

from __future__ import annotations

import math
from typing import Any


def same(found: Any, wanted: Any) -> bool:
    """Equal, as far as a number of 32 bits can be; infinity and NaN by their names."""
    if isinstance(found, float) or isinstance(wanted, float):
        try:
            a, b = float(found), float(wanted)
        except (TypeError, ValueError):
            return False
        return math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-9) or (math.isnan(a) and math.isnan(b))
    return bool(found == wanted)
