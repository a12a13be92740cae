"""Where board and camera are when nobody says where, on a computer that several users share."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import pytest
from program import environment, running

from roslings_rover.board.live import usual_port
from roslings_rover.camera.live import usual_path
from roslings_rover.usual_place import NoOwnPlace, own_folder, told_of, usual_place
from skips import skip_without

OTHER = 1007


@pytest.fixture
def tmp(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """What /tmp is to this user, without a session of the desktop."""
    folder = tmp_path / "tmp"
    folder.mkdir(mode=0o1777)
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    monkeypatch.delenv("XDG_RUNTIME_DIR", raising=False)
    return folder


def of_another(path: Path) -> Path:
    """A file of a real other user; only root can make one."""
    if os.geteuid() != 0:
        skip_without("root")
    path.touch()
    os.chown(path, OTHER, OTHER)
    return path


def test_one_user_has_the_path_of_the_card(tmp: Path) -> None:
    """Also where a board of this user's was before; no folder is made, and nothing is told."""
    assert usual_port() == tmp / "ttyROVER"
    assert usual_path() == tmp / "rover_camera"
    (tmp / "ttyROVER.lock").touch()
    (tmp / "rover_camera").touch()
    assert (usual_port(), usual_path()) == (tmp / "ttyROVER", tmp / "rover_camera")
    assert told_of(usual_port(), "ttyROVER", "port") == ""
    assert not own_folder().exists()


@pytest.mark.parametrize("left", ["ttyROVER", "ttyROVER.lock"])
def test_the_next_user_has_a_place_of_their_own(tmp: Path, left: str) -> None:
    """Nobody else can look into it; and it stays theirs when the other has gone."""
    taken = of_another(tmp / left)
    own = tmp / f"roslings-{os.getuid()}"
    assert usual_port() == own / "ttyROVER"
    assert own.stat().st_mode & 0o777 == 0o700
    words = told_of(usual_port(), "ttyROVER", "port")
    assert words.endswith(f"Start your node with: --ros-args -p port:={own}/ttyROVER")
    assert ("another user's" in words) == (left == "ttyROVER")
    taken.unlink()
    assert usual_port() == own / "ttyROVER"
    assert usual_path() == own / "rover_camera"


def test_a_dangling_name_of_another_counts(tmp: Path) -> None:
    """A board that was killed leaves a link that leads nowhere."""
    if os.geteuid() != 0:
        skip_without("root")
    (tmp / "ttyROVER").symlink_to("/dev/pts/no-such")
    os.lchown(tmp / "ttyROVER", OTHER, OTHER)
    assert usual_port() != tmp / "ttyROVER"


def test_a_session_has_a_folder_already(tmp: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is taken only where it is this user's, as after `su` it is not."""
    session = tmp / "run"
    session.mkdir()
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(session))
    assert own_folder() == session / "roslings"
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(of_another(tmp / "file")))
    assert own_folder() == tmp / f"roslings-{os.getuid()}"


def test_a_folder_that_is_not_ours_is_refused(tmp: Path) -> None:
    """Somebody was quicker: a link into their home, a folder that all can write to."""
    own = tmp / f"roslings-{os.getuid()}"
    (tmp / "theirs").mkdir(mode=0o700)
    own.symlink_to(tmp / "theirs")
    with pytest.raises(NoOwnPlace, match="--device"):
        usual_place("rover_camera", "--device")
    own.unlink()
    own.mkdir()
    own.chmod(0o777)
    with pytest.raises(NoOwnPlace, match="not yours"):
        usual_place("rover_camera", "--device")


@pytest.mark.parametrize(
    ("command", "name", "parameter"),
    [("board", "ttyROVER", "port"), ("camera", "rover_camera", "device")],
)
def test_the_command_prints_the_parameter(
    tmp: Path, tmp_path: Path, command: str, name: str, parameter: str
) -> None:
    """Where it is not the one that the card names."""
    of_another(tmp / name)
    surroundings = environment(0, tmp_path) | {"TMPDIR": str(tmp)}
    surroundings.pop("XDG_RUNTIME_DIR", None)
    with running([command], surroundings, tmp_path) as program:
        own = f"{tmp}/roslings-{os.getuid()}/{name}"
        program.wait_for(f"-p {parameter}:={own}")
        assert any(line.rstrip().endswith(own) for line in program.lines[:1]), program.lines
        assert program.interrupt() == 0
