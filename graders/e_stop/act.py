"""Experiments with a button and a guard: press, freeze, fall silent, come late, pull a cable.

A grader plays what stands around the student's nodes: who commands, who presses, and the motors.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from graders.e_stop.contract import HostsContract, StopContract
from graders.e_stop.record import DriveSeen, EStopSeen, HostsSeen, MoveSeen, PressSeen, StopSeen
from roslings.arena import Companion, Host, Hosts, NoHosts, Plan, Process, two_hosts
from roslings.capabilities.qos.act import come_late
from roslings.capabilities.qos.contract import TimesContract
from roslings.capabilities.services.calling import Caller
from roslings.capabilities.services.contract import AnswerContract, ServiceContract
from roslings.capabilities.services.record import ServicesSeen
from roslings.capabilities.topics.full import full_values
from roslings.course import NodeContract, TopicContract
from roslings.course.contract import Plain
from roslings.experiment import Scene
from roslings.experiment.missed import hears, says
from roslings.experiment.start import PLAIN
from roslings.experiment.timing import timing

PLAYER = Path(__file__).with_name("player.py")
HZ = 20.0
OFFERED_DEADLINE_S = 0.1
"""The operator of the grader promises more than any guard asks for."""

READY_WITHIN_S = 20.0
SHOWS_WITHIN_S = 3.0
STOPS_WITHIN_S = 2.0
"""Beyond the time that the card gives: a late stop is still a stop, and told as late."""

STANDS_WITHIN_S = 1.0
STEADY_S, HOLDS_S, QUIET_S = 0.6, 0.6, 0.4
FAR_WITHIN_S = 30.0
"""Of announcements between two computers, one in ten is lost. The middleware asks once a second
whether one is missing. Of 80 nodes that found each other here, two needed seven seconds."""

INTERRUPT_SLACK_S = 1.0
Command = Mapping[str, float]


@dataclass(frozen=True)
class Roads:
    """The topics around a guard."""

    commands: TopicContract
    """What the operator wants."""
    button: TopicContract
    """Whether to stand still."""
    motors: TopicContract
    """What the motors are told."""
    alive: TimesContract
    """How the button's publisher gives signs of life."""


def operator_plan(roads: Roads) -> Plan:
    """Commands at a steady rate."""
    topic = roads.commands
    return {
        "commands": {
            "topic": topic.topic,
            "type": topic.type,
            "hz": HZ,
            "deadline_s": OFFERED_DEADLINE_S,
        }
    }


def button_plan(roads: Roads) -> Plan:
    """A latched button that gives signs of life."""
    times = {"liveliness": roads.alive.liveliness, "lease_s": roads.alive.lease_s}
    return {"button": {"topic": roads.button.topic, "type": roads.button.type, **times}}


def motors_plan(roads: Roads) -> Plan:
    """Motors that do what they are told."""
    return {"motors": {"topic": roads.motors.topic, "type": roads.motors.type}}


def client_plan(service: ServiceContract) -> Plan:
    """Somebody who presses."""
    return {"client": {"service": service.service, "type": service.type}}


def joiner_plan(topic: TopicContract) -> Plan:
    """Somebody who comes late to a latched topic."""
    return {"joiner": {"topic": topic.topic, "type": topic.type}}


@contextmanager
def beside(scene: Scene, name: str, *plans: Plan, host: Host | None = None) -> Iterator[Companion]:
    """A companion that plays all of `plans`, until the block ends; its name is hidden."""
    plan: dict[str, object] = {}
    for each in plans:
        plan |= each
    plan["name"] = f"_roslings_{name}"
    with scene.arena.companion(PLAYER, plan, scene.probe.notify, host) as played:
        with scene.busy():
            scene.until(lambda: played.ready, READY_WITHIN_S)
        yield played


# --- a guard -----------------------------------------------------------------------------------


class DrawnCommands:
    """What an operator wants, one command after the other.

    Each field is above zero in one command, and below it in the next.

    `backward`: the first one drives backward.
    """

    def __init__(self, scene: Scene, topic: TopicContract, backward: bool = False) -> None:
        self._scene, self._topic, self._backward = scene, topic, backward

    def another(self) -> dict[str, float]:
        """By names of fields, with dots."""
        between = self._scene.between
        wanted = full_values(self._topic.type, between, begins_below_zero=self._backward)
        self._backward = not self._backward
        return wanted


