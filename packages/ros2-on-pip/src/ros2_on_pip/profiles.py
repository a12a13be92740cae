"""What the middleware is told where a terminal says nothing of its own."""

from pathlib import Path

QUICK_DISCOVERY = Path(__file__).with_name("quick_discovery.xml")
"""Nodes find each other in tenths of a second."""
