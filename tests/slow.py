"""Which tests README's command leaves to CI: read from the marks in their files.

`tests/README.md` lists these files, with what is dear in them and the stage of `.ci/run` that runs
them; `test_slow_list.py` holds the list against the marks.
"""

from __future__ import annotations

import re
from pathlib import Path

TESTS = Path(__file__).parent
LIST = TESTS / "README.md"
WHOLE = re.compile(r"^pytestmark = (?:\[\s*)?pytest\.mark\.slow\b", re.MULTILINE)
SOME = re.compile(r"\bpytest\.mark\.slow\b|\bfew(?:_labs)?\(")
ROW = re.compile(
    r"^\| `(?P<file>[^`]+)` \| (?P<what>[^|]+) \| (?P<why>[^|]+) \| (?P<stage>[^|]+) \|$"
)


def is_slow_whole(file: Path) -> bool:
    """Whether each test in it is slow, as its `pytestmark` says, with `slow` first."""
    return bool(WHOLE.search(file.read_text("utf-8")))