class Watched:
    """A guard between an operator and motors of ours: let drive, and given reasons to stop."""

    def __init__(
        self, scene: Scene, operator: Companion, motors: Companion, commands: DrawnCommands
    ) -> None:
        self._scene, self._operator, self._motors = scene, operator, motors
        self._commands = commands
        self.seen = scene.seen.recording(EStopSeen)
        self.moving = False
        """It has driven as it was told, the last time that it should have."""

    def drives(
        self,
        part: str,
        after: str,
        within_s: float = SHOWS_WITHIN_S,
        steady_s: float = STEADY_S,
    ) -> bool:
        """Nothing speaks against driving now: give a new command, and watch the motors."""
        began_ns = time.monotonic_ns()
        with timing(self._scene, part):
            command = self.command_anew()
            self.moving = self._scene.until_own(lambda: self._shows(command), within_s)
            if self.moving:
                self._scene.until(lambda: False, steady_s)
            until_ns = time.monotonic_ns()
        self.seen.drives.append(
            DriveSeen(part=part, after=after, command=command, began_ns=began_ns, until_ns=until_ns)
        )
        return self.moving

    def hears(self, button: Companion) -> None:
        """Wait until this button has found it."""
        self._scene.until_own(lambda: bool(button.told("joined")), SHOWS_WITHIN_S)

    def rests(self, part: str, cause: str, holds_s: float = HOLDS_S) -> None:
        """It has every reason to stand, and is watched for a while."""
        self.stands(part, cause, lambda: None, STANDS_WITHIN_S, holds_s=holds_s)

    def stops(
        self, reason: str, contract: StopContract, cause: str, make: Callable[[], object]
    ) -> None:
        """Give it the reason, and watch how soon the motors stand, and whether they stay so."""
        self.stands(reason, cause, make, contract.within_s, reason)

    def stands(
        self,
        part: str,
        cause: str,
        make: Callable[[], object],
        within_s: float,
        reason: str = "",
        holds_s: float = HOLDS_S,
    ) -> None:
        """The same for a reason that the card does not name by a word."""
        with timing(self._scene, part):
            began_ns = time.monotonic_ns()
            make()
            self._scene.until_own(lambda: self._stand_since(began_ns), within_s + STOPS_WITHIN_S)
            self._scene.until(lambda: False, holds_s)
            until_ns = time.monotonic_ns()
        self.seen.stops.append(
            StopSeen(part=part, reason=reason, cause=cause, began_ns=began_ns, until_ns=until_ns)
        )

    def close(self) -> None:
        """Write down what the motors were told, and when the operator commanded.

        >>> guard.close()
        """
        self.seen.moves += self._moved()
        self.seen.sent_ns += [each["sent"] for each in self._operator.told("sent")]

    def command_anew(self) -> dict[str, float]:
        """Let the operator want something else, as nobody can know before, in every field."""
        command = self._commands.another()
        self._operator.tell(drive=command)
        return command

    def _moved(self, since: int = 0) -> list[MoveSeen]:
        """What the motors were told; -1: only the last of it."""
        told = self._motors.told("moved")[since:]
        return [MoveSeen(at_ns=each["at"], fields=_moving(each["moved"])) for each in told]

    def _shows(self, command: Command) -> bool:
        return any(move.fields == command for move in self._moved(-1))

    def _stand_since(self, began_ns: int) -> bool:
        """The last message came after the reason, and says zero."""
        return any(move.at_ns > began_ns and not move.fields for move in self._moved(-1))


def _moving(fields: Mapping[str, float]) -> dict[str, float]:
    """Those fields that are not zero."""
    return {name: value for name, value in fields.items() if value}


@contextmanager
def watching(
    scene: Scene, operator: Companion, motors: Companion, commands: DrawnCommands
) -> Iterator[Watched]:
    """A guard that is watched until the block ends; then all that was seen of it is kept.

    >>> with watching(scene, operator, motors, DrawnCommands(scene, RAW)) as guard:
    ...     guard.drives("pressed", "the start")
    ...     guard.stops("pressed", STOPS["pressed"], "/e_stop says true", press)
    """
    watched = Watched(scene, operator, motors, commands)
    try:
        yield watched
    finally:
        watched.close()


# --- a button ----------------------------------------------------------------------------------


