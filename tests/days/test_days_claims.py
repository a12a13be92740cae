"""What a lesson says in words of an output is typed, or looked up where the lesson was executed."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from ast import literal_eval
from pathlib import Path
from typing import Any

import pytest
import yaml
from pydantic import BaseModel, ConfigDict

from lesson_runs import lessons, walked
from ros2_on_pip.domain_lease import leased_domain
from roslings.course import lab, root
from roslings_learn.lessons.rules import Lesson
from sources import python_path
from until_told import until_told

FORGOTTEN = ("PYTEST_CURRENT_TEST", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_DOMAIN_ID")
ESCAPES = re.compile(r"\x1b\[[0-9;]*m")
PAGE = "days/06-serial-bridge/more-on-the-cable.md"


class Claim(BaseModel):
    """One entry of claims.yaml."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    day: str
    says: str
    types: str = ""
    cell: str = ""
    lab: str = ""
    shows: tuple[str, ...]
    hides: tuple[str, ...] = ()
    exit: int = 0

    def must_hold(self, output: str) -> None:
        """The output has what is claimed."""
        for pattern in self.shows:
            assert re.search(pattern, output, re.MULTILINE), f"no {pattern!r} in:\n{output}"
        for pattern in self.hides:
            assert not re.search(pattern, output), f"{pattern!r} is in:\n{output}"


CLAIMS = [
    Claim.model_validate(entry)
    for entry in yaml.safe_load(Path(__file__).with_name("claims.yaml").read_text("utf-8"))
]
LESSONS = {lesson.day.id: lesson for lesson in lessons()}
TYPED = [claim for claim in CLAIMS if claim.types]
SEEN = [claim for claim in CLAIMS if claim.cell]


def named(claims: list[Claim]) -> list[str]:
    """For pytest's lines."""
    return [f"{claim.day}: {claim.says[:40]}" for claim in claims]


@pytest.mark.parametrize("claim", CLAIMS, ids=named(CLAIMS))
def test_a_claim_stands_in_its_lesson(claim: Claim) -> None:
    """Or in a page beside it, or the task. Who rewords it rewords the claim; each has one proof."""
    cells = LESSONS[claim.day].cells
    texts = [cell.text for cell in cells if not cell.is_code]
    texts += [page.read_text("utf-8") for page in LESSONS[claim.day].path.parent.glob("*.md")]
    texts += [lab(claim.lab).task.read_text("utf-8")] if claim.lab else []
    assert " ".join(claim.says.split()) in " ".join(" ".join(texts).split())
    assert bool(claim.types) != bool(claim.cell)
    if claim.cell:
        assert [place for place, cell in enumerate(cells) if meant(claim, cell.text, cell.tags)]


def meant(claim: Claim, code: str, tags: tuple[str, ...] | list[str] | set[str]) -> bool:
    """Whether a claim is of this cell; a cell to be changed claims nothing."""
    return claim.cell in code and "change" not in tags


@pytest.mark.slow
@pytest.mark.parametrize("claim", TYPED, ids=named(TYPED))
def test_a_terminal_shows_what_is_claimed(claim: Claim, tmp_path: Path) -> None:
    """Typed in the roslings folder, with ROS made ready and an empty home."""
    solution = lab(claim.lab).solution if claim.lab else root()
    typed = claim.types.replace("{work}", str(tmp_path)).replace("{solution}", str(solution))
    with leased_domain() as domain:
        done = subprocess.run(
            ["bash", "--norc", "-c", typed],
            cwd=root(),
            env=ready(tmp_path, domain),
            capture_output=True,
            text=True,
            check=False,
        )
    claim.must_hold(ESCAPES.sub("", done.stdout + done.stderr).rstrip("\n"))
    assert done.returncode == claim.exit


def ready(home: Path, domain: int) -> dict[str, str]:
    """A terminal in which `source setup.bash` was typed."""
    kept = {key: value for key, value in os.environ.items() if key not in FORGOTTEN}
    return {
        **kept,
        "HOME": str(home),
        "ROSLINGS_WS": str(home / "roslings_ws"),
        "PATH": f"{Path(sys.prefix, 'bin')}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": python_path(),
        "ROS_DOMAIN_ID": str(domain),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    "claim",
    [
        pytest.param(c, marks=pytest.mark.xdist_group(c.day), id=f"{c.day}: {c.says[:40]}")
        for c in SEEN
    ],
)
def test_a_cell_shows_what_is_claimed(claim: Claim, shared_folder: Path) -> None:
    """In the one execution of the lesson that all tests share."""
    import nbformat

    lesson: Lesson = LESSONS[claim.day]
    book = nbformat.reads(walked(shared_folder, lesson).executed, as_version=4)
    cells = [
        cell
        for cell in book.cells
        if cell.cell_type == "code" and meant(claim, cell.source, cell.metadata.get("tags", []))
    ]
    claim.must_hold(ESCAPES.sub("", written(cells[0])))


def written(cell: Any) -> str:
    """All that a cell has printed, the words of its pictures, and its error."""
    return "".join(words_of(out) for out in cell.outputs)


def words_of(out: Any) -> str:
    """Of one output of a cell."""
    if out.output_type == "error":
        return f"{out.ename}: {out.evalue}\n"
    shown = out.get("data", {}).get("text/plain")
    return f"{shown}\n" if shown else str(out.get("text", ""))


@pytest.mark.slow
def test_the_page_about_the_cable_says_what_its_program_prints(tmp_path: Path) -> None:
    """Nonsense at the wrong speed, the word at the right one."""
    wrong, right = printed_by("def listen", tmp_path)
    assert right == "b'HELLO'"
    assert wrong.startswith("b'")
    assert len(literal_eval(wrong)) < len("HELLO")


@pytest.mark.slow
def test_lines_that_nobody_reads_are_lost_but_for_a_third_and_a_thread_loses_none(
    tmp_path: Path,
) -> None:
    """As the page about the cable claims of a thousand lines.

    What fits into the kernel's buffer is a third. A thread that no processor was given to for as
    long as that fills tells nothing: it is asked again. What it had not read yet is no loss.
    """
    said = until_told(lambda: printed_by("class Reader", tmp_path, COUNTED), has_lost)
    without, having = (int(line.split(":")[1]) for line in said[:2])
    assert 200 < without < 500
    assert not has_lost(said), said
    numbers = literal_eval(said[2])
    assert numbers == [*range(1, having + 1)] and having > without


COUNTED = """
print([int(line.split(b",")[1]) for line in reader.lines.queue])
print("lost:", board.lost_bytes)
"""
"""Typed below the program: which lines the thread has, and whether the buffer was ever full."""


def has_lost(said: list[str]) -> bool:
    """The board had to throw bytes away, although there is a thread."""
    return said[-1] != "lost: 0"


def printed_by(part: str, folder: Path, more: str = "") -> list[str]:
    """What the program of that page prints that holds `part`, with `more` below it."""
    text = (root() / PAGE).read_text("utf-8")
    programs = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    (program,) = (each for each in programs if part in each)
    (folder / "it.py").write_text(program + more)
    done = subprocess.run(
        [sys.executable, "it.py"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": python_path()},
    )
    return done.stdout.splitlines()
