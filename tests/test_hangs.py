"""A test that hangs fails and says where it stood, the others go on, and so does the gate."""

from __future__ import annotations

import json
import math
import re
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest

from asked_for import MADE_FOR_ALL
from roslings.course import root
from slow import folders_of_tests

PYPROJECT = root() / "pyproject.toml"
GATE = (root() / ".ci/run").read_text("utf-8")
HANGS = textwrap.dedent("""
    import time
    from pathlib import Path

    import pytest

    @pytest.fixture
    def node():
        yield
        Path("put_away").touch()

    @pytest.fixture
    def never_ready():
        time.sleep(86400)

    def test_hangs(node):
        Path("begun").touch()
        time.sleep(86400)

    def test_waits_for_what_is_never_ready(node, never_ready):
        pass

    def test_next():
        pass
""")


def run_of_pytest(folder: Path, text: str, *words: str) -> subprocess.Popen[str]:
    """Of a file with this text, with the options of this project."""
    (folder / "test_it.py").write_text(text, "utf-8")
    ours = ["-c", str(PYPROJECT), "--rootdir=.", "--confcutdir=.", "-p", "no:cacheprovider"]
    return subprocess.Popen(
        [sys.executable, "-m", "pytest", *ours, *words, "test_it.py"],
        cwd=folder,
        stdout=subprocess.PIPE,
        text=True,
    )


@pytest.mark.slow
@pytest.mark.parametrize("processes", ["0", "1"])
def test_what_hangs_fails_and_is_put_away(processes: str, tmp_path: Path) -> None:
    """Only the limit is another."""
    with run_of_pytest(tmp_path, HANGS, "-n", processes, "--timeout=1") as run:
        said, _ = run.communicate()
    assert "1 failed, 1 passed, 1 error" in said
    assert said.count("time.sleep(86400)\n") >= 2
    assert said.count("Failed: Timeout") >= 2
    assert (tmp_path / "put_away").exists()


@pytest.mark.slow
def test_who_breaks_a_run_off_is_told_what_it_was_at(tmp_path: Path) -> None:
    """That test has not passed, and those before it have."""
    text = "def test_calm():\n    pass\n" + HANGS
    with run_of_pytest(tmp_path, text, "-p", "suite", "-n", "1", "--costs=costs") as run:
        while not (tmp_path / "begun").exists():
            assert run.poll() is None
            time.sleep(0.01)
        run.send_signal(signal.SIGINT)
        said, _ = run.communicate()
    assert "BROKEN OFF test_it.py::test_hangs" in said
    costs = map(json.loads, (tmp_path / "costs").read_text("utf-8").splitlines())
    assert {each["test"]: each["outcome"] for each in costs} == {
        "test_it.py::test_calm": "passed",
        "test_it.py::test_hangs": "failed",
    }


def test_every_test_has_a_limit(pytestconfig: pytest.Config) -> None:
    """By the plugin that keeps it, in this very run."""
    assert pytestconfig.pluginmanager.hasplugin("timeout")
    assert float(pytestconfig.getini("timeout")) > 0


def test_what_is_made_for_all_has_the_time_of_all() -> None:
    """A whole gallery takes longer than one test may: its first test would be broken off."""
    tests = [file for place in folders_of_tests() for file in place.rglob("test_*.py")]
    texts = {file.name: file.read_text("utf-8") for file in tests}
    making = {name for name, text in texts.items() if "in asked_for(request" in text}
    assert {"test_rogues.py", "test_forgers.py", "test_verdicts.py"} <= making
    assert [name for name in making if "MADE_FOR_ALL, asked_for" not in texts[name]] == []
    assert MADE_FOR_ALL.args > (limit_s(),)


def limit_s() -> int:
    """Of a test that has no limit of its own."""
    (limit,) = re.findall(r"^timeout = (\d+)", PYPROJECT.read_text("utf-8"), re.MULTILINE)
    return int(limit)


def test_every_stage_of_tests_in_the_gate_has_its_end() -> None:
    """Before the moment at which somebody else would cut it off, without a word."""
    moments = {
        name: int(at) for name, at in re.findall(r"^(\w+)=\$\(minute (\d+)\)$", GATE, re.MULTILINE)
    }
    limit_min = math.ceil(limit_s() / 60)
    assert moments["slow_until"] + limit_min <= moments["ends"] < 90
    runs = [line for line in GATE.splitlines() if re.match(r"(stage|trial) .*test\b", line)]
    alone = [line for line in runs if line.startswith("stage") and "in_time" not in line]
    assert runs and not alone
