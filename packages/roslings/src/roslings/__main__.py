"""`python -m roslings`: the command line."""

import os
import sys
from pathlib import Path

from roslings_launcher import installed
from roslings_launcher.cli import begin

if __name__ == "__main__":
    if os.environ.get("ROSLINGS_COURSE") or (Path(__file__).parents[4] / "labs").is_dir():
        begin()
    sys.exit(installed.main())  # by pip or uv: the course is elsewhere
