"""These tests use the written verdicts of the reports, and the ordinary user of the rogues."""

from __future__ import annotations

import sys

from sources import ROOT

for folder in ("packages/roslings/tests/report", "tests/rogues"):
    sys.path.insert(0, str(ROOT / folder))
