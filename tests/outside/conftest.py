"""These tests set editions up as the played platforms do."""

from __future__ import annotations

import sys
from pathlib import Path

for folder in ("rogues", "export"):
    sys.path.insert(0, str(Path(__file__).parents[1] / folder))
