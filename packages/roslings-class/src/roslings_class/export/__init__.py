"""What an instructor uploads to a grading platform: scripts, the course without answers, a page."""

from __future__ import annotations

from roslings_class.export.bundle import export
from roslings_class.export.errors import CannotExport
from roslings_class.export.systems import SYSTEMS, System

__all__ = ["SYSTEMS", "CannotExport", "System", "export"]
