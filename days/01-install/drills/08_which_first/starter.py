"""Foretell: two folders hold a program called robot. Which line is written? Write it
between quotes, for example "this is my one", then check."""

import os
import subprocess
from pathlib import Path
from tempfile import mkdtemp

ANSWER = None

HERE = Path(mkdtemp())
for name in ["old", "new"]:
    program = HERE / name / "robot"
    program.parent.mkdir(parents=True)
    program.write_text(f"#!/bin/sh\necho this is the {name} one\n")
    program.chmod(0o755)

PATH = f"{HERE}/new:{HERE}/old:{os.environ['PATH']}"
subprocess.run(["sh", "-c", "robot"], env={"PATH": PATH})
