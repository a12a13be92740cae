"""Every lab's files fit each other: card, task, starter, solution, hints and mutants."""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from few import few_labs
from roslings.course import Lab, Mutant, all_labs, lab, root
from roslings.course.files import BadCourseFile
from roslings.course.task import is_current, task_text, write_task
from roslings.workspace.inspect import inspect_package
from roslings.workspace.sources import files
from roslings_launcher.groups import names

LABS = {each.name: each for each in all_labs()}
MUTANTS = {
    f"{each.name}-{wrong.name}": (each, wrong) for each in all_labs() for wrong in each.mutants()
}
FEWEST_MUTANTS = 15
LONGEST_LINE = 80
every_lab = pytest.mark.parametrize("each", LABS.values(), ids=LABS.keys())
COLCON = Path(sys.executable).with_name("colcon")


# --- the task ----------------------------------------------------------------------------------


@every_lab
def test_the_task_says_what_the_card_says(each: Lab) -> None:
    """After a change of the card: python -m roslings.course.task."""
    assert is_current(each)


@every_lab
def test_the_task_has_the_cards_title(each: Lab) -> None:
    """And names its licence."""
    text = each.task.read_text("utf-8")
    assert text.startswith(f"# {each.card.title}\n")
    assert "CC BY 4.0" in text


@every_lab
def test_no_number_or_text_of_the_card_is_said_twice(each: Lab) -> None:
    """Outside the sections that are drawn from the card, nobody writes a rate or a text by hand."""
    prose = re.sub(r"<!-- card.*?<!-- /card -->", "", each.task.read_text("utf-8"), flags=re.DOTALL)
    for node in each.card.nodes:
        for topic in (*node.publishes, *node.subscribes):
            assert not (topic.text and topic.text.partition("{")[0] in prose)
            assert not (topic.rate and f"{topic.rate.hz:g} Hz" in prose)
        assert not (node.log and node.log.partition("{")[0] in prose)


@every_lab
def test_the_task_names_each_command_and_its_place(each: Lab) -> None:
    """Each block of commands comes after a line that says which terminal and which folder."""
    blocks = each.task.read_text("utf-8").split("```bash\n")
    assert len(blocks) > 5
    for before in blocks[:-1]:
        last = before.rpartition("\n### ")[2]
        assert "Terminal" in last or "roslings check" in last
    assert f"./roslings start {each.name}" in each.task.read_text("utf-8")
    assert f"./roslings check {each.name}" in each.task.read_text("utf-8")


