"""A student's program and the reference solution, one beside the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from itertools import zip_longest
from pathlib import Path

from ros2_on_pip.label_column import columns_of, padded
from ros2_on_pip.language import Text, said
from ros2_on_pip.safe_text import harmless

YOURS, OURS = Text("drill.yours", "yours"), Text("drill.ours", "ours")
GAP = " | "
OTHER_GAP = " > "
"""Between two lines that differ."""


def beside(yours: str, ours: str, columns: int) -> Iterator[str]:
    """In two columns where the terminal has room for both; else `-` before yours, `+` before ours.

    Nothing is said of how good it is: both pass.
    """
    left, right = harmless(yours, keep_newlines=True), harmless(ours, keep_newlines=True)
    mine, theirs = left.splitlines(), right.splitlines()
    width = max(map(columns_of, [*mine, str(YOURS)])), max(map(columns_of, [*theirs, str(OURS)]))
    if sum(width) + len(GAP) <= columns:
        yield from _in_columns(mine, theirs, width[0])
    else:
        yield from _in_one_column(mine, theirs)


def _in_columns(mine: Sequence[str], theirs: Sequence[str], width: int) -> Iterator[str]:
    yield f"{padded(str(YOURS), width)}{GAP}{OURS}"
    for tag, a, b, c, d in SequenceMatcher(None, mine, theirs, autojunk=False).get_opcodes():
        gap = GAP if tag == "equal" else OTHER_GAP
        for left, right in zip_longest(mine[a:b], theirs[c:d], fillvalue=""):
            yield f"{padded(left, width)}{gap}{right}".rstrip()


def _in_one_column(mine: Sequence[str], theirs: Sequence[str]) -> Iterator[str]:
    yield f"- {YOURS}   + {OURS}"
    for tag, a, b, c, d in SequenceMatcher(None, mine, theirs, autojunk=False).get_opcodes():
        if tag == "equal":
            yield from (f"  {line}".rstrip() for line in mine[a:b])
        else:
            yield from (f"- {line}".rstrip() for line in mine[a:b])
            yield from (f"+ {line}".rstrip() for line in theirs[c:d])


def package_lines(yours: Path, ours: Path, columns: int = 80) -> Iterator[str]:
    """Each file of the reference solution that is another in yours; and that all are the same."""
    told = False
    for file in sorted(path for path in ours.rglob("*") if path.is_file()):
        name = file.relative_to(ours)
        texts = _text(yours / name), _text(file)
        if "__pycache__" not in name.parts and texts[0] != texts[1] and texts[1]:
            told = True
            missing = said("drill.no_file", "(you have no file of this name)")
            yield f"\n{name}" if texts[0] else f"\n{name}  {missing}"
            yield from beside(*texts, columns)
    if not told:
        the_same = "Your package and ours are the same, letter by letter."
        yield f"\n{said('drill.same_package', the_same)}"


def _text(file: Path) -> str:
    """Empty for what is no text, or is not there."""
    try:
        return file.read_text("utf-8")
    except (OSError, UnicodeDecodeError):
        return ""
