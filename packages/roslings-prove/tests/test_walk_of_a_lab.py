"""CONTRIBUTING's walk "Add a lab with a service and a parameter", done as it is written."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from roslings.course import Lab, lab, root
from roslings_prove.new_lab import new_lab

TEXT = (root() / "CONTRIBUTING.md").read_text("utf-8")
TITLE = "## Add a lab with a service and a parameter"
WALK = TEXT[TEXT.index(TITLE) : TEXT.index("## Add a capability")]
CLASS = re.compile(r"from std_msgs.msg import String\n.*?(?=\n\ndef main)", re.DOTALL)
EXPERIMENTS = re.compile(r"(?<=\n\n)# --- checks: ")
CHECK_OF_TEXT = re.compile(r"@check\(needs=\[\"runs\"\]\)\ndef test_text.*?\n\n\n", re.DOTALL)
TOPIC_IMPORT = re.compile(r"from roslings.capabilities.topics.demands import .*\n")


def blocks(language: str) -> list[str]:
    """The walk's blocks of code of a language, in order, without their indentation."""
    found = re.findall(rf"^ *```{language}\n(.*?)^ *```", WALK, re.DOTALL | re.MULTILINE)
    return [re.sub(r"^   ", "", each, flags=re.MULTILINE) for each in found]


def put(file: Path, pattern: str | re.Pattern[str], text: str) -> None:
    """The text in place of all that matches, which is there."""
    changed, count = re.subn(pattern, lambda _: text, file.read_text("utf-8"))
    assert count, f"{pattern} is not in {file.name}"
    file.write_text(changed, "utf-8")


@pytest.fixture
def walked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lab:
    """The lab that the walk makes, in a course of its own."""
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    words = blocks("bash")[0].split()
    made = new_lab(words[2], words[4], words[6])
    write_card(made)
    write_package(made)
    write_grader(made)
    write_hints(made)
    write_mutants(made)
    subprocess.run([sys.executable, *blocks("bash")[1].splitlines()[0].split()[1:]], check=True)
    return lab(made.name)


def write_card(made: Lab) -> None:
    """Step 1."""
    contract, points = blocks("yaml")[:2]
    card = made.folder / "card.yaml"
    put(card, re.compile(r"    publishes:\n.*?(?=\nends)", re.DOTALL), contract)
    put(card, r"  text: 15\n", points)


def write_package(made: Lab) -> None:
    """Step 2."""
    put(made.solution / "lamp/lamp.py", CLASS, blocks("python")[0])
    (depends,) = blocks("xml")
    for folder in (made.solution, made.starter):
        put(folder / "package.xml", r"(?=\n  <export>)", depends)


def write_grader(made: Lab) -> None:
    """Step 3."""
    _, imports, experiments, checks = blocks("python")
    put(made.grader, "ALIVE", "STATE")
    put(made.grader, TOPIC_IMPORT, imports)
    put(made.grader, EXPERIMENTS, f"{experiments}\n\n# --- checks: ")
    put(made.grader, CHECK_OF_TEXT, f"{checks}\n\n")


def write_hints(made: Lab) -> None:
    """Step 4: the paragraphs of the walk's table."""
    lessons = dict(re.findall(r"^   \| `(\w+)` \| `(\S+)` \|", WALK, re.MULTILINE))
    assert len(lessons) == 4
    file = made.folder / "hints.yaml"
    hints = yaml.safe_load(file.read_text("utf-8"))
    del hints["text"]
    own = {
        check: {"lesson": at, "steps": ["where", "idea", "code"]} for check, at in lessons.items()
    }
    file.write_text(yaml.safe_dump({**hints, **own}), "utf-8")


def write_mutants(made: Lab) -> None:
    """Steps 5 and 6: those that the walk shows, and those that edit other lines now."""
    folder = made.folder / "mutants"
    (folder / "counter_stands_still.yaml").unlink()
    put(folder / "rate_2_hz.yaml", r"create_timer\(1.0,", "create_timer(period,")
    put(folder / "wrong_topic.yaml", "'alive(?=_now', 10|', 10)", "'lamp_on")
    *mutants, promises = blocks("yaml")[2:]
    for text in mutants:
        name = re.match(r"# (\w+\.yaml)\n", text)
        assert name
        (folder / name[1]).write_text(text, "utf-8")
    with (made.folder / "promises.yaml").open("a", encoding="utf-8") as file:
        file.write(promises)


def test_its_grader_is_python_that_ruff_likes(walked: Lab) -> None:
    """Nothing is imported that the walk no longer uses, and nothing is missing."""
    said = subprocess.run(
        [sys.executable, "-m", "ruff", "check", "--isolated", "--select", "F", str(walked.grader)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert said.returncode == 0, said.stdout


@pytest.mark.slow
def test_it_is_proven(walked: Lab, tmp_path: Path) -> None:
    """Each of its packages is graded for real; each word of its card is judged."""
    command = [sys.executable, "-m", "roslings", *blocks("bash")[1].splitlines()[1].split()[1:]]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"(\d+) of \1 words of the card are judged \(100%\)", done.stdout)
