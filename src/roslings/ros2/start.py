"""Runs `ros2` or `rqt_graph`: `start.py NAME WORD...`.

`python -m` would put the folder the student stands in first on the path, and a file there called
`random.py` would end us. This puts `src` there, and nothing else.
"""

import sys
from importlib import import_module
from pathlib import Path

HOMES = {"ros2": "roslings.ros2.cli", "rqt_graph": "roslings.ros2.rqt_graph"}

if __name__ == "__main__":
    sys.path[0] = str(Path(__file__).resolve().parents[2])
    try:
        status = import_module(HOMES[sys.argv[1]]).main(sys.argv[2:])
        import_module("roslings.leaving").leave(status)
    except KeyboardInterrupt:  # Ctrl-C while we were still starting
        sys.exit(2)
