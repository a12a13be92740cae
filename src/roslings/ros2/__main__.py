"""`python -m roslings.ros2`, for those who work on it; students have `ros2` on their path."""

import sys

from roslings.ros2.cli import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
