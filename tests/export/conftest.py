"""These tests use the written verdicts of the reports, and the ordinary user of the rogues."""

from __future__ import annotations

import sys
from pathlib import Path

for folder in ("report", "rogues"):
    sys.path.insert(0, str(Path(__file__).parents[1] / folder))
