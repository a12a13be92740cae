"""What an experiment with a launch file marks in the record that every experiment has."""

from __future__ import annotations

LABEL = "ros2 launch"
"""The name of the process that launches the others."""
