"""Nodes are left running where results count: a talker that dies later is found by nothing else.

./roslings test packages/roslings-class/tests/batch/test_batch_soak.py -m slow
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from roslings.course import lab
from roslings.course.soak import SOAK
from roslings_launcher.cli import main

TOPICS = lab("topics")
CLOCK = "time.monotonic() - self.began"


def dying(package: Path, after_s: float) -> Path:
    """The solution, whose talker dies so many seconds after its start, whatever /clock says."""
    shutil.copytree(TOPICS.solution, package / "chatter")
    talker = package / "chatter" / "chatter" / "talker.py"
    text = talker.read_text("utf-8").replace("import rclpy\n", "import time\n\nimport rclpy\n", 1)
    made, said = "        self.count = 0\n", "        message = String()\n"
    assert text.count(made) == text.count(said) == 1
    text = text.replace(made, f"{made}        self.began = time.monotonic()\n")
    died = f"        if {CLOCK} > {after_s}:\n            raise RuntimeError('flat battery')\n"
    talker.write_text(text.replace(said, died + said), "utf-8")
    return package


def verdicts(gradebook: Path) -> dict[str, Mapping[str, Any]]:
    """Submission to its verdict."""
    with sqlite3.connect(gradebook / "gradebook.sqlite") as connection:
        rows = [json.loads(text) for (text,) in connection.execute("SELECT result FROM latest")]
    return {row["submission"]: row["verdict"] for row in rows}


def failed(verdict: Mapping[str, Any]) -> list[str]:
    """The checks that did not pass."""
    return [check["id"] for check in verdict["checks"] if check["outcome"] != "pass"]


def hand_in(folder: Path, dies_after_s: float) -> Path:
    """A right package, and one whose talker dies."""
    shutil.copytree(TOPICS.solution, folder / "right" / "chatter")
    dying(folder / "dies", dies_after_s)
    return folder


@pytest.mark.slow
def test_who_dies_after_a_while_is_found_by_grade(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Both are left running at once; the gradebook says for how long."""
    given = hand_in(tmp_path / "in", 9.0)
    assert (
        main(["grade", "topics", str(given), "--out", str(tmp_path / "out"), "--soak", "14"]) == 0
    )
    assert "left running for 14 s" in capsys.readouterr().out
    told = verdicts(tmp_path / "out")
    assert (told["right"]["score"], told["right"]["soak_s"]) == (100, 14)
    assert "talker_stays" in failed(told["dies"])


@pytest.mark.slow
@pytest.mark.twice
def test_who_dies_after_twenty_seconds_loses_that_check_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """For as long as the card promises, with no option at all."""
    monkeypatch.delenv(SOAK)
    given = hand_in(tmp_path / "in", 20.0)
    assert main(["grade", "topics", str(given), "--out", str(tmp_path / "out")]) == 0
    told = verdicts(tmp_path / "out")
    assert (told["right"]["score"], told["right"]["soak_s"]) == (100, TOPICS.card.soak_s)
    assert failed(told["dies"]) == ["talker_stays"]


def pack(folder: Path, package: Path, *words: str) -> subprocess.Popen[str]:
    """`./roslings pack topics`, with the zip in `folder`."""
    command = [sys.executable, "-m", "roslings", "pack", "topics", str(package), *words]
    return subprocess.Popen(
        command,
        cwd=folder,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )


@pytest.mark.slow
def test_a_hand_in_tells_of_a_node_that_does_not_stay(tmp_path: Path) -> None:
    """The file is made all the same: what it is worth, the student decides."""
    out, _ = pack(tmp_path, dying(tmp_path / "src", 4.0), "--soak", "8").communicate()
    assert "talker ended by itself after" in out
    assert "Its last line: RuntimeError: flat battery" in out
    assert "listener ran for" in out
    assert zipfile.ZipFile(tmp_path / "topics.zip").testzip() is None


@pytest.mark.slow
def test_ctrl_c_while_the_nodes_run_harms_nothing(tmp_path: Path) -> None:
    """The file was whole before anything ran."""
    packing = pack(tmp_path, TOPICS.solution, "--soak", "600")
    assert packing.stderr
    while "Your nodes run for 600 s" not in packing.stderr.readline():
        assert packing.poll() is None
    os.killpg(packing.pid, signal.SIGINT)
    out, _ = packing.communicate(timeout=60)
    assert packing.returncode == 0
    assert "The file is whole." in out
    assert zipfile.ZipFile(tmp_path / "topics.zip").testzip() is None
    assert [each.name for each in tmp_path.iterdir()] == ["topics.zip"]


@pytest.mark.parametrize("seconds", ["-1", "601", "long"])
def test_no_number_of_seconds_is_told(seconds: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Before anything is run."""
    with pytest.raises(SystemExit) as end:
        main(["pack", "topics", f"--soak={seconds}"])
    assert end.value.code == 2
    assert "no number of seconds from 0 to 600" in capsys.readouterr().err
