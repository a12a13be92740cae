"""Runs our own `ros2`, also on a machine where the real one is installed."""

import sys

from roslings.ros2.cli import quietly

if __name__ == "__main__":
    sys.exit(quietly(sys.argv[1:]))
