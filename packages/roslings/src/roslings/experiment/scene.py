"""What a grader's experiment works with: nodes to run, topics to watch, sentences to say."""

from __future__ import annotations

import functools
import random
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.near_names import Near, nearest
from roslings.arena import LONGEST_WAIT_S, Arena, Process
from roslings.course import NodeContract, TopicContract
from roslings.evidence import Endpoint, ExperimentSeen, Part, Span
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S, WallWatch
from roslings.experiment.own_time import PATIENCE_S, OwnTime
from roslings.experiment.presence import GRACE_S, Absences, Presence, Turn
from roslings.experiment.simulated import (
    NotBelieved,
    SaysNothing,
    SimulatedWatch,
    followed_clock,
    let_pass,
)
from roslings.experiment.start import PLAIN, Start
from roslings.experiment.turns import Turns
from roslings.matching import nearest_endpoint
from roslings.probe import Probe
from roslings.probe.recorder import can_record
from roslings.timeline import noted

COMES_UP_WITHIN_S = 20.0
HEARD_WITHIN_S = 10.0
CONNECTS_WITHIN_S = 3.0
ENDED = "it ended by itself there"
AFTER_THE_TURN_S = 1.0
INTERRUPT_SLACK_S = 1.0
SPINS_WITHIN_S = 3.0
MOST_MISSED = 2
RESTS_WITHIN_S = 1.0
BELIEVES_AFTER_S = 3.0
"""Of a node's own time: then what another experiment has missed is not waited for here either."""

LOOKS_AT_REST = 3
LOOK_AGAIN_S = 0.005
FIRST_PERIODS = 3
"""So many periods of its rate may pass before a complete node speaks for the first time."""
SILENT_PERIODS = 10
"""Who says nothing for so many periods in real time is silent, and not only slow or in groups.

Of whom many periods of robot time went by in silence, QUIET_PERIODS of real time tell the rest: no
timer of it speaks, so only a thread of its own could.
"""
QUIET_PERIODS = 2.5
TIMERS_MAKE_WITHIN_S, THREADS_MAKE_WITHIN_S = 2.0, 0.5
"""For a publisher that a complete node has not got: of robot time, then of real time."""


@dataclass(frozen=True)
class Run:
    """A node that is to run, and how it is started."""

    node: NodeContract
    remaps: Sequence[str] = ()
    start: Start = PLAIN


