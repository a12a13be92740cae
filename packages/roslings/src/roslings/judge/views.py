"""Evidence as a grader asks about it: this topic, that process, or the nearest to it."""

from __future__ import annotations

import string
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, TypeVar

from ros2_on_pip.near_names import Near, nearest
from ros2_on_pip.rates import LONGEST_STALL_S, Rate, measure_rate
from roslings.course import NodeContract, PictureContract, TopicContract
from roslings.evidence import (
    BuildSeen,
    Endpoint,
    Evidence,
    ExperimentSeen,
    LogLine,
    MessageSeen,
    PackageSeen,
    PictureSeen,
    ProcessSeen,
    Qos,
    TopicSeen,
)
from roslings.judge.faults.reasons import NothingSeen, StoodStill
from roslings.judge.lines import texts_of, written_by
from roslings.seen.exits import (
    is_outlived,
    is_told_in_real_time,
    simulated_life_s,
    without_interrupt,
)
from roslings.seen.matching import nearest_endpoint, own_endpoints
from roslings.seen.rates import in_the_watch, measure_simulated_rate, own_rate

LAST_LINES = 40
V = TypeVar("V", bound="View")
Demand = Callable[[V], None]


class View:
    """Something that a demand can be made of: `view.must(have_rate(...))`."""

    def must(self: V, *demands: Demand[V]) -> None:
        """Make each demand in turn; the first one that is not met raises its fault."""
        for demand in demands:
            demand(self)


@dataclass(frozen=True)
class PackageView(View):
    """The package's files, and what colcon did with them."""

    files: PackageSeen
    built: BuildSeen | None
    lab: str

    def picture(self, contract: PictureContract) -> PictureView:
        """One of the card's pictures."""
        return PictureView(contract, self.files.pictures.get(contract.path), self.lab)


@dataclass(frozen=True)
class PictureView(View):
    """A picture that the card asks for, and the file that stands there."""

    contract: PictureContract
    seen: PictureSeen | None
    lab: str


@dataclass(frozen=True)
class NodeView(View):
    """The node in the graph that is, or is nearest to, the one in the contract."""

    near: Near
    count: int = 1
    """How many nodes have this name."""


@dataclass(frozen=True)
class ProcessView(View):
    """One process, and what its node wrote."""

    seen: ProcessSeen
    experiment: ExperimentSeen
    before: tuple[ProcessSeen, ...] = ()
    """As it ended in earlier runs of the experiment, which were made again for its end alone."""
    elsewhere: tuple[ProcessSeen, ...] = ()
    """The same executable in other runs, of this experiment or another."""
    doubted: tuple[tuple[ProcessSeen, ExperimentSeen], ...] = ()
    """It in runs of the experiment whose times were not believed. It is not there where it ended by
    itself in simulated time, and the run in real time tells what that is worth."""
    soaked: ProcessSeen | None = None
    """The same executable in the soak; None where none was made, or others tell of its end."""

    @cached_property
    def lines(self) -> list[LogLine]:
        """Everything it wrote, each line once, whether it was printed or logged."""
        return written_by(self.seen, self.experiment)

    @property
    def texts(self) -> list[str]:
        """The same without logger's decorations; what it printed and logged is one line."""
        return list(texts_of(self.lines))

    def wrote(self, text: str) -> bool:
        """It wrote a line that is `text`, or holds it."""
        texts = self.texts
        return text in texts or any(text in line for line in texts)

    def last_lines(self, count: int = LAST_LINES) -> tuple[str, ...]:
        """The end of what it wrote to the terminal, without a traceback that our Ctrl-C made."""
        return tuple(line.text for line in without_interrupt(self.seen)[-count:])

    @property
    def lines_of_its_end(self) -> tuple[str, ...]:
        """The same with it, for whom its end is the question."""
        return tuple(line.text for line in self.seen.lines[-LAST_LINES:])

    @property
    def runs(self) -> Iterator[ProcessView]:
        """It in each run of the experiment, whatever was thought of the run's clock."""
        yield from (ProcessView(seen, experiment) for seen, experiment in self.doubted)
        yield self

    @property
    def is_simulated(self) -> bool:
        """Its time was the grader's."""
        return self.experiment.clock == "sim"

    @property
    def ran_s(self) -> float:
        """Seconds from start to end; of its own time where that is simulated."""
        if self.is_simulated:
            return simulated_life_s(self.seen, self.experiment)
        ended_ns = self.seen.ended_ns or self.seen.started_ns
        return (ended_ns - self.seen.started_ns) / 1e9

    @property
    def shown(self) -> bool:
        """Its node was in the graph."""
        return bool(self.experiment.graph.nodes)

    @property
    def acted(self) -> bool:
        """It published something, so it came further than its own start."""
        return any(topic.messages for topic in self.experiment.topics.values())


