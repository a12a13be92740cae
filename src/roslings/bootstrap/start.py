"""Runs roslings, with or without an environment.

`python -m roslings` would put the folder the student stands in first on the path, and a file there
called `random.py` or `types.py` would end us. This puts `src` there, and nothing else.
"""

import runpy
import sys
from pathlib import Path

if __name__ == "__main__":
    sys.path[0] = str(Path(__file__).resolve().parents[2])
    runpy.run_module("roslings", run_name="__main__", alter_sys=True)
