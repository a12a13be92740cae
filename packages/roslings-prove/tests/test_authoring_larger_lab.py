"""The page of a lab with a service, a parameter, a launch file and a board, followed word by word.

Each block is written where the line above it says, and each command is typed.
"""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from roslings.capabilities.launch.contract import LaunchWords
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.serial.contract import SerialWords
from roslings.capabilities.services.contract import ServiceWords
from roslings.course import Lab, lab, root
from roslings.workspace.inspect import inspect_package
from roslings_prove.consistency import files_fit
from roslings_prove.contract import contract_is_told
from roslings_prove.prove import Proof

PAGE = (root() / "site/pages/teachers/a-larger-lab.md").read_text("utf-8")
BLOCK = re.compile(r"(?P<above>[^\n]+)\n\n```(?P<language>\w+)\n(?P<text>.*?)```\n", re.DOTALL)
PLACE = re.compile(
    r"(?:Write|At the end of|In) `(?P<file>[^`]+)`(?:, (?:below|in place of) `(?P<line>[^`]+)`)?:"
)
CHECK = "./roslings check motor --solution"


@dataclass(frozen=True)
class Block:
    """What the page shows, and the line above it."""

    above: str
    language: str
    text: str

    def do(self, course: Path) -> None:
        """Write it as the line above says; a command is typed."""
        if self.language == "bash":
            for line in self.text.splitlines():
                typed(line, course)
            return
        place = PLACE.fullmatch(self.above)
        assert place, self.above
        self._write(course / place["file"], place["line"])

    def _write(self, file: Path, line: str | None) -> None:
        if self.above.startswith("Write"):
            file.parent.mkdir(exist_ok=True)
            file.write_text(self.text, "utf-8")
        elif line is None:
            file.write_text(f"{file.read_text('utf-8')}\n{self.text}", "utf-8")
        else:
            file.write_text(self._put_at(file.read_text("utf-8"), line), "utf-8")

    def _put_at(self, old: str, line: str) -> str:
        """Below the only line with these words, or in its place."""
        lines = old.splitlines(keepends=True)
        (number,) = (n for n, each in enumerate(lines) if line in each)
        kept = [lines[number]] if ", below" in self.above else []
        return "".join([*lines[:number], *kept, self.text, *lines[number + 1 :]])


def typed(line: str, course: Path) -> str:
    """The command in the course's folder; it must do what it is for."""
    words = shlex.split(line)
    program = [sys.executable, *(("-m", "roslings") if words[0] == "./roslings" else ())]
    done = subprocess.run(
        [*program, *words[1:]], capture_output=True, text=True, check=False, cwd=course
    )
    assert done.returncode == 0, line + done.stdout + done.stderr
    return done.stdout


def steps() -> Iterator[tuple[str, list[Block]]]:
    """Each section of the page with its blocks."""
    for part in re.split(r"^## ", PAGE, flags=re.MULTILINE):
        title = part.splitlines()[0]
        yield title, [Block(*each) for each in BLOCK.findall(part)]


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A course of its own, without labs."""
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    return tmp_path


def written(course: Path) -> Lab:
    """All of it is written; of the commands only those that grade nothing are typed."""
    for _, blocks in steps():
        for block in blocks:
            lines = [line for line in block.text.splitlines() if not line.startswith(GRADES)]
            Block(block.above, block.language, "".join(f"{line}\n" for line in lines)).do(course)
    return lab("motor")


GRADES = ("./roslings check", "./roslings prove")


def test_every_block_of_the_page_is_for_something() -> None:
    """Four steps, between the lab that is made and the one that is proven."""
    titles = [title.partition(". ")[0] for title, _ in steps()]
    assert titles[1:] == ["1", "2", "3", "4", "5"]
    assert PAGE.count("```") == 2 * sum(len(blocks) for _, blocks in steps())
    assert f"`{CHECK}`" in PAGE


def test_its_files_fit(course: Path) -> None:
    """All that can be told without running it: files, words, sentences."""
    made = written(course)
    proofs = [*files_fit(made), *contract_is_told(made)]
    wrong = [each.line for each in proofs if isinstance(each, Proof) and not each.holds]
    assert wrong == []
    seen = inspect_package(made.solution, made.card)
    assert not [*seen.xml_problems, *seen.missing_files, *seen.syntax_errors]


def test_each_new_check_is_shown_by_a_wrong_package(course: Path) -> None:
    """One at least for each capability."""
    made = written(course)
    caught = {check for mutant in made.mutants() for check in mutant.fails}
    new = {"service", "parameter", "launch", "turns"}
    assert new <= caught
    assert new <= set(made.card.points)
    node = made.card.nodes[0]
    assert node.of(ServiceWords).serves and node.of(ParameterWords).parameters
    assert made.card.of(LaunchWords).launch and made.card.of(SerialWords).board


@pytest.mark.slow
def test_it_is_followed_word_by_word(course: Path) -> None:
    """For real: 100 after each step, and at the end each wrong package is caught."""
    for title, blocks in steps():
        for block in blocks:
            block.do(course)
        if title[0] in "1234":
            assert "100 of 100" in typed(CHECK, course)
    told = typed("./roslings prove motor --all", course)
    for name, check in (
        ("request_not_read", "service"),
        ("period_in_the_code", "parameter"),
        ("launch_misspelt", "launch"),
        ("port_in_the_code", "turns"),
    ):
        assert f"ok     motor: {name} fails {check}" in told
    assert re.search(r"(\d+) of \1 words of the card are judged \(100%\)", told)