class Pressing:
    """Presses a button's service, and comes late to its topic."""

    def __init__(self, scene: Scene, service: ServiceContract, topic: TopicContract) -> None:
        self._scene, self._service, self._topic = scene, service, topic
        self._said = 1
        self.seen = scene.seen.recording(EStopSeen)

    def press_each(self, answers: Sequence[AnswerContract]) -> None:
        """Call for each of these answers; after each, look what somebody gets who comes then.

        An answer may come again: somebody presses twice. What was said at the start has been heard
        before. On a busy computer it can come so late that it looks like an answer to the first
        call.
        """
        self._scene.until(lambda: self._scene.heard(self._topic) > 0, SHOWS_WITHIN_S)
        for answer in answers:
            if self._press(self._service.answers.index(answer), answer):
                words = ", ".join(f"{name}: {value}" for name, value in answer.request.items())
                self.join(f"a call with {words.lower()}", answer.state)

    def _press(self, number: int, answer: AnswerContract) -> bool:
        """Whether an answer came."""
        with Caller(self._scene.probe, self._service.service, self._service.type) as caller:
            if not self._scene.until(lambda: caller.ready, SHOWS_WITHIN_S):
                return False
            began_ns, told = time.monotonic_ns(), self._scene.heard(self._topic)
            call = caller.send(dict(answer.request))
            call.seen.part, call.seen.number = self._service.service, number
            self._scene.seen.recording(ServicesSeen).calls.append(call.seen)
            answered = call.wait(SHOWS_WITHIN_S)
            self._scene.until(lambda: self._scene.heard(self._topic) > told, SHOWS_WITHIN_S)
            self._scene.until(lambda: False, QUIET_S)
        self._said += 1
        self.seen.presses.append(
            PressSeen(asked=dict(answer.request), began_ns=began_ns, until_ns=time.monotonic_ns())
        )
        return answered

    def join(self, after: str, wanted: Plain | None) -> None:
        """Subscribe now, and listen to what is there already."""
        come_late(self._scene, self._topic, after, wanted, self._said)


# --- two computers -----------------------------------------------------------------------------


@contextmanager
def two_computers(
    scene: Scene, contract: HostsContract, names: tuple[str, str]
) -> Iterator[Hosts | None]:
    """Two computers and the card's link; None where this one cannot play them, which is noted."""
    seen = scene.seen.recording(EStopSeen).hosts = HostsSeen()
    with ExitStack() as stack:
        hosts = None
        try:
            hosts = stack.enter_context(
                two_hosts(names, contract.delay_ms / 1000, contract.loss, scene.seed)
            )
        except NoHosts as refusal:
            seen.refused = str(refusal)
        yield hosts
        if hosts:
            seen.packets = dict(hosts.link.counts())


@contextmanager
def running_on(scene: Scene, host: Host, node: NodeContract) -> Iterator[Process]:
    """A node on one of two computers, whom no probe sees; Ctrl-C when the block ends."""
    with scene.arena.run(node.executable, PLAIN.arguments(), host=host) as process:
        scene.seen.processes[f"{node.executable} on the {host.name}"] = process.seen
        yield process
        process.interrupt(scene.ends_within_s + INTERRUPT_SLACK_S)


class Far:
    """What somebody does on one computer, for a node on the other."""

    def __init__(self, scene: Scene, operator: Companion, rover: Companion) -> None:
        """`operator` presses and commands; `rover` listens where the guard is."""
        self._scene, self._operator, self._rover = scene, operator, rover

    @property
    def seen(self) -> HostsSeen:
        """What is known of it."""
        hosts = self._scene.seen.recording(EStopSeen).hosts
        assert hosts, "two_computers() comes first"
        return hosts

    def finds_the_button(self, topic: TopicContract) -> bool:
        """The service is found beside it, and what it says on the topic, on the other computer."""
        self._scene.until_own(lambda: bool(self._operator.told("served")), READY_WITHIN_S)
        self._scene.until_back(lambda: bool(self._rover.told("heard")), says(topic), FAR_WITHIN_S)
        self.seen.served = bool(self._operator.told("served"))
        self.seen.heard = [each["heard"].get("data") for each in self._rover.told("heard")]
        return self.seen.served and bool(self.seen.heard)

    def call(self, answer: AnswerContract) -> None:
        """Press, and do not wait."""
        self._operator.tell(call=dict(answer.request))

    def finds_the_guard(self, topic: TopicContract) -> bool:
        """The operator's commands on the topic are heard on the other computer."""

        def is_matched() -> bool:
            return any(each["matched"] for each in self._operator.told("matched"))

        self.seen.matched = self._scene.until_back(is_matched, hears(topic), FAR_WITHIN_S)
        return self.seen.matched
