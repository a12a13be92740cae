"""`python -m roslings`: the command line."""

import os
import sys
from pathlib import Path

from roslings.cli import main
from roslings.leaving import leave

ENDS_AT_ONCE = ("check", "ros2", "rqt_graph")
"""They load much of ROS, and all that they begin ends with a block."""

if not (os.environ.get("ROSLINGS_COURSE") or (Path(__file__).parents[2] / "labs").is_dir()):
    from roslings import installed  # by pip or uv: the course is elsewhere

    sys.exit(installed.main())
status = main(sys.argv[1:])
if sys.argv[1:2] and sys.argv[1] in ENDS_AT_ONCE:
    leave(status)
sys.exit(status)
