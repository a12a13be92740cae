"""Experiments with pictures that are shown to a node, one after the other, in lock step."""

from __future__ import annotations

import array
import time
from dataclasses import dataclass

from graders.pi_camera.pictures import Pixels, draw_cross, draw_ring, keep_picture
from roslings.arena import Process
from roslings.capabilities.camera.pixels import IMAGE, MarkLooker
from roslings.capabilities.camera.record import (
    SURELY_COMES_BYTES,
    CameraSeen,
    DiscShown,
    PictureShown,
)
from roslings.course import TopicContract
from roslings.evidence import Endpoint
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.scene import Scene
from roslings.experiment.timing import accounting
from roslings.probe.content import to_plain
from roslings.seen.matching import nearest_endpoint
from roslings_rover.camera import Encoding, Frame, Light, SyntheticCamera
from roslings_rover.rover import Disc, PinholeCameraModel

MOST_TRIES, MOST_TRIES_OF_LARGE = 2, 6
FEWEST_TRIES = 2
SHOWS_WITHIN_S, SILENT_WITHIN_S = 1.0, 0.5
"""For an answer, and for one of a node that did not answer the picture before."""

TURNS_WITHIN_S = 6.0
FOLLOWS_WITHIN_S = 0.3
WORTH_SHOWING_PX = 3.0
USUAL_LIGHT = Light()
COLOURLESS = "mono8"
POINT = "geometry_msgs/msg/PointStamped"
NS_PER_S = 10**9


@dataclass(frozen=True)
class Shot:
    """A picture to be made: how large, in which encoding, under which light, with which balls."""

    width: int = 160
    height: int = 120
    encoding: Encoding = "bgr8"
    idle_bytes: int = 0
    light: Light = USUAL_LIGHT
    ball: Disc | None = None
    decoy: Disc | None = None

    def frame(self, seed: int) -> Frame:
        """The picture; the same seed draws the same noise.

        >>> frame = shot.frame(scene.seed)
        """
        camera_model = PinholeCameraModel(self.width, self.height)
        camera = SyntheticCamera(camera_model, self.light, self.encoding, self.idle_bytes, seed)
        return camera.frame([disc for disc in (self.decoy, self.ball) if disc])


def place_ball(
    scene: Scene,
    size: tuple[int, int],
    hue: int,
    smallest_px: float,
    away_from: Disc | None = None,
) -> Disc:
    """A ball that lies wholly in a picture of this size, at a place that nobody can know."""
    width, height = size
    radius = scene.between(smallest_px, max(smallest_px + 1, min(width, height) / 7))
    while True:
        u = scene.between(radius + 2, width - radius - 3)
        v = scene.between(radius + 2, height - radius - 3)
        if away_from is None or _apart(u, v, radius, away_from):
            return Disc(u, v, radius, hue)


def _apart(u: float, v: float, radius: float, other: Disc) -> bool:
    return max(abs(u - other.u_px), abs(v - other.v_px)) > radius + other.radius_px + 4


