"""These tests span packages; what they share with those of one lies there."""

from __future__ import annotations

import sys

from sources import ROOT

sys.path.insert(0, str(ROOT / "packages/roslings/tests/workspace"))

from workspaces import card, package, topics, with_little_room, without_rights, workspace

__all__ = ["card", "package", "topics", "with_little_room", "without_rights", "workspace"]
