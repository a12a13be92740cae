"""The camera behind a path: who may open it, what it gives, and what happens when it goes."""

from __future__ import annotations

import errno
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from roslings_rover.camera import Frame, SocketCamera
from roslings_rover.camera.live import CameraTaken, NoPlaceForCamera, NoSuchLight, ball_at, run
from roslings_rover.rover import PinholeCameraModel

WIDTH, HEIGHT = 8, 4
PICTURE_BYTES = WIDTH * HEIGHT * 3


def film(number: int) -> Frame:
    """Pictures of one value, and idle bytes, which must not go out."""
    row = bytes([number]) * (WIDTH * 3) + b"\xa5"
    return Frame(WIDTH, HEIGHT, "bgr8", len(row), row * HEIGHT)


@pytest.fixture
def camera(tmp_path: Path) -> Iterator[SocketCamera]:
    """Plugged in."""
    with SocketCamera(tmp_path / "camera", film) as camera:
        camera.plug_in()
        yield camera


@contextmanager
def opened(camera: SocketCamera) -> Iterator[tuple[socket.socket, int]]:
    """A program that opens it, and the number that it is answered."""
    with socket.socket(socket.AF_UNIX) as caller:
        caller.settimeout(20)
        caller.connect(str(camera.path))
        yield caller, caller.recv(1)[0]


def picture(caller: socket.socket) -> bytes:
    """Ask for one; fewer bytes where the camera goes meanwhile."""
    caller.sendall(b".")
    return caller.recv(PICTURE_BYTES, socket.MSG_WAITALL)


def test_each_letter_brings_the_next_picture(camera: SocketCamera) -> None:
    """Without the idle bytes of its rows."""
    with opened(camera) as (caller, number):
        assert number == 0
        assert [picture(caller) for _ in range(3)] == [bytes([n]) * PICTURE_BYTES for n in range(3)]
    assert camera.given >= 2  # it counts when the bytes are out


def test_it_knows_how_long_it_kept_its_user_waiting(tmp_path: Path) -> None:
    """Beyond its pace: here it takes its time over each picture."""

    def slow(number: int) -> Frame:
        time.sleep(0.2)
        return film(number)

    with SocketCamera(tmp_path / "slow", slow) as camera:
        camera.plug_in()
        with opened(camera) as (caller, _):
            assert [len(picture(caller)) for _ in range(2)] == [PICTURE_BYTES] * 2
        assert camera.late_ns > 0.2e9  # of the first one; the second may be counted later


def test_a_second_program_finds_it_busy_until_the_first_goes(camera: SocketCamera) -> None:
    """As a device file answers."""
    with opened(camera) as (_, first), opened(camera) as (_, second):
        assert (first, second) == (0, errno.EBUSY)
    number = errno.EBUSY
    while number:  # the camera notices in its own thread
        with opened(camera) as (_, number):
            pass


def test_it_can_be_forbidden(camera: SocketCamera) -> None:
    """Whoever opens it then gets the number, and no picture."""
    camera.refuses = errno.EACCES
    with opened(camera) as (caller, number):
        assert number == errno.EACCES
        assert caller.recv(1) == b""


def test_who_reads_when_it_is_pulled_out_gets_an_end(camera: SocketCamera) -> None:
    """Its name is gone, too; and it can be plugged in again."""
    with opened(camera) as (caller, _):
        picture(caller)
        camera.unplug()
        assert caller.recv(1) == b""
    assert not camera.path.exists()
    assert not camera.there
    camera.plug_in()
    with opened(camera) as (caller, number):
        assert number == 0
        assert len(picture(caller)) == PICTURE_BYTES


def test_no_thread_is_left(tmp_path: Path) -> None:
    """With a program that still has it open."""
    before = threading.active_count()
    with SocketCamera(tmp_path / "camera", film) as camera:
        camera.plug_in()
        with opened(camera) as (caller, _):
            picture(caller)
            camera.unplug()
    assert threading.active_count() == before


def test_the_ball_goes_round_and_stays_in_the_picture() -> None:
    """For a student who compares by eye."""
    camera_model = PinholeCameraModel()
    for number in range(0, 600, 7):
        ball = ball_at(number, 5, camera_model)
        assert ball.radius_px < ball.u_px < camera_model.width_px - ball.radius_px
        assert ball.radius_px < ball.v_px < camera_model.height_px - ball.radius_px
    assert ball_at(0, 5, camera_model) != ball_at(150, 5, camera_model)


def test_a_name_that_is_taken_is_said(camera: SocketCamera, tmp_path: Path) -> None:
    """By another camera, or by a file of somebody's."""
    with pytest.raises(CameraTaken, match="runs already"):
        run(camera.path, hue=5, noise=4.0)
    file = tmp_path / "thesis"
    file.write_text("mine")
    with pytest.raises(NoPlaceForCamera, match="a file of this name"):
        run(file, hue=5, noise=4.0)
    assert file.read_text() == "mine"
    with pytest.raises(NoSuchLight, match="0 to 179"):
        run(tmp_path / "new", hue=300, noise=4.0)
