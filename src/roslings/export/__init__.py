"""What an instructor uploads to a grading platform: scripts, the course without answers, a page."""

from __future__ import annotations

from roslings.export.bundle import export
from roslings.export.errors import CannotExport
from roslings.export.systems import SYSTEMS, System

__all__ = ["SYSTEMS", "CannotExport", "System", "export"]