class Scene:
    """One experiment: an arena where nodes run, and a probe that watches them."""

    def __init__(
        self,
        arena: Arena,
        probe: Probe,
        seed: int,
        ends_within_s: float,
        port: Path | None = None,
        turns: Turns | None = None,
        timeline: list[Span] | None = None,
        absences: Absences | None = None,
    ) -> None:
        """The clock is the one that `probe.seen` names; `port` leads to a real board.

        `turns` are those that it takes with the experiments beside it, `absences` what one of
        them has waited for in vain; what it does is noted in `timeline`.
        """
        self.port = port
        self._turns = turns or Turns()
        self._timeline = [] if timeline is None else timeline
        self._over: Counter[str] = Counter()
        """Nodes of blocks that are over: the fullest graph is kept, and they are still in it."""
        self._simulated = probe.seen.clock == "sim"
        self._presence = Presence(probe, arena, absences or Absences(), self._simulated)
        self._arena = arena
        self._probe = probe
        self.seed = seed
        """Of all that nobody can know before."""
        self.ends_within_s = ends_within_s
        """After Ctrl-C."""
        self.outlives_s = 0.0
        """Nodes run for at least so long: so long one ran that ended by itself in another run."""
        self._random = random.Random(seed)
        arena.on_change = probe.notify
        probe.seen.patience_s = PATIENCE_S

    @property
    def seen(self) -> ExperimentSeen:
        """What was seen so far."""
        return self._probe.seen

    @property
    def arena(self) -> Arena:
        """Where the processes run, for those that are no executable of the package."""
        return self._arena

    @property
    def probe(self) -> Probe:
        """The eyes and the voice, for what this class has no word for."""
        return self._probe

    @contextmanager
    def run(
        self, node: NodeContract, remaps: Sequence[str] = (), start: Start = PLAIN
    ) -> Iterator[Process]:
        """Start a node, wait until it is in the graph; press Ctrl-C when the block ends."""
        with self.run_all(Run(node, remaps, start)) as (process,):
            yield process

    @contextmanager
    def run_all(self, *runs: Run) -> Iterator[list[Process]]:
        """Start several nodes at once, as `run` does one; press Ctrl-C in all when the block ends.

        >>> with scene.run_all(Run(TALKER), Run(LISTENER)):
        ...     scene.joined(CHATTER)
        """
        known = self._present()
        with ExitStack() as running:
            with self._turns.busy(), self._noted("starting"):
                processes = [running.enter_context(self._started(each)) for each in runs]
                self._wait_up(processes, known)
            up_s = time.monotonic()
            since_up = OwnTime(self._arena) if self.outlives_s else None
            yield processes
            self._outlive(since_up)
            own = self._present() - known
            with self._noted("ending"):
                self._let_begin(processes, own, up_s)
                self._probe.look_now()  # the graph has all of them now
                for process in processes:
                    self._let_rest(process)
                self._end(processes)
        self._over += own

    def _outlive(self, since_up: OwnTime | None) -> None:
        """Let them run for as long, of their own time, as one that ended in another run."""
        if since_up:
            within_s = self.outlives_s + LONGEST_WAIT_S
            self._until_alive(lambda: since_up.is_past(self.outlives_s), within_s)

    @contextmanager
    def starting(self) -> Iterator[None]:
        """A stretch in which nodes start by another way than `run`: a launch file, say.

        >>> with scene.starting():
        ...     scene.until(lambda: process.alive, 5.0)
        """
        with self._turns.busy(), self._noted("starting"):
            yield

    def ending(self) -> AbstractContextManager[None]:
        """A stretch in which what was started so is asked to end, and waited for.

        >>> with scene.ending():
        ...     process.interrupt(scene.ends_within_s)
        """
        return self._noted("ending")

    def _noted(self, part: Part) -> AbstractContextManager[None]:
        return noted(self._timeline, part, self.seen.name)

    @contextmanager
    def _started(self, run: Run) -> Iterator[Process]:
        words = run.start.arguments(run.remaps, simulated=self._simulated)
        with self._arena.run(run.node.executable, words) as process:
            process.seen.given = [*run.start.parameters]
            self.seen.processes[run.start.label(run.node)] = process.seen
            yield process

    def _present(self) -> Counter[str]:
        """The nodes that are there, as far as they are known."""
        return Counter(self.seen.graph.nodes) - self._over

    def busy(self) -> AbstractContextManager[None]:
        """A stretch in which something of ours takes a processor: no times are judged meanwhile.

        >>> with scene.busy():
        ...     picture = draw_a_large_picture()
        """
        return self._turns.busy()

    def timed(self) -> AbstractContextManager[None]:
        """A stretch in which times are judged: no node of another experiment starts meanwhile.

        >>> with scene.timed():
        ...     asker.ask_in_a_row(SET_MAX_SPEED, SET_MAX_SPEED.answers, 100)
        """
        return self._turns.timed()

    def watch(self, contract: TopicContract) -> None:
        """Watch a topic, or the one nearest to it, until its rate is sure or the bound is met."""
        with self._timed_watching():
            if self._simulated:
                self._watch_simulated(contract)
            else:
                self._watch_on_the_wall(contract)

    def _watch_simulated(self, contract: TopicContract) -> None:
        """In two stretches of simulated time; what speaks against believing it is written down."""
        try:
            topic = self._publisher_in_time(contract).topic
            with (
                self._turns.busy(),
                followed_clock(self._probe, self.seen.graph.nodes) as (clock, barrier),
            ):
                barrier.lives = self._arena.all_alive
                SimulatedWatch(self._probe, clock, barrier, topic, contract.rate).watch()
            if not self._arena.all_alive():
                raise NotBelieved(ENDED)
        except NotBelieved as reason:
            self.seen.not_believed = str(reason) if self._arena.all_alive() else ENDED
            if isinstance(reason, SaysNothing):
                self._presence.note_for_good(no_timer_says(contract))

    def _publisher_in_time(self, contract: TopicContract) -> Endpoint:
        self._until_there(lambda: self._publisher(contract) is not None, publishes(contract))
        publisher = self._publisher(contract)
        if publisher is None:
            self._let_time_go_by(contract)
            raise NotBelieved("it publishes nothing")
        if can_record(publisher):
            self._until_connected(publisher)
        return publisher

    def _until_connected(self, publisher: Endpoint) -> None:
        """What was said before would be missed. Raises NotBelieved."""
        topic = publisher.topic
        if not self._until_alive(lambda: self._probe.connected(topic), CONNECTS_WITHIN_S):
            raise NotBelieved(f"no connection to its publisher on {topic} came up")

    def _let_time_go_by(self, contract: TopicContract) -> None:
        """What no timer has made in some seconds of robot time, only a thread could still make."""
        with (
            self._turns.busy(),
            followed_clock(self._probe, self.seen.graph.nodes) as (clock, barrier),
        ):
            barrier.lives = self._arena.all_alive
            let_pass(clock, barrier, TIMERS_MAKE_WITHIN_S)
            self._probe.look_now()
        if self._publisher(contract) is None:
            self._presence.note_for_good(no_timer_makes(contract))

    def _watch_on_the_wall(self, contract: TopicContract) -> None:
        if contract.rate:
            find = functools.partial(self._publisher, contract)
            quiet = self.is_missed(no_timer_says(contract))
            grace_s = (QUIET_PERIODS if quiet else SILENT_PERIODS) / contract.rate.hz
            WallWatch(
                self._probe, self._arena, contract.rate, find, self._until_alive,
                lambda: self._until_heard(contract, grace_s=grace_s), self._turns,
            ).watch()  # fmt: skip
        else:
            self.hear(contract)

    def say_sentences(self, listener: Process, contract: TopicContract, count: int) -> None:
        """Say random sentences on a topic, or on the one nearest to it, and wait for each echo.

        Two that are not repeated are enough: who says nothing is not told all of them.
        """
        ear, missed = self._ear(contract), 0
        for _ in range(count if ear else 0):
            assert ear is not None
            missed += not self._tell(listener, ear, self.sentence())
            if missed >= MOST_MISSED or not listener.alive:
                return

    def _ear(self, contract: TopicContract) -> Endpoint | None:
        """The subscription to a topic, or to the one nearest to it; None where there is none."""

        def find() -> Endpoint | None:
            return nearest_endpoint(self.seen.graph, "subscription", contract.topic, contract.type)

        self._until_there(lambda: find() is not None, hears(contract))
        return find()

    def sentence(self) -> str:
        """A sentence that nobody can know before it is said."""
        words = self._random.sample(WORDS, 3)
        return f"{' '.join(words)} {self._random.randrange(1000, 10000)}"

    def between(self, low: float, high: float) -> float:
        """A number that nobody can know before, to the third digit after the point."""
        return round(self._random.uniform(low, high), 3)

    def _tell(self, process: Process, ear: Endpoint, text: str) -> bool:
        """Say `text` to a listener and wait until it repeats it, or had its chance to."""
        with self._timed_watching():
            self._probe.say(ear, {"data": text}, FIRST_MESSAGE_WITHIN_S)

            def repeated() -> bool:
                return not process.alive or self.is_written(process, text)

            if not self._probe.until(repeated, AFTER_THE_TURN_S):
                turned = self._probe.turned(ear.node, HEARD_WITHIN_S)
                self._probe.until(repeated, AFTER_THE_TURN_S if turned else HEARD_WITHIN_S)
            return self.is_written(process, text)

    def is_written(self, process: Process, text: str) -> bool:
        """The text stands in the terminal or in /rosout.

        >>> scene.until(lambda: scene.is_written(process, "ready"), 5.0)
        """
        lines = [*process.lines(), *(line for log in self.seen.rosout.values() for line in log)]
        return any(text in line.text for line in lines)

    def joined(self, contract: TopicContract) -> None:
        """Wait until a publisher and a subscription of the topic are both in the graph."""

        def both() -> bool:
            kinds = {e.kind for e in self.seen.graph.endpoints if e.topic == contract.topic}
            return len(kinds) == 2

        with self._timed_watching():
            self._until_there(both, f"both sides of {contract.topic}")

    def _wait_up(self, processes: Sequence[Process], known: Counter[str]) -> None:
        """Until there is a node for each process that lives."""

        def up() -> bool:
            living = sum(process.alive for process in processes)
            return (self._present() - known).total() >= living

        self._probe.until(up, COMES_UP_WITHIN_S)

    def _let_begin(self, processes: Sequence[Process], nodes: Counter[str], up_s: float) -> None:
        """Wait until its nodes spin, as far as they ever do: no node ends well while it is made.

        A node is in the graph before its constructor has ended.
        """
        for node in nodes:
            left_s = up_s + SPINS_WITHIN_S - time.monotonic()
            if left_s > 0 and all(process.alive for process in processes):
                self._probe.turned(node, left_s)

    def _let_rest(self, process: Process) -> None:
        """Wait until it waits, as a node mostly does when somebody presses Ctrl-C.

        In the middle of a callback Python can hear Ctrl-C before rclpy does: then a second
        shutdown() is the first, and one mistake in fifty is not seen on a busy computer.
        """
        end_s, looks = time.monotonic() + RESTS_WITHIN_S, 0
        while looks < LOOKS_AT_REST and process.alive and time.monotonic() < end_s:
            looks = looks + 1 if process.asleep() else 0
            process.wait_ended(LOOK_AGAIN_S)

    def _end(self, processes: Sequence[Process]) -> None:
        within_s = self.ends_within_s + INTERRUPT_SLACK_S
        with ThreadPoolExecutor(len(processes)) as fingers:
            list(fingers.map(lambda process: process.interrupt(within_s), processes))

    def until(self, condition: Callable[[], bool], within_s: float) -> bool:
        """Wait for the condition, as long as every process lives. Whether it holds.

        >>> scene.until(lambda: scene.heard(CHATTER) >= 10, 8.0)
        """
        with self._timed_watching():
            return self._until_alive(condition, within_s)

    def turned(self, node: str, within_s: float) -> bool:
        """Wait until a node has run the callbacks of all that came; `within_s` of its own time."""
        turn = Turn(self._probe, node)
        return self.until_own(turn.is_over, within_s)

    def until_own(self, condition: Callable[[], bool], within_s: float) -> bool:
        """As `until`; what the processes wait for a processor comes on top, to a bound.

        >>> scene.until_own(lambda: not process.alive, 3.0)
        """
        own = OwnTime(self._arena)
        self.until(lambda: condition() or own.is_past(within_s), within_s + LONGEST_WAIT_S)
        return condition()

    def until_back(self, condition: Callable[[], bool], what: str, within_s: float) -> bool:
        """As `until_own`, for what was away: not for long where others have missed `what`, too.

        For a while even then: on a busy computer another experiment may have given up too early.

        >>> scene.until_back(lambda: scene.heard(IMAGE) > before, says(IMAGE), 10.0)
        """
        own = OwnTime(self._arena)

        def given_up() -> bool:
            return self.is_missed(what) and own.is_past(BELIEVES_AFTER_S)

        self.until_own(lambda: condition() or given_up(), within_s)
        return condition()

    def _until_alive(self, condition: Callable[[], bool], within_s: float) -> bool:
        """Wait for the condition, as long as every process lives."""
        self._probe.until(lambda: condition() or not self._arena.all_alive(), within_s)
        return condition()

    def appears(self, condition: Callable[[], bool], what: str, grace_s: float = GRACE_S) -> bool:
        """Wait for what a node makes when it begins; whether it is there.

        When all nodes are complete, it is waited for during `grace_s` of their own time, and in no
        later experiment: `what` is its name.

        >>> scene.appears(lambda: len(scene.seen.graph.nodes) == 2, "both nodes")
        """
        with self._timed_watching():
            return self._until_there(condition, what, grace_s)

    def is_missed(self, what: str) -> bool:
        """Some experiment of this grading has waited for it in vain.

        >>> scene.is_missed(publishes(CHATTER))
        """
        return self._presence.is_known(what)

    def hear(self, contract: TopicContract, count: int = 1, grace_s: float = GRACE_S) -> bool:
        """Wait for the first messages on a topic, or the one nearest to it, as `appears` does."""
        with self._timed_watching():
            return self._until_heard(contract, count, grace_s)

    def _until_heard(
        self, contract: TopicContract, count: int = 1, grace_s: float = GRACE_S
    ) -> bool:
        """First its publisher, then the connection to it, then what it says."""
        missed = self.is_missed(no_timer_makes(contract))
        self._until_there(
            lambda: self._publisher(contract) is not None,
            publishes(contract),
            THREADS_MAKE_WITHIN_S if missed else GRACE_S,
        )
        publisher = self._publisher(contract)
        if publisher is None:
            self._presence.note(says(contract), came=False)
            return False
        self._until_alive(
            lambda: self._probe.connected(publisher.topic) or not can_record(publisher),
            FIRST_MESSAGE_WITHIN_S,
        )
        limit = contract.rate
        periods_s = FIRST_PERIODS / limit.hz if limit else 0.0
        return self._until_there(
            lambda: self.heard(contract) >= count, says(contract), max(grace_s, periods_s)
        )

    def _until_there(
        self, condition: Callable[[], bool], what: str, grace_s: float = GRACE_S
    ) -> bool:
        """Wait for the condition, as long as every process lives and it is not in vain."""
        self._until_alive(
            lambda: condition() or self._presence.in_vain(what, grace_s), LONGEST_WAIT_S * 2
        )
        there = condition()
        self._presence.note(what, there)
        return there

    def _publisher(self, contract: TopicContract) -> Endpoint | None:
        return nearest_endpoint(self.seen.graph, "publisher", contract.topic, contract.type)

    def heard(self, contract: TopicContract) -> int:
        """How many messages came on a topic so far, or on the one nearest to it."""
        publisher = self._publisher(contract)
        return self._probe.count(publisher.topic) if publisher else 0

    @contextmanager
    def _timed_watching(self) -> Iterator[None]:
        began_s = time.monotonic()
        with self._noted("watching"):
            yield
        self.seen.watching_s += time.monotonic() - began_s


