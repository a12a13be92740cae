"""Experiments with a camera that a node opens: its pictures, its light, and its troubles."""

from __future__ import annotations

import errno
import functools
import os
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

from ros2_on_pip.near_names import nearest
from roslings.arena import Process
from roslings.capabilities.camera.pixels import IMAGE, FilmLooker
from roslings.capabilities.camera.record import CAMERA
from roslings.capabilities.parameters.calling import set_parameter
from roslings.course import NodeContract, TopicContract
from roslings.evidence import StageMark
from roslings.experiment.missed import publishes, says
from roslings.experiment.scene import Scene
from roslings.experiment.start import Start
from roslings.experiment.timing import accounting
from roslings.probe.wall_clock import to_wall_ns
from roslings.seen.matching import nearest_endpoint
from roslings_rover.camera import Frame, Light, SocketCamera, SyntheticCamera
from roslings_rover.rover import Disc

MISSING, FORBIDDEN, BUSY = (errno.ENOENT,), (errno.EACCES,), (errno.EBUSY,)
GONE = (errno.ENODEV, errno.ENOENT, errno.EIO)
"""What opening or reading answers; a camera that was pulled out is one of several."""

PICTURES = 16
"""In a film that begins again; each is told from all others."""

"""The last part of the path at which the node finds it."""

GRAIN = 6.0
"""Noise, in levels: it tells two pictures apart where they show the same."""

SAYS_WITHIN_S, SILENT_WITHIN_S = 6.0, 1.5
"""For a trouble, and for one after another that it did not tell of."""

SHOWS_WITHIN_S = 4.0
"""A complete node's own time until its first picture: it may open its camera by a timer."""

ANSWERS_WITHIN_S = 5.0
COMES_WITHIN_S = 20.0


@contextmanager
def camera_beside(
    scene: Scene, shows: TopicContract, plugged_in: bool = True, parameter: str = "device"
) -> Iterator[Filming]:
    """A camera that films a ball which jumps about; the node finds it by a parameter.

    The node shows its pictures on the topic `shows`.

    >>> with camera_beside(scene, IMAGE) as filming, scene.run(CAMERA, start=filming.start()):
    ...     filming.await_pictures(PICTURES)
    """
    film = _film(scene)
    looker = FilmLooker(film)
    scene.probe.read_as_it_comes(IMAGE, looker.read)
    path = scene.arena.devices / CAMERA
    with SocketCamera(path, lambda number: film[number % PICTURES]) as camera:
        scene.arena.devices_late_ns[CAMERA] = lambda: camera.late_ns
        if plugged_in:
            camera.plug_in()
        yield Filming(scene, shows, camera, looker, parameter)


def _film(scene: Scene) -> list[Frame]:
    camera = SyntheticCamera(
        light=Light(noise=GRAIN), encoding="bgr8", seed=int(scene.between(0, 1e6))
    )
    return [camera.frame([_somewhere(scene)]) for _ in range(PICTURES)]


def _somewhere(scene: Scene) -> Disc:
    return Disc(scene.between(90, 550), scene.between(90, 390), scene.between(30, 80), hue=5)


class Filming:
    """The camera, and what is done to it and to the node that reads it."""

    def __init__(
        self,
        scene: Scene,
        shows: TopicContract,
        camera: SocketCamera,
        looker: FilmLooker,
        parameter: str,
    ) -> None:
        self.camera = camera
        self._shows = shows
        self._scene, self._looker, self._parameter = scene, looker, parameter
        self._speechless, self._part = False, "film"
        """It did not tell of the last trouble."""

    def start(self, settings: Mapping[str, bool | int | float | str] | None = None) -> Start:
        """How the node is started: with the name of this camera, and with other settings."""
        return Start(parameters={**(settings or {}), self._parameter: str(self.camera.path)})

    def begin(self, part: str) -> None:
        """A part of the experiment begins."""
        self._part = part
        self._scene.seen.stages.append(StageMark(part=part, at_ns=time.monotonic_ns()))

    def await_pictures(self, count: int) -> bool:
        """Wait until so many more pictures came on its topic, or on the one nearest to it.

        The camera is there: a node that shows nothing at all for long is not waited for again.
        """
        began_ns = time.monotonic_ns()
        if not self._scene.hear(self._shows, grace_s=SHOWS_WITHIN_S):
            return False
        return self._scene.until_own(lambda: self._came_after(began_ns) >= count, COMES_WITHIN_S)

    def await_return(self, count: int) -> bool:
        """The same after the camera was away: a node may take long until it looks again.

        Where it shows nothing beside a camera that is there, it is not waited for.
        """
        began_ns = time.monotonic_ns()

        def come() -> bool:
            return self._came_after(began_ns) >= count

        with accounting(self._scene, self._part):
            return self._scene.until_back(come, says(self._shows), COMES_WITHIN_S)

    def refuse(self, number: int) -> None:
        """From now on, opening the camera answers with this error; 0 for none."""
        self.camera.refuses = number
        if not self.camera.there:
            self.camera.plug_in()

    def await_trouble(self, process: Process, *numbers: int) -> bool:
        """Wait until the node writes a line with the system's words for one of these errors.

        A node without a publisher for its pictures is no camera yet: it is not waited for.
        """
        return self._await_words(process, [os.strerror(number) for number in numbers])

    def _await_words(self, process: Process, words: Sequence[str]) -> bool:
        before = len(process.lines())

        def said() -> bool:
            return any(word in line.text for line in process.lines()[before:] for word in words)

        no_camera_yet = functools.partial(self._scene.is_missed, publishes(self._shows))
        within_s = SILENT_WITHIN_S if self._speechless else SAYS_WITHIN_S
        with accounting(self._scene, self._part):
            self._scene.until_own(lambda: said() or no_camera_yet(), within_s)
        self._speechless = not said()
        return not self._speechless

    def expect_lighter(self, levels: float) -> None:
        """From now on, pictures may be lighter by so many levels of 255."""
        self._looker.expect_lighter(levels)

    def _came_after(self, began_ns: int) -> int:
        """By when they were sent: on a busy computer, pictures of before may still wait here."""
        topic = self._shows
        found = nearest_endpoint(self._scene.seen.graph, "publisher", topic.topic, topic.type)
        came = self._scene.probe.messages(found.topic) if found else []
        later_ns = to_wall_ns()
        sent_ns = (
            each.source_ns - later_ns if each.source_ns else each.arrival_ns for each in came
        )
        return sum(at_ns > began_ns for at_ns in sent_ns)


def change_parameter(
    scene: Scene, node: NodeContract, name: str, value: bool | int | float | str
) -> bool:
    """Set a parameter of a running node, or of the one nearest to it; whether it agreed."""
    near = nearest(node.node, scene.seen.graph.nodes)
    if near is None:
        return False
    return set_parameter(scene.probe, near.found, name, value, ANSWERS_WITHIN_S).accepted
