"""`./roslings`, which waits less long for a node that does not come up.

    python tests/impatient.py SECONDS WORD...

All else is as ever: the node is started as often, asked as often, and judged by the same words. So
a test whose node never comes up need not wait as long as a slow computer of a student is given.
"""

from __future__ import annotations

import sys
from pathlib import Path

IMPATIENT = Path(__file__)


def begin_with(comes_up_within_s: float) -> None:
    """Run the words of the command line; what measures is a fork of this process."""
    from roslings.experiment import running
    from roslings_launcher.cli import begin

    assert comes_up_within_s < running.COMES_UP_WITHIN_S
    running.COMES_UP_WITHIN_S = comes_up_within_s
    begin()


if __name__ == "__main__":
    begin_with(float(sys.argv.pop(1)))
