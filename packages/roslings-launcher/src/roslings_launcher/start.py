"""Runs roslings, with or without an environment.

`python -m roslings` would put the folder the student stands in first on the path, and a file there
called `random.py` or `types.py` would end us. This puts the course's own packages there, and
nothing else; it imports none of them, for there may be no environment yet that knows them.
"""

import sys
from pathlib import Path

if __name__ == "__main__":
    packages = Path(__file__).resolve().parents[3]
    sys.path[:1] = [str(folder) for folder in sorted(packages.glob("*/src"))]
    from roslings_launcher.cli import begin

    begin()
