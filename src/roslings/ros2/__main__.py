"""`python -m roslings.ros2`, for those who work on it; students have `ros2` on their path."""

import sys

from roslings.leaving import leave
from roslings.ros2.cli import main

if __name__ == "__main__":
    leave(main(sys.argv[1:]))
