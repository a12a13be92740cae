"""Three questions about each hand-in that passes, with their answers: for five minutes of talk.

They are those of `./roslings explain`: small changes of the student's own lines. One process each
makes them, as if somebody had typed the command.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from ros2_on_pip.typed_paths import from_here
from roslings.report.whole_file import write_whole
from roslings_class.result import GradingResult
from roslings_class.submissions import Submission

FOLDER = "explain"
LIMIT_S = 900


def explain(
    lab: str,
    submissions: Sequence[Submission],
    latest: Mapping[str, GradingResult],
    out: Path,
    trust: bool,
    tell: Callable[[str], None],
) -> list[str]:
    """Write `explain/NAME.txt` for each that passes and has none yet; lines for the end."""
    wanted = [each for each in submissions if latest[each.name].word == "pass"]
    (out / FOLDER).mkdir(exist_ok=True)
    left = [each for each in wanted if not _is_there(each, latest, out)]
    for number, each in enumerate(left, 1):
        tell(f"Questions about {each.name}: {number} of {len(left)}")
        found = _questions(lab, each, trust, latest[each.name].whose)
        write_whole(_file(each, out), f"{_head(each, latest)}\n{found}".encode())
    return list(_told(len(wanted), len(submissions), out))


def _told(wanted: int, of: int, out: Path) -> Iterator[str]:
    yield f"Questions, with answers, about {wanted} of {of} hand-ins: {from_here(out / FOLDER)}"
    if wanted < of:
        yield "The others do not pass: what is wrong with a package is no question about it."


def _questions(lab: str, submission: Submission, trust: bool, whose: str) -> str:
    words = ["explain", lab, str(submission.path.absolute()), "--answers"]
    words += ["--for", whose] if whose else []
    try:
        done = subprocess.run(
            [sys.executable, "-m", "roslings", *words, *([] if trust else ["--as-stranger"])],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
            timeout=LIMIT_S,
        )
    except subprocess.TimeoutExpired:
        return f"No questions: they were not made within {LIMIT_S} s.\n"
    return done.stdout if done.returncode == 0 else f"No questions: {done.stderr.strip()}\n"


def _file(submission: Submission, out: Path) -> Path:
    return out / FOLDER / f"{submission.name}.txt"


def _head(submission: Submission, latest: Mapping[str, GradingResult]) -> str:
    """Whose it is, and what was handed in."""
    return f"{submission.name}, by its content {latest[submission.name].digest[:12]}"


def _is_there(submission: Submission, latest: Mapping[str, GradingResult], out: Path) -> bool:
    """Of just this content."""
    file = _file(submission, out)
    return file.is_file() and file.read_text("utf-8").startswith(_head(submission, latest) + "\n")
