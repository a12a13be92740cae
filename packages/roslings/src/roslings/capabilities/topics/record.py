"""What an experiment with topics marks in the record that every experiment has."""

from __future__ import annotations

TOLD = "told"
"""The stage of an experiment in which the node is told values: before it, it knows none."""
