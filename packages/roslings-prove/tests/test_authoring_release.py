"""The students' edition: no answer leaks, and its README's commands work as they stand."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslings import course
from roslings.course import all_labs
from roslings_class.release import CannotRelease, is_for_students, leaks, release
from sources import python_path
from until_told import run_until_told


@pytest.fixture(scope="module")
def edition(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The students' edition of this course."""
    folder = tmp_path_factory.mktemp("release") / "roslings"
    release(folder)
    return folder


def test_no_solution_mutant_or_hidden_check_is_in_it(edition: Path) -> None:
    """Neither as a file nor as text; each lab is there without them."""
    names = [path.relative_to(edition).as_posix() for path in edition.rglob("*")]
    assert not [name for name in names if re.match(r"labs/[^/]+/(solution|mutants)", name)]
    assert not [name for name in names if re.match(r"graders/hidden_", name)]
    assert not [name for name in names if name.startswith(".git/")]
    assert list(leaks(edition, all_labs())) == []
    for lab in all_labs():
        kept = {path.name for path in (edition / "labs" / lab.name).iterdir()}
        assert kept >= {"card.yaml", "task.md", "hints.yaml", "starter"}


@pytest.mark.slow
def test_its_lessons_run_under_nbval(edition: Path) -> None:
    """What `./roslings test days --nbval-lax` needs is in it: each cell of each day is a test."""
    words = ["days", "--nbval-lax", "--collect-only", "-qq", "-n0"]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *words],
        cwd=edition,
        check=False,
        env={**os.environ, "PYTHONPATH": python_path(edition)},
        capture_output=True,
        text=True,
    )
    counts = dict(re.findall(r"^days/([^/]+)/lesson\.ipynb: (\d+)$", done.stdout, re.MULTILINE))
    days = [path.parent for path in edition.glob("days/*/lesson.ipynb")]
    assert sorted(counts) == sorted(day.name for day in days), done.stdout + done.stderr
    assert len(days) == 12 and all(int(count) > 10 for count in counts.values())


def test_each_mutant_sentence_and_answer_line_is_kept_back(edition: Path) -> None:
    """A grep over every file, apart from the one that `release` itself does."""
    texts = [path.read_text("utf-8", "replace") for path in edition.rglob("*") if path.is_file()]
    whole = "\n".join(texts)
    for lab in all_labs():
        given = {path.read_text("utf-8") for path in lab.starter.rglob("*.py")}
        answers = {path.read_text("utf-8") for path in lab.solution.rglob("*.py")} - given
        assert not [answer for answer in answers if answer in whole and "setup(" not in answer]
        for mutant in lab.mutants():
            assert mutant.what not in whole


def test_a_planted_answer_is_found(edition: Path, tmp_path: Path) -> None:
    """Also with other indents and between other words."""
    lab = course.lab("topics")
    answer = (lab.solution / "chatter" / "talker.py").read_text("utf-8")
    (tmp_path / "lesson.md").write_text(re.sub("^", "    ", answer, flags=re.M), "utf-8")
    (tmp_path / "notes.md").write_text(f"Wrong: {lab.mutants()[0].what}", "utf-8")
    found = "\n".join(leaks(tmp_path, [lab]))
    assert "lesson.md holds the solution of topics: chatter/talker.py" in found
    assert "notes.md tells a mutant of topics" in found


def test_what_goes_to_students_is_told_by_the_path() -> None:
    """Also for files that do not exist yet."""
    assert is_for_students("labs/new/starter/new/setup.py")
    assert not is_for_students("labs/new/solution/new/setup.py")
    assert not is_for_students("labs/new/mutants/x.yaml")
    assert not is_for_students("graders/hidden_new.py")
    assert not is_for_students("tests/labs/test_verdicts.py")
    assert is_for_students("example/labs/example/solution/beacon/setup.py")


def test_it_replaces_nothing(tmp_path: Path) -> None:
    """A folder that holds something stays as it is."""
    (tmp_path / "mine").write_text("")
    with pytest.raises(CannotRelease):
        release(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]


def commands_of(edition: Path) -> list[str]:
    """The README's two commands, without the remarks behind them."""
    block = (edition / "README.md").read_text("utf-8").partition("```bash\n")[2].partition("```")[0]
    return [line.partition("#")[0].strip() for line in block.splitlines()]


@pytest.mark.slow
def test_the_first_command_works_without_a_solution(edition: Path, tmp_path: Path) -> None:
    """With the Python of this environment, in the released course."""
    first, second = commands_of(edition)
    assert second == "./roslings test"
    environment = {**os.environ, "PYTHONPATH": python_path(edition), "HOME": str(tmp_path)}
    environment.pop("ROSLINGS_COURSE", None)
    words = [sys.executable, "-m", "roslings", *first.split()[1:]]
    done = run_until_told(words, cwd=edition, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "100 of 100" in done.stdout
    words = [sys.executable, "-m", "roslings", "check", "topics", "--solution"]
    done = subprocess.run(
        words, cwd=edition, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert "students' edition" in done.stderr


def imported_by(file: Path) -> Iterator[str]:
    """The first words of what a file imports, wherever in it."""
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.Import):
            yield from (each.name.partition(".")[0] for each in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield (node.module or "").partition(".")[0]


def test_what_its_tests_import_of_the_tests_is_in_it() -> None:
    """Nothing has to be made for this to be seen."""
    tests = course.root() / "tests"
    missing = {
        f"{file.relative_to(course.root())} imports {name}"
        for file in (*tests.rglob("*.py"), *course.root().glob("packages/*/tests/**/*.py"))
        if is_for_students(file.relative_to(course.root()).as_posix())
        for name in imported_by(file)
        for place in (f"{name}.py", f"{name}/__init__.py")
        if (tests / place).is_file() and not is_for_students(f"tests/{place}")
    }
    assert missing == set()


@pytest.mark.slow
def test_its_tests_find_all_that_they_import(edition: Path) -> None:
    """Nothing that a test of the edition imports is left out: they can be collected."""
    words = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-p", "no:cacheprovider"]
    environment = {**os.environ, "PYTHONPATH": python_path(edition)}
    done = subprocess.run(
        words, cwd=edition, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.slow
def test_both_commands_work_as_they_stand(edition: Path, tmp_path: Path) -> None:
    """As a student types them: the first one makes the environment."""
    own = {"HOME": str(tmp_path), "PATH": os.environ["PATH"]}
    more = {name: text for name, text in os.environ.items() if name.startswith(("PIP_", "SSL_"))}
    for command in commands_of(edition):
        done = subprocess.run(
            ["bash", "-c", command],
            cwd=edition,
            env={**more, **own},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