@dataclass(frozen=True)
class EndpointView(View):
    """A publisher or subscription that is, or is nearest to, the one in the contract."""

    endpoint: Endpoint | None
    contract: TopicContract
    kind: Literal["publisher", "subscription"]
    node: Near | None
    siblings: tuple[Endpoint, ...]

    @property
    def found(self) -> Endpoint:
        """The endpoint. Raises NothingToJudge where there is none."""
        if self.endpoint is None:
            raise NothingSeen("endpoint", self.kind)
        return self.endpoint

    @property
    def near(self) -> Near:
        """How its topic's name differs; a name carried along by the node's namespace does not."""
        name = self.found.topic
        if self.node and self.node.how == "namespace" and name == self._carried_name(self.node):
            name = self.contract.topic
        near = nearest(self.contract.topic, [name])
        assert near is not None
        return near

    @property
    def qos(self) -> Qos:
        """Its quality of service."""
        return self.found.qos

    def _carried_name(self, node: Near) -> str:
        namespace = node.found.rpartition("/")[0]
        return f"{namespace}/{self.contract.topic.rpartition('/')[2]}"


@dataclass(frozen=True)
class TopicView(View):
    """The messages on the topic that is, or is nearest to, the one in the contract."""

    contract: TopicContract
    name: str
    type: str
    heard: TopicSeen
    experiment: ExperimentSeen

    @property
    def messages(self) -> tuple[MessageSeen, ...]:
        """In the order of arrival."""
        return tuple(self.heard.messages)

    @property
    def before_ctrl_c(self) -> tuple[MessageSeen, ...]:
        """Those that came before all nodes were asked to end: later ones may be half made."""
        asked_ns = [each.asked_to_end_ns for each in self.experiment.processes.values()]
        end_ns = max((at_ns for at_ns in asked_ns if at_ns is not None), default=None)
        if end_ns is None or None in asked_ns:
            return self.messages
        return tuple(message for message in self.messages if message.arrival_ns < end_ns)

    @property
    def rate(self) -> Rate | None:
        """How often they came; None for too few. By the clock that ruled the experiment."""
        seen = self.experiment
        if seen.clock == "sim":
            return measure_simulated_rate(self.messages, seen.ticks, seen.segments)
        return own_rate(measure_rate(in_the_watch(self.messages, seen)), seen)

    @property
    def texts(self) -> list[str]:
        """The text in each message. Raises NothingToJudge where there is no text field."""
        contents = [m.content for m in self.messages]
        texts = [c["data"] for c in contents if isinstance(c, dict) and "data" in c]
        if not texts or not all(isinstance(text, str) for text in texts):
            raise NothingSeen("texts")
        return texts

    def numbers(self) -> list[int]:
        """The counter in each text. Raises NothingToJudge where there is none to read."""
        pattern = text_pattern(self.contract.text or "{n}")
        found = [pattern.number_in(text) for text in self.texts]
        numbers = [number for number in found if number is not None]
        if len(numbers) < 2:
            raise NothingSeen("numbers")
        return numbers


