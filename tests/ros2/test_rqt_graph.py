"""`rqt_graph`, typed alone: a picture of what runs, where no desk opens instead."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from terminal import Shell

from skips import imported
from sources import code_of

START = code_of("roslings_launcher") / "start.py"
WITHOUT_A_DESK = (
    "import runpy, sys; sys.modules['nicegui'] = None; sys.argv[:1] = [];"
    " runpy.run_path(sys.argv[0], run_name='__main__')"
)


def test_rqt_graph_saves_a_picture_where_there_is_no_screen(stage: Shell, tmp_path: Path) -> None:
    """It says where; a second picture does not replace the first."""
    imported("matplotlib")
    environment = {k: v for k, v in stage.environment.items() if "DISPLAY" not in k}
    for name in ("rosgraph.png", "rosgraph_2.png"):
        done = subprocess.run(
            [sys.executable, "-c", WITHOUT_A_DESK, START, "rqt_graph"],
            env=environment | {"PATH": "/usr/bin:/bin"},
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.stdout == f"The picture of the graph is in {tmp_path / name}\n", done.stderr
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")
