"""What this computer knows of its student, for the site that is opened here: scores and drills.

Only `./roslings site --open` writes it, at the end of a script of that one build. A site that is
built to be published holds nothing of anybody.
"""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

from roslings.workspace.progress import read_progress
from roslings_learn.drills.course import all_drills

SCRIPT = "_static/progress.js"


def yours(workspace: Path) -> dict[str, Any]:
    """Lab to its best score, and day to how many of its drills are done. Raises CannotRead."""
    kept = read_progress(workspace)
    drills = all_drills()
    done = Counter(
        each.day for each in drills if each.name in kept.drills and kept.drills[each.name].passed_at
    )
    return {
        "labs": {
            name: {"score": lab.best, "passed": lab.done}
            for name, lab in kept.labs.items() if lab.checks
        },
        "drills": {day: [done[day], of] for day, of in Counter(d.day for d in drills).items()},
    }  # fmt: skip


def tell(html: Path, workspace: Path) -> None:
    """Put it into the built site in the folder `html`. Raises CannotRead and OSError."""
    script = html / SCRIPT
    line = f"\nroslings.tell({json.dumps(yours(workspace))});\n"
    script.write_text(script.read_text("utf-8") + line, "utf-8")
