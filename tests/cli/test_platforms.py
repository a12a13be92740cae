"""What `check` leaves for a platform where there is no verdict."""

from __future__ import annotations

import json
import shutil
import zipfile
from pathlib import Path

import pytest

from roslings.course import lab
from roslings.grading.platforms import for_others
from roslings.grading.shapes import SHAPES
from roslings_launcher.cli import main, parser


def refused(package: Path, tmp_path: Path) -> tuple[int, dict[str, str]]:
    """The exit code of a check that is refused, and the text of each platform's file."""
    places = {name: tmp_path / f"it.{name}" for name in SHAPES}
    options = [word for name, path in places.items() for word in (f"--{name}", str(path))]
    status = main(["check", "topics", str(package), *options])
    return status, {name: path.read_text("utf-8") for name, path in places.items()}


@pytest.mark.parametrize(
    ("files", "says"),
    [
        ((), "submission is empty"),
        (("work.zip",), "work.zip is an empty file"),
        (("chatter/package.xml", "COLCON_IGNORE"), "has the file COLCON_IGNORE"),
        (("chatter/package.xml",), "has no setup.py"),
    ],
)
def test_a_package_that_cannot_be_checked_leaves_a_result(
    files: tuple[str, ...], says: str, tmp_path: Path
) -> None:
    """In the student's words, without a path of the machine that grades."""
    package = tmp_path / "handed in"
    package.mkdir()
    for name in files:
        (package / name).parent.mkdir(exist_ok=True)
        (package / name).touch()
    status, told = refused(package, tmp_path)
    assert status == 2
    for text in told.values():
        assert says in text
        assert str(tmp_path) not in text
    assert json.loads(told["gradescope"])["score"] == 0


@pytest.mark.parametrize(
    ("name", "says"),
    [("../x", "leads out of the archive"), ("/etc/x", "absolute name"), ("readme.txt", "no ROS")],
)
def test_a_strangers_zip_is_opened_for_a_platform(name: str, says: str, tmp_path: Path) -> None:
    """Within its bounds, and refused in the student's words; nothing of it is left."""
    with zipfile.ZipFile(tmp_path / "work.zip", "w") as archive:
        archive.writestr(zipfile.ZipInfo(name), b"x")
    (tmp_path / "to").mkdir()
    status, told = refused(tmp_path / "work.zip", tmp_path / "to")
    assert status == 2
    for text in told.values():
        assert says in text
        assert str(tmp_path) not in text
    assert not (tmp_path / "x").exists()


@pytest.mark.parametrize("option", [f"--{name}" for name in SHAPES])
def test_no_verdict_for_others_without_a_wall(
    option: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It is refused with the reason before anything is built; the file has no score."""
    monkeypatch.setenv("ROSLINGS_ISOLATION", "domain")
    monkeypatch.setenv("CI", "true")
    package = tmp_path / "chatter"
    shutil.copytree(lab("topics").solution, package)
    file = tmp_path / "result"
    assert main(["check", "topics", str(package), option, str(file)]) == 2
    assert "nothing would hold it" in capsys.readouterr().err
    text = file.read_text("utf-8")
    assert "not be graded on this machine" in text
    gives_points = '"max_score": 100' if option == "--classroom" else '"score"'
    assert gives_points not in text
    assert "Grade :=>>" not in text
    assert str(tmp_path) not in text


@pytest.mark.parametrize("ci", ["", "true"])
def test_the_students_own_junit_needs_no_wall(ci: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Only where a continuous integration server believes it, it is for others."""
    monkeypatch.setenv("CI", ci)
    options = parser().parse_args(["check", "topics", "--junit", "it.xml"])
    assert for_others(options) is bool(ci)
    assert not for_others(parser().parse_args(["check", "topics", "--json", "it.json"]))
