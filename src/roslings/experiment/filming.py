"""Experiments with a camera that a node opens: its pictures, its light, and its troubles."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from roslings.arena import Process
from roslings.course import NodeContract, TopicContract
from roslings.devices.camera import Frame, Light, SocketCamera, SyntheticCamera
from roslings.devices.rover import Disc
from roslings.evidence import StageMark
from roslings.experiment.looking import IMAGE, FilmLooker
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.scene import Scene
from roslings.experiment.start import Start
from roslings.near import nearest, nearest_endpoint
from roslings.probe.calling import set_parameter

PICTURES = 16
"""In a film that begins again; each is told from all others."""

GRAIN = 6.0
"""Noise, in levels: it tells two pictures apart where they show the same."""

SAYS_WITHIN_S = 8.0
ANSWERS_WITHIN_S = 5.0
COMES_WITHIN_S = 20.0


@contextmanager
def camera_beside(
    scene: Scene, plugged_in: bool = True, parameter: str = "device"
) -> Iterator[Filming]:
    """A camera that films a ball which jumps about; the node finds it by a parameter.

    >>> with camera_beside(scene) as filming, scene.run(CAMERA, start=filming.start()):
    ...     scene.watch(PICTURES)
    """
    film = _film(scene)
    looker = FilmLooker(film)
    scene.probe.read_as_it_comes(IMAGE, looker.read)
    path = scene.arena.devices / "camera"
    with SocketCamera(path, lambda number: film[number % PICTURES]) as camera:
        if plugged_in:
            camera.plug_in()
        yield Filming(scene, camera, looker, parameter)


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
        self, scene: Scene, camera: SocketCamera, looker: FilmLooker, parameter: str
    ) -> None:
        self.camera = camera
        self._scene, self._looker, self._parameter = scene, looker, parameter

    def start(self) -> Start:
        """How the node is started: with the name of this camera."""
        return Start(parameters={self._parameter: str(self.camera.path)})

    def begin(self, part: str) -> None:
        """A part of the experiment begins."""
        self._scene.seen.stages.append(StageMark(part=part, at_ns=time.monotonic_ns()))

    def await_pictures(self, topic: TopicContract, count: int) -> bool:
        """Wait until so many more pictures came on a topic, or on the one nearest to it."""
        before = self._heard(topic)
        return self._scene.until(lambda: self._heard(topic) >= before + count, COMES_WITHIN_S)

    def refuse(self, number: int) -> None:
        """From now on, opening the camera answers with this error; 0 for none."""
        self.camera.refuses = number
        if not self.camera.there:
            self.camera.plug_in()

    def await_trouble(self, process: Process, *numbers: int) -> bool:
        """Wait until the node writes a line with the system's words for one of these errors."""
        return self._await_words(process, [os.strerror(number) for number in numbers])

    def _await_words(self, process: Process, words: Sequence[str]) -> bool:
        before = len(process.lines())

        def said() -> bool:
            return any(word in line.text for line in process.lines()[before:] for word in words)

        return self._scene.until(said, SAYS_WITHIN_S)

    def expect_lighter(self, levels: float) -> None:
        """From now on, pictures may be lighter by so many levels of 255."""
        self._looker.expect_lighter(levels)

    def _heard(self, topic: TopicContract) -> int:
        found = nearest_endpoint(self._scene.seen.graph, "publisher", topic.topic, topic.type)
        return self._scene.probe.count(found.topic) if found else 0


def change_parameter(
    scene: Scene, node: NodeContract, name: str, value: bool | int | float | str
) -> bool:
    """Set a parameter of a running node, or of the one nearest to it; whether it agreed."""
    scene.until(lambda: bool(scene.seen.graph.nodes), FIRST_MESSAGE_WITHIN_S)
    near = nearest(node.node, scene.seen.graph.nodes)
    if near is None:
        return False
    return set_parameter(scene.probe, near.found, name, value, ANSWERS_WITHIN_S).accepted
