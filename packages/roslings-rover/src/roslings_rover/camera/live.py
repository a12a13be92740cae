"""The rover's camera until Ctrl-C, for a student whose node needs something to look through."""

from __future__ import annotations

import math
import socket
import threading
from pathlib import Path

from roslings_rover.camera.camera import Light, SyntheticCamera
from roslings_rover.camera.frame import Frame
from roslings_rover.camera.on_socket import SocketCamera
from roslings_rover.errors import DeviceTrouble
from roslings_rover.models.pinhole import Disc, PinholeCameraModel
from roslings_rover.stop_signal import listening
from roslings_rover.usual_place import told_of, usual_place

TELL_EVERY_S = 1.0
NAME = "rover_camera"
PARAMETER = "device"
ROUND_PICTURES = 300
"""The ball is back at its first place after so many pictures."""


class NoPlaceForCamera(DeviceTrouble):
    """The camera's name cannot be made."""

    def __init__(self, path: Path, because: str) -> None:
        super().__init__(f"The camera {path} cannot be made: {because}. Give another --device.")


class NoSuchLight(DeviceTrouble):
    """No camera has this light."""

    def __init__(self, because: ValueError) -> None:
        super().__init__(f"{because}. See: ./roslings camera --help")


class CameraTaken(DeviceTrouble):
    """Another camera runs under this name."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"A camera runs already on {path}. End it with Ctrl-C there, or give another --device."
        )


def usual_path() -> Path:
    """Where the camera is when nobody says where. Raises NoOwnPlace."""
    return usual_place(NAME, "--device")


def ball_at(number: int, hue: int, camera_model: PinholeCameraModel) -> Disc:
    """Where the ball is in the n-th picture: it goes round, nearer and farther."""
    angle = 2 * math.pi * number / ROUND_PICTURES
    return Disc(
        u_px=camera_model.width_px * (0.5 + 0.32 * math.cos(angle)),
        v_px=camera_model.height_px * (0.55 + 0.25 * math.sin(2 * angle)),
        radius_px=35 + 15 * math.sin(angle),
        hue=hue,
    )


def run(asked_for: Path | None, hue: int, noise: float) -> None:
    """Run a camera until Ctrl-C, on that path or on the usual one. Raises DeviceTrouble."""
    path = asked_for or usual_path()
    _require_free(path)
    try:
        camera = SyntheticCamera(light=Light(ball_hue=hue, noise=noise), encoding="bgr8")
    except ValueError as error:
        raise NoSuchLight(error) from error

    def film(number: int) -> Frame:
        return camera.frame([ball_at(number, hue, camera.camera_model)])

    with SocketCamera(path, film) as device, listening() as asked:
        try:
            device.plug_in()
        except OSError as error:
            raise NoPlaceForCamera(path, error.strerror or str(error)) from error
        print(f"The camera is {path}")
        if not asked_for and (words := told_of(path, NAME, PARAMETER)):
            print(words)
        print("It shows a ball that goes round. Ctrl-C ends it.", flush=True)
        _tell(device, hue, camera.camera_model, asked)
        print()


def _tell(
    device: SocketCamera, hue: int, camera_model: PinholeCameraModel, asked: threading.Event
) -> None:
    told = 0
    while not asked.wait(TELL_EVERY_S):
        if device.given != told:
            told = device.given
            print(describe(told, ball_at(told - 1, hue, camera_model)), flush=True)


def describe(pictures: int, ball: Disc) -> str:
    """How many pictures were taken, and where the ball is in the last one; at most 80 columns."""
    place = f"column {ball.u_px:5.1f}, row {ball.v_px:5.1f}, radius {ball.radius_px:4.1f}"
    return f"{pictures:6d} pictures   ball: {place}, hue {ball.hue}"


def _require_free(path: Path) -> None:
    """Nothing of somebody else's is in the place. Raises NoPlaceForCamera, CameraTaken."""
    if not path.exists():
        return
    if not path.is_socket():
        raise NoPlaceForCamera(path, "a file of this name is there")
    with socket.socket(socket.AF_UNIX) as caller:
        try:
            caller.connect(str(path))
        except OSError:
            return  # one that was killed left its name behind
    raise CameraTaken(path)