class Projector:
    """Shows pictures to a node, and lets it answer each before the next one comes.

    A picture that brings no answer is shown again: best effort may have lost it. Where the node
    uses names that are near to the card's, those are used.
    """

    def __init__(
        self,
        scene: Scene,
        process: Process,
        heard: TopicContract,
        says: TopicContract,
        draws: TopicContract,
    ) -> None:
        """`says` carries where the ball is, `draws` the picture for each that came."""
        self._scene, self._process = scene, process
        self._heard, self._says, self._draws = heard, says, draws
        self._looker = MarkLooker()
        self._silent = 0
        self._worst_px = -1.0
        self._worst: tuple[str, str, Pixels] | None = None
        scene.probe.read_as_it_comes(IMAGE, self._looker.read)
        scene.probe.read_as_it_comes(POINT, to_plain)

    def begin(self) -> None:
        """Wait until the node listens and can answer."""
        self._scene.appears(
            lambda: bool(self._subscription() and self._draws_on()),
            "what hears pictures and answers them",
        )

    def show(self, part: str, shot: Shot) -> None:
        """Show one picture, until it is answered or was shown often enough."""
        frame = shot.frame(len(self._scene.seen.part(CameraSeen).shown))
        self._looker.show(frame, shot.ball)
        seen = self._write_down(part, shot, frame)
        said, drawn = self._counts()
        with accounting(self._scene, part):
            self._show_until_answered(seen, frame, (said, drawn))
        if shot.ball and seen.answered:
            self._scene.until(lambda: self._counts()[0] > said, FOLLOWS_WITHIN_S)
        if seen.answered:
            self._silent = 0
        elif not _may_be_lost(frame):
            self._silent += 1
        seen.until_ns = time.monotonic_ns()
        self._keep(seen, frame, said)

    def _show_until_answered(
        self, seen: PictureShown, frame: Frame, before: tuple[int, int]
    ) -> None:
        within_s = SILENT_WITHIN_S if self._silent else SHOWS_WITHIN_S
        for _ in range(self._tries(frame)):
            if not self._send(seen, frame.content):
                break
            seen.answered = self._scene.until_own(lambda: self._counts()[1] > before[1], within_s)
            seen.turned = self._turned()
            seen.answered = seen.answered or self._counts() != before
            if seen.answered or not seen.turned:
                break

    def _tries(self, frame: Frame) -> int:
        """Fewer for a node that was silent before to what surely came: that tells enough."""
        if self._silent:
            return 1
        return MOST_TRIES_OF_LARGE if _may_be_lost(frame) else MOST_TRIES

    def show_spoiled(
        self,
        part: str,
        encoding: str,
        missing: int,
        words: str,
        width: int | None = None,
        height: int | None = None,
    ) -> None:
        """Show a picture whose header promises `missing` bytes more than there are.

        Or another `width` or `height` than it has.

        It is shown until the node writes a line with `words`, or was shown often enough.
        """
        shot = Shot()
        frame = shot.frame(0)
        seen = self._write_down(part, shot, frame)
        seen.encoding, seen.bytes = encoding, len(frame.content) - missing
        seen.width = seen.width if width is None else width
        seen.height = seen.height if height is None else height
        before = len(self._process.lines())
        for _ in range(FEWEST_TRIES):
            if not self._send(seen, frame.content[: seen.bytes]):
                break
            seen.answered = self._scene.until_own(
                lambda: self._wrote(words, before), SHOWS_WITHIN_S
            )
            seen.turned = self._turned()
            if seen.answered:
                break
        seen.until_ns = time.monotonic_ns()

    def keep_worst(self) -> None:
        """Keep the picture where the answer was the farthest from the ball, where one was wrong."""
        if self._worst:
            keep_picture(self._scene.seen, *self._worst)

    def _write_down(self, part: str, shot: Shot, frame: Frame) -> PictureShown:
        age_ns = round(self._scene.between(0.2, 2.0) * NS_PER_S)
        seen = PictureShown(
            part=part,
            topic=self._heard.topic,
            width=frame.width,
            height=frame.height,
            encoding=frame.encoding,
            step=frame.step,
            bytes=len(frame.content),
            stamp_ns=time.time_ns() - age_ns,
            frame_id=f"eye_{round(self._scene.between(100, 999))}",
            ball=_written(shot.ball),
            decoy=_written(shot.decoy),
        )
        self._scene.seen.recording(CameraSeen).shown.append(seen)
        return seen

    def _send(self, seen: PictureShown, content: bytes) -> bool:
        """Send it once more; whether there is a node that can hear it."""
        subscription = self._subscription()
        if subscription is None or subscription.type != IMAGE or not self._process.alive:
            return False
        sent_ns, _ = self._scene.probe.send(
            subscription, _message(seen, content), FIRST_MESSAGE_WITHIN_S
        )
        seen.sent_ns = seen.sent_ns or sent_ns
        seen.tries += 1
        return True

    def _turned(self) -> bool:
        subscription = self._subscription()
        return bool(
            subscription
            and self._process.alive
            and self._scene.turned(subscription.node, TURNS_WITHIN_S)
        )

    def _wrote(self, words: str, before: int) -> bool:
        return any(words in line.text for line in self._process.lines()[before:])

    def _counts(self) -> tuple[int, int]:
        """Answers so far: places, and pictures."""
        return self._count(self._says_on()), self._count(self._draws_on())

    def _count(self, endpoint: Endpoint | None) -> int:
        return self._scene.probe.count(endpoint.topic) if endpoint else 0

    def _subscription(self) -> Endpoint | None:
        graph = self._scene.seen.graph
        return nearest_endpoint(graph, "subscription", self._heard.topic, self._heard.type)

    def _says_on(self) -> Endpoint | None:
        return self._publisher(self._says)

    def _draws_on(self) -> Endpoint | None:
        return self._publisher(self._draws)

    def _publisher(self, contract: TopicContract) -> Endpoint | None:
        found = nearest_endpoint(self._scene.seen.graph, "publisher", contract.topic, contract.type)
        return found if found and found.type == contract.type else None

    # --- pictures for the report ---

    def _keep(self, seen: PictureShown, frame: Frame, said: int) -> None:
        """Keep the first picture that the node drew on, and remember the worst answer."""
        if seen.ball is None or seen.encoding == COLOURLESS:
            return
        place = self._place(said)
        if (
            self._looker.latest is not None
            and place
            and not self._scene.seen.part(CameraSeen).pictures
        ):
            words = f"{_where(seen)} {_answer(place)} This is the picture that your node drew."
            keep_picture(self._scene.seen, "What your node drew", words, self._looker.latest)
        off_px = _away(seen.ball, place) if place else float(frame.width)
        if off_px > max(self._worst_px, WORTH_SHOWING_PX):
            self._worst_px = off_px
            self._worst = (
                "Where the answer was the farthest from the ball",
                f"{_where(seen)} {_answer(place)} {_key(seen, place)}",
                _drawn(frame, seen.ball, place),
            )

    def _place(self, said: int) -> tuple[float, float] | None:
        """Where the node's last answer puts the ball; None without a new answer."""
        endpoint = self._says_on()
        if endpoint is None or self._count(endpoint) <= said:
            return None
        content = self._scene.probe.messages(endpoint.topic)[-1].content
        if content is None:  # it came before this screen was set up
            return None
        return float(content["point"]["x"]), float(content["point"]["y"])


