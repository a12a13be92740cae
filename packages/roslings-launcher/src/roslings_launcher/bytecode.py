"""The packages' bytecode, written at set-up.

A build or a node in a sandbox sees the environment read-only. A module that is not compiled yet
would be compiled in each of them again. `setuptools` alone is 0.4 s of every build.
"""

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

from roslings_launcher.progress import going_on
from roslings_launcher.virtual import Virtual

UNUSED = ("pip",)
"""Not compiled as a whole: it runs at a set-up only, and would take longer than all else there."""
OVERLAY = "overlay/lib/python3*/*-packages"
"""The labs' own message types beside a sourced ROS."""


def compile_packages(virtual: Virtual) -> None:
    """Compiles every module in `virtual` whose bytecode is missing or older than the module.

    A module in which this Python finds a mistake (a template, a test of errors) stays as it is.
    """
    with going_on(lambda: "Compiling, so that each start is quick"):
        subprocess.run(
            [virtual.python, "-I", "-m", "compileall", "-qq", *_packages(virtual)],
            cwd=os.sep,
            env={"_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"},  # needs none of ROS's libraries
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            check=False,
        )


def _packages(virtual: Virtual) -> Iterator[Path]:
    for folder in (virtual.site, *virtual.folder.glob(OVERLAY)):
        yield from (entry for entry in folder.iterdir() if entry.name not in UNUSED)
