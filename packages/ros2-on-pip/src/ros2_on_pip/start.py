"""Runs `ros2`: `start.py WORD...`.

`python -m` would put the folder the student stands in first on the path, and a file there called
`random.py` would end us. This puts the folder of this package there, and nothing else.
"""

import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path[0] = str(Path(__file__).resolve().parents[1])
    try:
        from ros2_on_pip.cli import begin
    except KeyboardInterrupt:  # Ctrl-C while we were still starting
        sys.exit(2)
    begin()
