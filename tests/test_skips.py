"""Every skip has a reason of `machine.py`, and its probe finds nothing; every other skip fails."""

from __future__ import annotations

import ast
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from machine import STARTED_WITH, TABLE, lack_of

HERE = Path(__file__).parent
HOOKED = """
from costs import add_costs_option, note_costs
from skips import hold_to_reasons

def pytest_addoption(parser):
    add_costs_option(parser)

def pytest_configure(config):
    note_costs(config)
    hold_to_reasons(config)
"""
SKIPS = frozenset(
    {"skip", "skipif", "importorskip", "xfail", "SkipTest", "Skipped", "skipUnless", "skipIf"}
)
BY_NAME = frozenset({"needs", "skip_without"})
ROOTS = {"tests": HERE, "days": HERE.parent / "days"}
WRITTEN_BY_OTHERS = HERE / "forgers/strangers"


def sources() -> Iterator[Path]:
    """Of all tests; `skips.py` alone may skip."""
    for folder in ROOTS.values():
        for file in folder.rglob("*.py"):
            if file.name != "skips.py" and WRITTEN_BY_OTHERS not in file.parents:
                yield file


def skips_in(source: str) -> Iterator[str]:
    """Each place that skips otherwise than by a name of the table."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Attribute) and node.attr in SKIPS:
            yield f"{node.lineno}: .{node.attr}"
        if isinstance(node, ast.ImportFrom) and node.module in ("pytest", "unittest"):
            yield from (f"{node.lineno}: {n.name}" for n in node.names if n.name in SKIPS)
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") in BY_NAME:
            names = [each.value for each in node.args if isinstance(each, ast.Constant)]
            yield from (f"{node.lineno}: {name!r}" for name in names if name not in TABLE)


def test_every_skip_goes_through_the_table() -> None:
    """No other way to skip stands in a test, and each name is one of the table."""
    found = {str(file): [*skips_in(file.read_text("utf-8"))] for file in sources()}
    assert len(found) > 200
    assert {file: places for file, places in found.items() if places} == {}


@pytest.mark.parametrize(
    "line",
    [
        "import pytest\npytest.skip('it rains')",
        "import pytest\n@pytest.mark.skipif(True, reason='it rains')\ndef test_it(): ...",
        "import pytest\npytest.importorskip('rclpy')",
        "import pytest\n@pytest.mark.xfail\ndef test_it(): ...",
        "from pytest import skip",
        "import unittest\nraise unittest.SkipTest('it rains')",
        "from skips import needs\npytestmark = needs('better weather')",
    ],
)
def test_each_other_way_is_found(line: str) -> None:
    """One place each."""
    assert len([*skips_in(line)]) == 1


# --- a run -------------------------------------------------------------------------------------


def outcome_of(folder: Path, source: str, *words: str, **changes: str) -> tuple[int, str]:
    """Status and words of a run of these tests."""
    (folder / "conftest.py").write_text(HOOKED, "utf-8")
    (folder / "test_it.py").write_text(f"import pytest, skips\n{source}", "utf-8")
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-p",
        "no:cacheprovider",
        f"--rootdir={folder}",
        f"--costs={folder / 'costs'}",
        "-c",
        os.devnull,
        *words,
        str(folder),
    ]
    environment = {**STARTED_WITH, "PYTHONPATH": str(HERE), **changes}
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    return done.returncode, done.stdout + done.stderr


def costs(folder: Path) -> list[tuple[str, str]]:
    """Outcome and lack of each line."""
    lines = map(json.loads, (folder / "costs").read_text("utf-8").splitlines())
    return [(each["outcome"], each["lack"]) for each in lines]


NO_REASON = "is no reason of tests/machine.py"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("def test_it(): pytest.skip('it rains')", NO_REASON),
        ("pytest.skip('it rains', allow_module_level=True)", NO_REASON),
        ("@pytest.mark.skip\ndef test_it(): ...", NO_REASON),
        ("@pytest.mark.parametrize('one', [])\ndef test_it(one): ...", NO_REASON),
        ("@pytest.mark.xfail\ndef test_it(): assert False", "a failure that is expected"),
        ("@pytest.fixture\ndef it(): pytest.skip('it rains')\ndef test_it(it): ...", NO_REASON),
        ("def test_it(): pytest.skip('no time for packages: over')", "but the probe finds it here"),
        (
            "import unittest\nclass TestIt(unittest.TestCase):\n"
            " def test_it(self): self.skipTest('it rains')",
            NO_REASON,
        ),
    ],
)
def test_a_skip_without_a_true_reason_fails(source: str, said: str, tmp_path: Path) -> None:
    """Wherever it skips, and however."""
    status, words = outcome_of(tmp_path, source, ROSLINGS_MUTANTS_UNTIL="inf")
    assert (status in (1, 2), said in words) == (True, True), words


SABOTAGE = """
def pytest_collection_modifyitems(items):
    import pytest
    for item in items:
        item.add_marker(pytest.mark.skip(reason="all is well"))
