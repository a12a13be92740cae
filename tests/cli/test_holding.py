"""A package from elsewhere: a line says that nothing holds it, and `--as-stranger` refuses it."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from roslings.commands.holding import is_strangers, told_of_no_wall
from roslings.course import lab
from roslings_launcher.cli import main, parser
from skips import needs

READS = """
import sys
sys.exit("GOT " + open({secret!r}).read())
"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Somebody else's, beside the student's workspace."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path / "ws"))
    made = tmp_path / "theirs/chatter"
    shutil.copytree(lab("topics").solution, made)
    return made


def line(package: Path, *words: str) -> str:
    """What is said of a package before it runs."""
    return told_of_no_wall(package, parser().parse_args(["check", "topics", *words]))


def test_a_line_says_that_nothing_holds_it(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the reason, and the option; not of one's own, the course's, or a trusted one."""
    monkeypatch.setenv("ROSLINGS_ISOLATION", "domain")
    said = line(package)
    assert said.startswith("Nothing holds this package") and "--as-stranger" in said
    assert "ROSLINGS_ISOLATION" in said and "\n" not in said
    assert line(tmp_path / "ws/src/chatter") == ""
    assert line(package, "--trust") == line(package, "--solution") == ""


@needs("namespaces", "bubblewrap")
def test_nothing_is_said_of_what_a_sandbox_holds(
    package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """There is nothing to say."""
    monkeypatch.delenv("ROSLINGS_ISOLATION", raising=False)
    assert line(package) == ""


@pytest.mark.parametrize(
    ("words", "others", "held"),
    [
        ([], False, False),
        ([], True, True),
        (["--trust"], True, False),
        (["--as-stranger"], False, True),
        (["--solution", "--as-stranger"], True, False),
    ],
)
def test_whose_package_is_held(words: list[str], others: bool, held: bool) -> None:
    """Who asks for the wall has it; the course's own needs none."""
    assert is_strangers(parser().parse_args(["check", "topics", *words]), others) is held


def test_where_nothing_holds_it_it_is_refused(
    package: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before anything of it runs: its setup.py would leave a file."""
    monkeypatch.setenv("ROSLINGS_ISOLATION", "domain")
    ran = package.parent / "ran"
    setup = package / "setup.py"
    setup.write_text(f"open({str(ran)!r}, 'w')\n{setup.read_text('utf-8')}", "utf-8")
    assert main(["check", "topics", str(package), "--as-stranger"]) == 2
    assert "nothing would hold it" in capsys.readouterr().err
    assert not ran.exists()


@pytest.mark.slow
@needs("namespaces", "bubblewrap", "bounded processes")
@pytest.mark.parametrize(("wall", "reads"), [("", False), ("domain", True)])
def test_it_reads_a_private_file_only_without_a_wall(
    wall: str, reads: bool, package: Path, tmp_path: Path
) -> None:
    """As its own check did; the same setup.py is held by `--as-stranger`."""
    secret = tmp_path / "private.txt"
    secret.write_text("the private words")
    (package / "setup.py").write_text(READS.format(secret=str(secret)), "utf-8")
    words = [sys.executable, "-m", "roslings", "check", "topics", str(package)]
    held = [] if wall else ["--as-stranger"]
    environment = {**os.environ, "ROSLINGS_ISOLATION": wall}
    done = subprocess.run(
        [*words, *held], env=environment, capture_output=True, text=True, check=False
    )
    assert ("GOT the private words" in done.stdout) is reads, done.stdout + done.stderr
    assert ("Nothing holds this package" in done.stderr) is reads
