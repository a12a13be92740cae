"""Script: begin a companion, which ends with whoever began it.

    python companion_begin.py PROGRAM PLAN

Whatever happens to the grader, no companion outlives it, not even one that is frozen.
"""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import kernel  # type: ignore[import-not-found]

del sys.path[0]
kernel.die_with_parent()
program = sys.argv[1]
sys.argv[:] = sys.argv[1:]
runpy.run_path(program, run_name="__main__")
