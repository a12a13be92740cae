"""These tests span packages; what they share with those of one lies there."""

from __future__ import annotations

import sys

from sources import ROOT

sys.path.insert(0, str(ROOT / "packages/roslings/tests/report"))
