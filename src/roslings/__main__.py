"""`python -m roslings`: the command line."""

import sys

from roslings.cli import main
from roslings.leaving import leave

ENDS_AT_ONCE = ("check", "ros2", "rqt_graph")
"""They load much of ROS, and all that they begin ends with a block."""

status = main(sys.argv[1:])
if sys.argv[1:2] and sys.argv[1] in ENDS_AT_ONCE:
    leave(status)
sys.exit(status)