def test_a_changed_card_changes_the_task(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An instructor writes another rate, text and points, and draws the task anew."""
    folder = tmp_path / "labs" / "topics"
    shutil.copytree(lab("topics").folder, folder)
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    card = folder / "card.yaml"
    text = card.read_text("utf-8").replace("hz: 2.0", "hz: 7.5").replace("Hello robotics", "Salut")
    card.write_text(text, "utf-8")
    topics = lab("topics")
    assert not is_current(topics)
    assert write_task(topics)
    assert not write_task(topics)
    task = topics.task.read_text("utf-8")
    assert "7.5 Hz; 7.125 Hz to 7.875 Hz" in task
    assert "I heard: 'Salut 1'" in task


@pytest.mark.parametrize(
    ("damage", "named"),
    [
        ("<!-- card: contract -->", "<!-- /card -->"),
        ("<!-- /card -->", "<!-- card: contract -->"),
        ("<!-- card: unknown -->", "<!-- card: unknown -->"),
    ],
)
def test_a_damaged_section_is_named_by_its_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, damage: str, named: str
) -> None:
    """A mark that somebody deleted: the other one of the pair is named; or an unknown name."""
    shutil.copytree(lab("topics").folder, tmp_path / "labs" / "topics")
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    task = lab("topics").task
    text = task.read_text("utf-8")
    first = "<!-- card: contract -->"
    damaged = text.replace(first, damage) if "unknown" in damage else text.replace(damage, "", 1)
    task.write_text(damaged, "utf-8")
    with pytest.raises(BadCourseFile) as fault:
        task_text(lab("topics"))
    assert damaged.splitlines()[fault.value.line - 1] == named
    assert fault.value.line == damaged[: damaged.index(named)].count("\n") + 1


@every_lab
def test_the_groups_of_a_card_exist(each: Lab) -> None:
    """What its check needs besides is a group of pyproject.toml."""
    assert set(each.card.groups) <= set(names(root() / "pyproject.toml"))


# --- the packages ------------------------------------------------------------------------------


@every_lab
def test_the_solution_is_well_formed(each: Lab) -> None:
    """As far as its files tell."""
    seen = inspect_package(each.solution, each.card)
    assert not [*seen.xml_problems, *seen.missing_files, *seen.syntax_errors]
    assert set(seen.imported) <= set(seen.declared)
    assert set(seen.entry_points) >= {node.executable for node in each.card.nodes}
    assert set(seen.pictures) == {picture.path for picture in each.card.pictures}


@every_lab
def test_the_starter_is_valid_python_and_not_done(each: Lab) -> None:
    """It has numbered TODOs, from 1 on, none left out; the solution has none."""
    seen = inspect_package(each.starter, each.card)
    assert not [*seen.xml_problems, *seen.missing_files, *seen.syntax_errors]
    assert not seen.entry_points
    text = "\n".join(path.read_text("utf-8") for path in files(each.starter).values())
    numbers = sorted(int(number) for number in re.findall(r"TODO (\d+)", text))
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) > 5
    assert "TODO" not in "".join(
        p.read_text("utf-8", "replace") for p in files(each.solution).values()
    )


@every_lab
def test_the_starter_holds_no_line_of_the_answer(each: Lab) -> None:
    """No name, text or rate of the card stands in the starter's code.

    setup.py names the package, and a node may have the same name.
    """
    python = (
        path
        for name, path in files(each.starter).items()
        if name.endswith(".py") and name != "setup.py"
    )
    text = "".join(path.read_text("utf-8") for path in python)
    statements = re.sub(r'#.*|"""[\s\S]*?"""', "", text)
    for node in each.card.nodes:
        assert f"'{node.node[1:]}'" not in statements
        for topic in node.publishes:
            assert not (topic.text and topic.text.partition("{")[0] in statements)


@few_labs("each")
@pytest.mark.parametrize("kind", ["starter", "solution"])
def test_it_builds_with_colcon(each: Lab, kind: str, tmp_path: Path) -> None:
    """In a workspace of its own; the solution then has every executable."""
    package: Path = getattr(each, kind)
    shutil.copytree(package, tmp_path / "src" / package.name)
    environment = {
        "PATH": f"{COLCON.parent}{os.pathsep}{os.environ['PATH']}",
        "HOME": str(tmp_path),
        "AMENT_PREFIX_PATH": os.environ.get("AMENT_PREFIX_PATH") or sys.prefix,
    }
    command = [
        str(COLCON) if COLCON.exists() else "colcon",
        "build",
        "--event-handlers",
        "console_direct+",
    ]
    built = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert built.returncode == 0, built.stdout + built.stderr
    installed = tmp_path / "install" / package.name
    assert (installed / "share" / package.name / "hook" / "ament_prefix_path.sh").is_file()
    if kind == "solution":
        programs = {path.name for path in (installed / "lib" / package.name).iterdir()}
        assert programs == set(inspect_package(package, each.card).entry_points)
        assert programs >= {node.executable for node in each.card.nodes}


# --- the hints ---------------------------------------------------------------------------------


@every_lab
def test_the_last_hint_has_code(each: Lab) -> None:
    """It promises "the same idea in other code"."""
    for name, hint in each.hints.items():
        assert any(line.startswith("    ") for line in hint.steps[2].splitlines()), name


@every_lab
def test_each_check_has_a_hint(each: Lab) -> None:
    """And no hint is for a check that is not there; each fits a screen."""
    assert list(each.hints) == list(each.card.points)
    lines = [
        line for hint in each.hints.values() for step in hint.steps for line in step.splitlines()
    ]
    assert max(map(len, lines)) <= LONGEST_LINE


@every_lab
def test_no_hint_can_be_pasted_as_the_answer(each: Lab) -> None:
    """No step holds a line of the solution's code, nor a text of the card."""
    answer = {line.strip() for line in _code(each.solution)} - {
        line.strip() for line in _code(each.starter)
    }
    answer = {line for line in answer if len(line) > len("pass")}
    for name, hint in each.hints.items():
        for step in hint.steps:
            given = {line.strip() for line in step.splitlines()} & answer
            assert not given - {"def __init__(self):"}, f"{name}: {given}"


def _code(package: Path) -> list[str]:
    python = (path for path in files(package).values() if path.suffix in {".py", ".xml"})
    return [line for path in python for line in path.read_text("utf-8").splitlines()]


# --- the mutants -------------------------------------------------------------------------------


@every_lab
def test_every_check_is_caught_by_a_mutant(each: Lab) -> None:
    """A check that no mutant fails is a check that nobody has seen at work."""
    caught = {check for mutant in each.mutants() for check in mutant.fails}
    assert caught == set(each.card.points)
    assert len(each.mutants()) >= FEWEST_MUTANTS


@pytest.mark.parametrize(("each", "mutant"), MUTANTS.values(), ids=MUTANTS.keys())
def test_a_mutant_is_wrong_where_it_says(each: Lab, mutant: Mutant, tmp_path: Path) -> None:
    """Its patch fits the solution; only a mutant about syntax is no Python."""
    package = mutant.make(each.solution, tmp_path / each.card.package)
    assert {n: p.read_bytes() for n, p in files(package).items()} != {
        n: p.read_bytes() for n, p in files(each.solution).items()
    }
    if "syntax" not in mutant.name:
        for path in package.rglob("*.py"):
            ast.parse(path.read_bytes())
