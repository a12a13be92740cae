"""Experiments with a board at the other end of a serial cable."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from roslings.capabilities.parameters.contract import ParameterContract
from roslings.capabilities.robot.record import RobotSeen, WaySeen
from roslings.capabilities.serial.record import (
    BoardMark,
    BoardSeen,
    CableLimits,
    CableLine,
    MotorsSeen,
    SerialSeen,
)
from roslings.course import TopicContract
from roslings.evidence import Endpoint
from roslings.experiment.missed import hears, says
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.scene import Scene
from roslings.experiment.start import PLAIN, Start
from roslings.experiment.timing import accounting, timing
from roslings.seen.matching import nearest_endpoint
from roslings_rover.board import Board, Chunk, Mega
from roslings_rover.board.attached import AttachedBoard
from roslings_rover.board.wire import LATENCY_S, Wire
from roslings_rover.rover import Body, Box, Rover, World

NS_PER_US = 1000
SAY_EVERY_S = 0.05
STANDS_WITHIN_S = 5.0
STANDS_RAD_S = 0.02
SETTLES_LINES = 10
"""So many messages after the wheels stand, what was said before has been worked through."""

SPEAKS_WITHIN_S = 8.0
"""A complete node's own time until its first message: some wait until the board has started."""

COMMANDS_WITHIN_S = 1.0
"""Who sends a command without being told does so by a timer, several times a second."""

COMES_BACK_WITHIN_S = 40.0
ACTS_WITHIN_S = 0.3
"""Of the board's time; a node repeats its command twice a second at least."""

NONSENSE = [(math.nan, 0.0), (0.0, math.nan), (math.inf, 0.0), (0.0, -math.inf)]
"""Metres and radians a second that nobody can drive, in each of both fields."""

LONGEST_LINE = 200
PORT = "ttyROVER"
FLOOR = World(room=Box(-100.0, -100.0, 100.0, 100.0))


@contextmanager
def board_beside(
    scene: Scene,
    plugged_in: bool = True,
    parameter: str = "port",
    body: Body | None = None,
    bits_s: float = math.inf,
) -> Iterator[Cable]:
    """A rover's board in real time, on an empty floor; the node finds it by a parameter.

    With `bits_s`, the speed of its cable, lines arrive in pieces, cut anywhere. The rest of a line
    comes so late that a node reads in between. Where the scene has the port of a real board, that
    one takes its place.
    Raises DeviceTrouble when a board ends that should have lived.

    >>> with board_beside(scene) as cable, scene.run(BRIDGE, start=cable.start()):
    ...     cable.drive("straight", CMD_VEL, forward_m_s=0.3, for_s=1.5)
    """
    port = scene.arena.devices / PORT
    wire = Wire() if math.isinf(bits_s) else Wire(bits_s, LATENCY_S)
    with _chip(scene.port, body or Body()) as chip, Board(chip, port, wire) as board:
        if not plugged_in:
            board.unplug()
        with board.running():
            cable = Cable(scene, board, chip, parameter)
            try:
                yield cable
            finally:
                cable.write_down()
        if board.trouble:
            raise board.trouble


def unasked(scene: Scene, parameter: ParameterContract) -> Start:
    """How a node is started with nothing said about its board; no board is there.

    A real one that the default leads to is not touched: then the node gets a name of nothing.
    """
    if scene.arena.sees(Path(str(parameter.default))):
        return Start(parameters={parameter.name: str(scene.arena.devices / PORT)})
    return PLAIN


@contextmanager
def _chip(port: Path | None, body: Body) -> Iterator[Mega | AttachedBoard]:
    if port is None:
        yield Mega(Rover(FLOOR, body=body))
    else:
        with AttachedBoard(port, body) as attached:
            yield attached


