"""Runs our own `ros2`, also on a machine where the real one is installed."""

import sys

from roslings.leaving import leave
from roslings.ros2.cli import quietly

if __name__ == "__main__":
    leave(quietly(sys.argv[1:]))