@dataclass(frozen=True)
class ExperimentView(View):
    """All that was seen in one experiment."""

    seen: ExperimentSeen
    before: tuple[ExperimentSeen, ...] = ()
    """Earlier runs that were believed, and made again to see a second time how they end."""
    doubted: tuple[ExperimentSeen, ...] = ()
    """Earlier runs whose times were not believed: what a node did there, it did."""
    soaked: Mapping[str, ProcessSeen] = field(default_factory=dict)
    """Executable to its process in the soak."""
    others: tuple[ExperimentSeen, ...] = ()
    """All other runs, of this experiment and of others."""

    def process(self, node: NodeContract) -> ProcessView:
        """The process of a node. Raises NothingToJudge where it was never started."""
        if node.executable not in self.seen.processes:
            raise NothingSeen("process", node.executable)
        return self.labelled(node.executable)

    def labelled(self, label: str) -> ProcessView:
        """The process that the experiment gave this name. Raises KeyError.

        >>> twice.labelled("/left/first").must(stay_up)
        """
        runs = [each.processes[label] for each in self.before if label in each.processes]
        before = tuple(process for process in runs if process.ending)
        doubted = tuple(
            (each.processes[label], each)
            for each in self.doubted
            if label in each.processes and not is_told_in_real_time(label, each, self.seen)
        )
        seen = self.seen.processes[label]
        return ProcessView(
            seen,
            self.seen,
            before,
            elsewhere=self._elsewhere(seen.executable),
            doubted=doubted,
            soaked=self.soaked.get(seen.executable),
        )

    def _elsewhere(self, executable: str) -> tuple[ProcessSeen, ...]:
        processes = (each for run in self.others for each in run.processes.values())
        return tuple(each for each in processes if each.executable == executable)

    def node(self, node: NodeContract) -> NodeView:
        """The node, or the nearest to it. Raises NothingToJudge where there is none.

        Raises Inconclusive where this computer stood still: a node that ends soon may be gone
        before it is seen.
        """
        near = nearest(node.node, self.seen.graph.nodes)
        if near is None and self.seen.stall_s > LONGEST_STALL_S:
            raise StoodStill(self.seen.stall_s, node_is_missing=True)
        if near is None:
            raise NothingSeen("node")
        return NodeView(near, self.seen.graph.nodes.count(near.found))

    def publisher(self, node: NodeContract, topic: TopicContract) -> EndpointView:
        """What publishes the topic, or the nearest to it."""
        return self._endpoint(node, topic, "publisher")

    def subscription(self, node: NodeContract, topic: TopicContract) -> EndpointView:
        """What subscribes to the topic, or the nearest to it."""
        return self._endpoint(node, topic, "subscription")

    def published_by(self, node: NodeContract) -> list[str]:
        """The topics that a node publishes, without those of ROS itself.

        >>> assert telling.published_by(BEACON) == [ALIVE.topic]
        """
        name = self.node(node).near.found
        ends = own_endpoints(self.seen.graph)
        return sorted({e.topic for e in ends if e.kind == "publisher" and e.node == name})

    def topic(self, contract: TopicContract) -> TopicView:
        """The messages on the topic, or on the nearest to it.

        Raises NothingToJudge where nothing was published at all.
        """
        endpoint = nearest_endpoint(self.seen.graph, "publisher", contract.topic, contract.type)
        if endpoint is None:
            raise NothingSeen("topic")
        heard = self.seen.topics.get(endpoint.topic)
        return TopicView(
            contract,
            endpoint.topic,
            endpoint.type,
            heard or TopicSeen(name=endpoint.topic, type=endpoint.type),
            self.seen,
        )

    def _endpoint(
        self, node: NodeContract, topic: TopicContract, kind: Literal["publisher", "subscription"]
    ) -> EndpointView:
        if not self.seen.graph.nodes:
            raise NothingSeen("node")
        graph = self.seen.graph
        same = tuple(e for e in own_endpoints(graph) if e.kind == kind)
        found = nearest_endpoint(graph, kind, topic.topic, topic.type)
        return EndpointView(found, topic, kind, nearest(node.node, graph.nodes), same)


@dataclass(frozen=True)
class TextPattern:
    """A text of the card with one number in it, such as `Hello robotics {n}`."""

    before: str
    after: str

    def number_in(self, text: str) -> int | None:
        """The number, where the text is like this one; else its last number; else None."""
        if self.fits(text):
            return int(text[len(self.before) : len(text) - len(self.after)])
        digits = [word for word in text.split() if word.isdecimal()]
        return int(digits[-1]) if digits else None

    def fits(self, text: str) -> bool:
        """The text is this one, with some number."""
        middle = text[len(self.before) : len(text) - len(self.after)]
        return (
            text.startswith(self.before)
            and text.endswith(self.after)
            and middle.isascii()
            and middle.isdecimal()
        )


def text_pattern(template: str) -> TextPattern:
    """Split a text of the card at its number."""
    parts = list(string.Formatter().parse(template))
    before = parts[0][0]
    return TextPattern(before, "".join(text for text, *_ in parts[1:]))


def views_of(evidence: Evidence) -> dict[str, View]:
    """What a check can ask for by name: `package`, and each experiment."""
    soaked = _soaked(evidence)
    experiments = {
        name: ExperimentView(
            seen,
            *_runs_before(name, evidence),
            soaked,
            others=tuple(run for run in evidence.runs if run is not seen),
        )
        for name, seen in evidence.experiments.items()
    }
    return {"package": PackageView(evidence.package, evidence.build, evidence.lab), **experiments}


def _soaked(evidence: Evidence) -> dict[str, ProcessSeen]:
    """Without what ended by itself in an experiment as well: checks that look there tell it."""
    told = {
        each.executable
        for run in evidence.runs
        for label, each in run.processes.items()
        if each.ended_by_itself and not is_outlived(label, run, evidence.experiments[run.name])
    }
    soaked = evidence.soak.processes if evidence.soak else {}
    return {name: seen for name, seen in soaked.items() if name not in told}


def _runs_before(
    name: str, evidence: Evidence
) -> tuple[tuple[ExperimentSeen, ...], tuple[ExperimentSeen, ...]]:
    """The earlier runs that are believed, and those that are not."""
    runs = [seen for seen in evidence.attempts if seen.name == name]
    believed = tuple(seen for seen in runs if not seen.doubt)
    return believed, tuple(seen for seen in runs if seen.doubt)