"""


def test_a_conftest_that_skips_everything_is_found(tmp_path: Path) -> None:
    """In a folder below the one with the hook."""
    below = tmp_path / "below"
    below.mkdir()
    (below / "conftest.py").write_text(SABOTAGE, "utf-8")
    (below / "test_below.py").write_text("def test_one(): ...\ndef test_two(): ...\n", "utf-8")
    status, words = outcome_of(tmp_path, "def test_it(): ...")
    assert status == 1 and "3 " in words and "may not be skipped" in words, words
    assert ("skipped", "") not in costs(tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("workers", ["0", "1"])
def test_a_true_reason_is_kept_with_the_outcome(workers: str, tmp_path: Path) -> None:
    """By a mark, in a test, for a whole file; also from another process."""
    (tmp_path / "test_file.py").write_text("import skips\nskips.skip_without('uvx')\n", "utf-8")
    source = """
@skips.needs("buildah")
def test_mark(): assert False
def test_within():
    skips.skip_without("time for packages")
    assert False
def test_neither(): skips.skip_without("time for slow tests")
"""
    status, words = outcome_of(
        tmp_path,
        source,
        "-n",
        workers,
        PATH=str(tmp_path),
        ROSLINGS_MUTANTS_UNTIL="0",
        ROSLINGS_SLOW_UNTIL="inf",
    )
    assert status == 0, words
    lacks = ["buildah", "time for packages", "uvx"]
    assert sorted(costs(tmp_path)) == [("passed", ""), *(("skipped", lack) for lack in lacks)]


# --- the probes --------------------------------------------------------------------------------

PROGRAMS = (
    "unshare",
    "small disk",
    "small disk of root's",
    "user without rights",
    "limit one level down",
    "bubblewrap",
    "other users",
    "Chromium",
    "buildah",
    "debootstrap",
    "uvx",
    "emulated board",
    *(name for name in TABLE if name.startswith("Python 3.")),
)
STUB = '#!/bin/sh\nexit "$STATUS"\n'
STARTS_ONE = ("unshare", "bubblewrap", "Chromium", "buildah", "debootstrap", "uvx", "Python 3.12")
FILE_OF = {"bubblewrap": "bwrap", "Chromium": "chromium-browser", "Python 3.12": "python3.12"}


@pytest.mark.parametrize("name", PROGRAMS)
def test_without_a_program_there_is_none(name: str, tmp_path: Path) -> None:
    """An empty path: the probe has tried it, and says what is missing."""
    assert TABLE[name].probe({"PATH": str(tmp_path)})


@pytest.mark.parametrize("name", STARTS_ONE)
@pytest.mark.parametrize("status", ["0", "1"])
def test_a_program_counts_where_it_runs(name: str, status: str, tmp_path: Path) -> None:
    """One that is there and ends with an error is none."""
    program = tmp_path / FILE_OF.get(name, name)
    program.write_text(STUB, "utf-8")
    program.chmod(0o755)
    assert bool(TABLE[name].probe({"PATH": str(tmp_path), "STATUS": status})) == (status == "1")


def test_who_asks_for_another_wall_has_no_namespaces() -> None:
    """By the variable of the course."""
    assert "another wall" in TABLE["namespaces"].probe({"ROSLINGS_ISOLATION": "domain"})


def test_time_is_over_at_its_moment() -> None:
    """And never where none is named."""
    probe = TABLE["time for slow tests"].probe
    assert probe({"ROSLINGS_SLOW_UNTIL": "1"}) and not probe({})
    assert not probe({"ROSLINGS_SLOW_UNTIL": "inf"})


def test_a_module_is_there_or_not() -> None:
    """pytest is; one of that name nobody has."""
    from machine import module

    assert module("pytest").probe({}) == ""
    assert module("nobody_has_this").probe({})


def test_root_is_who_runs_the_tests() -> None:
    """As the kernel says."""
    assert (lack_of("root") == "") == (os.geteuid() == 0)


def test_a_changed_path_changes_no_reason(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A test that hides programs from the course hides none from the probes."""
    before = lack_of("unshare")
    monkeypatch.setenv("PATH", str(tmp_path))
    assert TABLE["unshare"].probe(STARTED_WITH) == before