def _may_be_lost(frame: Frame) -> bool:
    return len(frame.content) > SURELY_COMES_BYTES


def _written(disc: Disc | None) -> DiscShown | None:
    if disc is None:
        return None
    return DiscShown(x_px=disc.u_px, y_px=disc.v_px, radius_px=disc.radius_px, hue=disc.hue)


def _message(seen: PictureShown, content: bytes) -> object:
    from builtin_interfaces.msg import Time
    from sensor_msgs.msg import Image

    image = Image(height=seen.height, width=seen.width, encoding=seen.encoding, step=seen.step)
    seconds, rest_ns = divmod(seen.stamp_ns, NS_PER_S)
    image.header.stamp = Time(sec=seconds, nanosec=rest_ns)
    image.header.frame_id = seen.frame_id
    image.data = array.array("B", content)
    return image


def _away(ball: DiscShown, place: tuple[float, float]) -> float:
    return float(((ball.x_px - place[0]) ** 2 + (ball.y_px - place[1]) ** 2) ** 0.5)


def _where(seen: PictureShown) -> str:
    assert seen.ball
    return (
        f"A picture of {seen.width} x {seen.height} in {seen.encoding}. The ball is at column"
        f" {seen.ball.x_px:.1f}, row {seen.ball.y_px:.1f}."
    )


def _answer(place: tuple[float, float] | None) -> str:
    if place is None:
        return "Your node said nothing."
    return f"Your node said column {place[0]:.1f}, row {place[1]:.1f}."


def _key(seen: PictureShown, place: tuple[float, float] | None) -> str:
    """What the marks mean, and why one of them may be missing."""
    if place is None:
        return "The ring is the ball."
    inside = 0 <= place[0] < seen.width and 0 <= place[1] < seen.height
    where = "the cross is the answer" if inside else "the answer lies outside of the picture"
    return f"The ring is the ball; {where}."


def _drawn(frame: Frame, ball: DiscShown, place: tuple[float, float] | None) -> Pixels:
    rgb: Pixels = frame.rgb().copy()
    draw_ring(rgb, ball.x_px, ball.y_px, ball.radius_px + 2)
    if place:
        draw_cross(rgb, *place, arm_px=max(6.0, ball.radius_px / 2))
    return rgb