class Cable:
    """The board, its cable, and the publisher that tells the node where to drive."""

    def __init__(
        self, scene: Scene, board: Board, chip: Mega | AttachedBoard, parameter: str
    ) -> None:
        self.board = board
        self._scene, self._chip, self._parameter = scene, chip, parameter
        self.seen = BoardSeen()
        self._way = WaySeen(name="where the rover really was", points_m=[])
        self._never_heard = 0
        """Lines that the board told before the node was there."""
        seen = scene.seen.recording(SerialSeen)
        seen.board, seen.limits = self.seen, CableLimits(stands_within_s=STANDS_WITHIN_S)

    def start(self, settings: Mapping[str, bool | int | float | str] | None = None) -> Start:
        """How the node is started: with the name of this port, and with other settings."""
        return Start(parameters={**(settings or {}), self._parameter: self.board.name})

    def drive(
        self,
        part: str,
        topic: TopicContract,
        forward_m_s: float = 0.0,
        turn_rad_s: float = 0.0,
        for_s: float = 1.5,
    ) -> None:
        """Say one motion again and again; marks how things stand at the end of it."""
        subscription = self._subscription(topic)
        if subscription is None:
            return
        with timing(self._scene, part):
            self.say(subscription, forward_m_s, turn_rad_s)
            since_s = self._now_s
            while self._now_s < since_s + for_s and self.say(subscription, forward_m_s, turn_rad_s):
                self._scene.until(self._goes_on, SAY_EVERY_S)
            self.mark(part, since_s)

    def flood(self, topic: TopicContract, motions: Sequence[tuple[float, float]]) -> None:
        """Say many motions without a pause between them."""
        subscription = self._subscription(topic)
        for forward_m_s, turn_rad_s in motions:
            if subscription is None or not self.say(subscription, forward_m_s, turn_rad_s):
                return

    def rest(self, part: str, counted: TopicContract) -> None:
        """Say nothing until the wheels stand and the node has told so; marks where the rover is."""
        with timing(self._scene, part):
            self._scene.until(self._stands, STANDS_WITHIN_S)
        behind = self._lines() - self._heard(counted) - self._never_heard
        self.await_messages(counted, max(0, behind) + SETTLES_LINES, STANDS_WITHIN_S)
        self.mark(part)

    def begin(self, counted: TopicContract) -> None:
        """Wait until the node tells what the board says, and says something itself.

        Marks the start. A node may be silent until it is told something: it has its time, no more.
        """
        self.await_messages(counted, SETTLES_LINES)
        self._scene.until_own(lambda: bool(self.board.heard), COMMANDS_WITHIN_S)
        self._never_heard = self._lines() - self._heard(counted)
        self._scene.seen.recording(RobotSeen).ways.append(self._way)
        self.mark("start")

    def await_messages(
        self, topic: TopicContract, count: int, within_s: float = COMES_BACK_WITHIN_S
    ) -> bool:
        """Wait until so many more messages came on a topic, or on the one nearest to it.

        The board is there: a node that says nothing at all for long is not waited for again.
        """
        before = self._heard(topic)
        if not self._scene.hear(topic, grace_s=SPEAKS_WITHIN_S):
            return False
        return self._scene.until(lambda: self._heard(topic) >= before + count, within_s)

    def await_return(self, part: str, topic: TopicContract, count: int) -> bool:
        """The same after the board was away: a node may take long until it looks again.

        What came is marked as `part`. Where it is silent beside a board that is there, it is not
        waited for.
        """
        before = self._heard(topic)

        def come() -> bool:
            return self._heard(topic) >= before + count

        with accounting(self._scene, part):
            came = self._scene.until_back(come, says(topic), COMES_BACK_WITHIN_S)
        if came:
            self.mark(part)
        return came

    def live(self, for_s: float) -> None:
        """Let so much of the board's time pass."""
        until_s = self._now_s + for_s
        self._scene.until(lambda: self._now_s >= until_s, 5 * for_s + STANDS_WITHIN_S)

    def mark(self, part: str, since_s: float | None = None) -> None:
        """Write down how things really are now, after a motion was said since a board's time."""
        truth = self._chip.truth
        self._note_place()
        self.seen.marks.append(
            BoardMark(
                part=part,
                arrival_ns=time.monotonic_ns(),
                board_s=truth.time_s,
                x_m=truth.pose.x_m,
                y_m=truth.pose.y_m,
                heading_rad=truth.pose.heading_rad,
                left_pwm=truth.left_pwm,
                right_pwm=truth.right_pwm,
                since_s=since_s,
            )
        )

    def say(self, subscription: Endpoint, forward_m_s: float, turn_rad_s: float) -> bool:
        """Say one motion; whether somebody was there to hear it. A dead node is not waited for.

        >>> cable.say(subscription, 0.2, 0.0)
        """
        if not self._lives():
            return False
        content = {"linear": {"x": forward_m_s}, "angular": {"z": turn_rad_s}}
        return self._scene.probe.say(subscription, content, FIRST_MESSAGE_WITHIN_S).matched

    def say_nonsense(self, part: str, topic: TopicContract) -> None:
        """Say motions that are no numbers, one after the other, and give each its time to act."""
        subscription = self._subscription(topic)
        if subscription is None or not self._lives():
            return
        self.mark(part)
        for forward_m_s, turn_rad_s in NONSENSE:
            if self.say(subscription, forward_m_s, turn_rad_s):
                self.live(for_s=ACTS_WITHIN_S)
        self.mark(f"{part}, over")

    def _goes_on(self) -> bool:
        """Never the end of a wait: only a moment to note where the rover is."""
        self._note_place()
        return False

    def _note_place(self) -> None:
        """Where the rover is now, for the picture of its way."""
        pose = self._chip.truth.pose
        self._way.points_m.append((round(pose.x_m, 4), round(pose.y_m, 4)))

    def write_down(self) -> None:
        """Put what the board and its cable saw into the evidence.

        >>> cable.write_down()
        """
        keeps = self._scene.probe.store.keeps
        self.seen.told = lines_of(self.board.told)
        self.seen.heard = [each for each in lines_of(self.board.heard) if keeps("requests", each)]
        self.seen.rejected = self._chip.counts.rejected
        self.seen.lost_bytes = self.board.lost_bytes
        self.seen.host_bits_s = self.board.port.host_bits_s
        self.seen.motors = [
            MotorsSeen(board_s=a.time_s, left_pwm=a.left_pwm, right_pwm=a.right_pwm)
            for a in self._chip.applied
        ]

    @property
    def _now_s(self) -> float:
        return self._chip.truth.time_s

    def _lives(self) -> bool:
        return self.board.trouble is None and all(
            seen.ended_ns is None for seen in self._scene.seen.processes.values()
        )

    def _stands(self) -> bool:
        self._note_place()
        truth = self._chip.truth
        speeds = (abs(truth.left_rad_s), abs(truth.right_rad_s))
        return max(speeds) < STANDS_RAD_S and truth.left_pwm == truth.right_pwm == 0

    def _lines(self) -> int:
        return sum(chunk.content.count(b"$W,") for chunk in self.board.told)

    def _heard(self, topic: TopicContract) -> int:
        found = nearest_endpoint(self._scene.seen.graph, "publisher", topic.topic, topic.type)
        return self._scene.probe.count(found.topic) if found else 0

    def _subscription(self, topic: TopicContract) -> Endpoint | None:
        def find() -> Endpoint | None:
            graph = self._scene.seen.graph
            return nearest_endpoint(graph, "subscription", topic.topic, topic.type)

        self._scene.appears(lambda: find() is not None, hears(topic))
        return find()


def lines_of(chunks: Sequence[Chunk]) -> list[CableLine]:
    """The lines in bytes that came in pieces; a line's time is that of its end.

    What has no end for too long is a line as well, a wrong one. The time is cut to microseconds, as
    the board's clock has them: nobody asks for more, and there are thousands of lines.

    >>> lines_of(board.told)
    """
    lines, begun = list[CableLine](), b""
    for chunk in chunks:
        *whole, begun = (begun + chunk.content).split(b"\n")
        if len(begun) > LONGEST_LINE:
            whole, begun = [*whole, begun], b""
        sent_ns = chunk.sent_ns // NS_PER_US * NS_PER_US
        lines += [
            CableLine(board_s=chunk.board_s, sent_ns=sent_ns, text=line.decode("latin-1"))
            for line in whole
            if line
        ]
    return lines
