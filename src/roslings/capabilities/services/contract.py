"""What a card says about services, and what is said by no card."""

from __future__ import annotations

MOST_LATE = 0.05
"""The part of the answers that may be late: a computer does other things, too."""
