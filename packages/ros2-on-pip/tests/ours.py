"""Runs our own `ros2`, also on a machine where the real one is installed."""

import sys

from ros2_on_pip.cli import quietly
from ros2_on_pip.quick_exit import leave

if __name__ == "__main__":
    leave(quietly(sys.argv[1:]))
