"""These tests set editions up as the played platforms do."""

from __future__ import annotations

import sys

from sources import ROOT

for folder in ("tests/rogues", "packages/roslings-class/tests/export"):
    sys.path.insert(0, str(ROOT / folder))