def publishes(contract: TopicContract) -> str:
    """The name of a publisher, where it is missed."""
    return f"a publisher on {contract.topic}"


def hears(contract: TopicContract) -> str:
    """The name of a subscription, where it is missed."""
    return f"a subscription to {contract.topic}"


def says(contract: TopicContract) -> str:
    """The name of the first message on a topic, where it is missed."""
    return f"a message on {contract.topic}"


def no_timer_says(contract: TopicContract) -> str:
    """The name of what did not come while simulated time went by."""
    return f"a timer's message on {contract.topic}"


def no_timer_makes(contract: TopicContract) -> str:
    """The name of a publisher that was not made while simulated time went by."""
    return f"a timer's publisher on {contract.topic}"


def mending(node: NodeContract, seen: ExperimentSeen) -> list[str]:
    """Remap rules that put a node's slips right, as seen when it ran alone.

    So a misspelt topic, judged where it belongs, does not cost a second check.
    """
    here = seen.graph
    name = nearest(node.node, here.nodes)
    pairs = [
        *((t, nearest_endpoint(here, "publisher", t.topic, t.type)) for t in node.publishes),
        *((t, nearest_endpoint(here, "subscription", t.topic, t.type)) for t in node.subscribes),
    ]
    topics = [f"{e.topic}:={t.topic}" for t, e in pairs if e and e.topic != t.topic]
    return [*(_renaming(name) if name and not name.exact else []), *topics]


def _renaming(name: Near) -> list[str]:
    wanted_space, _, wanted = name.wanted.rpartition("/")
    found = name.found.rpartition("/")[2]
    return [f"{found}:__node:={wanted}", f"{found}:__ns:={wanted_space or '/'}"]


WORDS = (
    "amber",
    "anchor",
    "apple",
    "autumn",
    "bridge",
    "candle",
    "canyon",
    "cedar",
    "cherry",
    "cobalt",
    "comet",
    "copper",
    "coral",
    "cotton",
    "crystal",
    "desert",
    "ember",
    "falcon",
    "feather",
    "forest",
    "garden",
    "ginger",
    "glacier",
    "granite",
    "harbour",
    "hazel",
    "island",
    "ivory",
    "jasmine",
    "lantern",
    "lemon",
    "maple",
    "marble",
    "meadow",
    "mirror",
    "mountain",
    "ocean",
    "olive",
    "orchid",
    "pebble",
    "pepper",
    "planet",
    "prairie",
    "purple",
    "rainbow",
    "river",
    "saffron",
    "scarlet",
    "silver",
    "summer",
    "sunset",
    "thunder",
    "timber",
    "velvet",
    "violet",
    "walnut",
    "willow",
    "winter",
)
