"""A folder beside a grader: each grader gets its own, and who writes a mistake is told where."""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslings.capabilities.conformance import PURE, RUNS
from roslings.course import Lab, all_labs, root
from roslings.course.grader import load_grader
from roslings.folders.lab_folders import GRADERS, folder_beside, lab_folders
from roslings_launcher.sources import source_folders

GRADER = "from graders.beacon.demands import WORD\n"
LAYS = sorted(file for folder in lab_folders() for file in folder.glob("*.py"))


def course(folder: Path, word: str, grader: str = GRADER) -> Path:
    """A course with one grader and a folder beside it; the grader's file."""
    beside = folder / GRADERS / "beacon"
    beside.mkdir(parents=True)
    (beside / "__init__.py").touch()
    (beside / "demands.py").write_text(f"WORD = {word!r}\n")
    file = folder / GRADERS / "grade_beacon.py"
    file.write_text(grader)
    return file


def test_each_grader_gets_what_lies_beside_it(tmp_path: Path) -> None:
    """Two courses have a lab of the same name; and whose turn it is again has the same modules."""
    one, other = course(tmp_path / "one", "red"), course(tmp_path / "other", "green")
    first = load_grader(one)
    assert first.WORD == "red"
    before = sys.modules["graders.beacon.demands"]
    assert load_grader(other).WORD == "green"
    load_grader(one)
    assert sys.modules["graders.beacon.demands"] is before


def test_a_folder_that_is_a_link_is_the_same(tmp_path: Path) -> None:
    """A student's own card is a course whose folders are links: what was loaded stays loaded."""
    file = course(tmp_path / "course", "blue")
    load_grader(file)
    before = sys.modules["graders.beacon.demands"]
    own = tmp_path / "own" / GRADERS
    own.mkdir(parents=True)
    (own / "beacon").symlink_to(folder_beside(file))
    load_grader(Path(shutil.copy(file, own)))
    assert sys.modules["graders.beacon.demands"] is before


def test_a_folder_is_no_part_of_a_grader_that_has_none(tmp_path: Path) -> None:
    """It is told as any module that is not there."""
    file = tmp_path / "grade_lonely.py"
    file.write_text("from graders.lonely.demands import WORD\n")
    with pytest.raises(ModuleNotFoundError, match=r"graders\.lonely"):
        load_grader(file)


@pytest.mark.parametrize(
    ("file", "text", "told"),
    [
        ("contract.py", "from x import (\n", "graders/nodes/contract.py:1\nSyntaxError"),
        ("contract.py", "\nWORDS = Words()\n", "graders/nodes/contract.py:2\nNameError"),
        ("__init__.py", "import nothing_of_the_kind\n", "graders/nodes/__init__.py:1\nModuleNot"),
    ],
)
def test_a_mistake_in_a_folder_is_told_with_its_line(
    file: str, text: str, told: str, tmp_path: Path
) -> None:
    """Nothing is said of the package, and the next step is named; no traceback."""
    for part in ("labs/nodes", "graders/grade_nodes.py"):
        (tmp_path / part).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / part).symlink_to(root() / part)
    beside = tmp_path / "graders/nodes"
    beside.mkdir()
    (beside / "__init__.py").write_text(
        "from roslings.capability import Capability\n"
        'CAPABILITY = Capability("of_nodes", words="graders.nodes.contract:WORDS")\n'
    )
    (beside / file).write_text(text)
    done = subprocess.run(
        [sys.executable, "-m", "roslings", "check", "nodes", "--solution"],
        text=True,
        env={**os.environ, "ROSLINGS_COURSE": str(tmp_path)},
        capture_output=True,
        check=False,
    )
    assert done.returncode == 3, done.stdout + done.stderr
    assert told in done.stderr
    assert "Who writes the lab mends this line" in done.stderr
    assert "Traceback" not in done.stderr


# --- which way the arrows run -------------------------------------------------------------------


def taken_by(file: Path) -> Iterator[str]:
    """The modules that a file imports, also within functions."""
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{each.name}" for each in node.names)
        elif isinstance(node, ast.Import):
            yield from (each.name for each in node.names)


def test_no_package_knows_a_folder() -> None:
    """They are the labs'; what is proven of them is told by tables of names."""
    files = [file for above in source_folders(root()) for file in above.rglob("*.py")]
    known = {
        (file.name, name)
        for file in files
        for name in taken_by(file)
        if name.startswith(f"{GRADERS}.")
    }
    assert known == set()


@pytest.mark.parametrize("lab", all_labs(), ids=lambda lab: lab.name)
def test_a_lab_uses_its_own_folder_and_no_other(lab: Lab) -> None:
    """Else a change there would be one of this lab."""
    own = f"{GRADERS}.{lab.beside.name}"
    files = [lab.grader, *lab.beside.rglob("*.py")]
    taken = {name for file in files for name in taken_by(file) if name.startswith(f"{GRADERS}.")}
    assert {name for name in taken if not f"{name}.".startswith(f"{own}.")} <= {GRADERS}


@pytest.mark.parametrize(
    "file",
    [each for each in LAYS if each.stem in PURE],
    ids=lambda file: f"{file.parent.name}/{file.name}",
)
def test_what_reads_and_judges_runs_nothing(file: Path) -> None:
    """It imports neither ROS nor what measures, whoever leads there."""
    source = "import importlib, sys, roslings.folders.lab_folders\n"
    source += "importlib.import_module(sys.argv[1])\n"
    source += f"print(*[name for name in {RUNS} if name in sys.modules])"
    words = [sys.executable, "-c", source, f"{GRADERS}.{file.parent.name}.{file.stem}"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == ""
