"""What was seen of a student's package: the only thing that a check may look at.

What every experiment sees stands here. What only some see, of services or of a cable, is a part of
it, and its record lies in the room of the capability. This module names none of them, so that every
room can speak it. Times that end in `_ns` are nanoseconds: `arrival_ns` on the monotonic clock,
`source_ns` on the publisher's wall clock.
"""

from __future__ import annotations

import gc
import json
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Annotated, Any, Literal, TypeVar

from pydantic import BeforeValidator, ConfigDict, Field, SerializeAsAny, TypeAdapter
from pydantic.dataclasses import dataclass

from roslings.capability import capabilities, capability
from roslings.record import SMALL, Columns, PartSeen, Record, UnknownPart
from roslings.record.columns import IN_COLUMNS

SCHEMA_VERSION = 3
P = TypeVar("P", bound=PartSeen)


@dataclass(slots=True, kw_only=True, config=SMALL)
class Qos:
    """The quality of service of one endpoint, in rclpy's words, lower case."""

    reliability: str = "reliable"
    durability: str = "volatile"
    depth: int | None = Field(default=None, description="None where discovery does not tell it")
    deadline_ns: int | None = None
    liveliness: str = "automatic"
    lifespan_ns: int | None = None
    lease_ns: int | None = Field(default=None, description="Of its liveliness")


@dataclass(slots=True, kw_only=True, config=SMALL)
class Endpoint:
    """One publisher or subscription in the graph."""

    kind: Literal["publisher", "subscription"]
    node: str = Field(description="Full name of the node, e.g. `/talker`")
    topic: str
    type: str = Field(description="e.g. `std_msgs/msg/String`")
    qos: Qos
    gid: str


class GraphSeen(Record):
    """The ROS graph at one moment, without the grader's own node."""

    nodes: list[str] = Field(description="Full names; a name appears as often as it was seen")
    endpoints: Columns[Endpoint]
    services: dict[str, list[str]] = Field(default_factory=dict, description="Name to types")


@dataclass(slots=True, kw_only=True, config=SMALL)
class MessageSeen:
    """One message, with the three things that tell when it was sent and whether one was lost."""

    source_ns: int | None = Field(description="Publisher's wall clock, filled by the middleware")
    sequence: int | None = Field(description="Publisher's own count, filled by the middleware")
    arrival_ns: int = Field(description="Observer's monotonic clock")
    sim_ns: int | None = Field(
        default=None, description="Simulated time of the tick at which it was sent"
    )
    size: int = Field(description="Bytes, serialised")
    content: Any = Field(default=None, description="The fields; None where not kept or unreadable")


class TopicSeen(Record):
    """All that was heard on one topic."""

    name: str
    type: str
    messages: Columns[MessageSeen] = Field(default_factory=list)
    not_kept: int = Field(default=0, description="Messages counted but not kept (the bound)")
    not_read: int = Field(
        default=0, description="Messages kept without their content: it was too large"
    )
    cut_short: bool = Field(
        default=False, description="So large that its queue was made shorter: some were lost there"
    )
    watched_to_bound: bool = Field(
        default=False, description="Watching longer was not worth it: the longest watch was made"
    )


@dataclass(slots=True, kw_only=True, config=SMALL)
class LogLine:
    """One line that a node wrote, to its terminal or to /rosout."""

    arrival_ns: int
    text: str
    source: Literal["terminal", "rosout"]

    @property
    def plain(self) -> str:
        """A line of get_logger() without `[INFO] [1700000000.0] [talker]: ` before it."""
        if self.source == "terminal" and self.text.startswith("[") and "]: " in self.text:
            return self.text.partition("]: ")[2]
        return self.text

    @property
    def is_logged(self) -> bool:
        """Written by get_logger(), and not by print()."""
        return self.source == "rosout" or self.plain != self.text


class Ending(Record):
    """How a process ended after a signal."""

    signal: str
    after_s: float | None = Field(description="None where it did not end and was killed")
    watched_s: float = Field(description="So long was its end waited for")
    waited_s: float = Field(
        default=0.0,
        description="Of these: its main thread was ready to run, and no processor was free for it",
    )
    others_waited_s: float = Field(
        default=0.0,
        description="The same of its other threads, added up; of all where it did not end",
    )

    @property
    def own_s(self) -> float | None:
        """What it took by itself, whatever else the machine had to do."""
        return None if self.after_s is None else self.after_s - self.waited_s

    @property
    def least_own_s(self) -> float:
        """As `own_s`, if all its threads waited one after the other.

        Where it did not end: the time of its own that it had to end in, at least.
        """
        passed_s = self.watched_s if self.own_s is None else self.own_s
        return passed_s - self.others_waited_s


class NotOrdinary(Record):
    """What a process did that an instructor may want to know; a mistake can do all of it."""

    filled_its_disk: bool = Field(
        default=False, description="Nothing was free in its home, or where temporary files lie"
    )
    refused_calls: dict[str, int] = Field(
        default_factory=dict,
        description="Calls of the kernel that only attacks begin with, how often each was refused",
    )
    most_busy: int = Field(
        default=0,
        description="Threads that wanted a processor at once, where it was put behind all others"
        " because there were so many",
    )


class ProcessSeen(NotOrdinary):
    """One process of the student's, from start to end."""

    executable: str
    given: list[str] = Field(
        default_factory=list, description="The parameters that it was started with"
    )
    started_ns: int
    ended_ns: int | None = None
    status: int | None = Field(
        default=None, description="Exit code; minus the signal's number where a signal ended it"
    )
    ended_by_itself: bool = Field(default=False, description="Before the grader asked it to")
    asked_to_end_ns: int | None = Field(default=None, description="When Ctrl-C was pressed")
    ending: Ending | None = None
    lines: Columns[LogLine] = Field(default_factory=list)
    output_bytes: int = 0
    output_lines: int = 0
    output_dropped_bytes: int = 0
    ending_cut: bool = Field(
        default=False, description="Some of them it wrote after it was asked to end"
    )
    left_behind: int = Field(default=0, description="Processes of its own that outlived it")
    cpu_s: float = 0.0
    cpu_wait_s: float | None = Field(
        default=None,
        description="While it was watched: how long it was ready to run and the processor was not"
        " free; None where the kernel does not tell",
    )
    peak_memory_bytes: int = 0
    bounds_met: list[Literal["pids", "memory", "files", "output", "cpu_s"]] = Field(
        default_factory=list,
        description="What it wanted more of than a sandbox has: processes, memory, files, time of"
        " the processor; or that it printed without end, and was ended for it",
    )

    @property
    def prints_without_end(self) -> bool:
        """It was ended because of what it wrote."""
        return "output" in self.bounds_met

    @property
    def ended_after_ctrl_c(self) -> bool:
        """It was asked to end, and ended before it had to be killed."""
        return self.ending is not None and self.ending.after_s is not None


class Spoken(Record):
    """One message that the grader sent, and whether somebody was there to hear it."""

    topic: str
    type: str
    content: Any
    sent_ns: int
    matched: bool = Field(description="A subscription was matched when it was sent")
    offered: Qos
    settled: bool = Field(
        default=True, description="False where its effect was waited for and did not come in time"
    )


class Tick(Record):
    """One step of the simulated clock: what it showed, and when that was published."""

    sim_ns: int
    wall_ns: int = Field(description="The grader's wall clock, which the source stamps share")
    at_ns: int = Field(description="The grader's monotonic clock")
    kept_up: bool = Field(description="Every node showed that it had handled the tick")


class Segment(Record):
    """A stretch of simulated time with one step and one speed."""

    first: int = Field(description="Index of its first tick")
    last: int = Field(description="Index of its last tick")
    step_ns: int
    speed: float = Field(description="Simulated seconds in a second of real time")


class CanarySeen(Record):
    """A known-good talker that ran beside the student's nodes, and what it managed."""

    wanted_hz: float
    messages: Columns[MessageSeen] = Field(default_factory=list)
    imitated: bool = Field(
        default=False, description="Somebody else published on its topic: it tells nothing"
    )


class StageMark(Record):
    """The moment at which a part of an experiment began."""

    part: str
    at_ns: int = Field(description="Observer's monotonic clock")


Kind = Literal["messages", "topics", "rosout", "graph", "requests"]
"""What evidence can be dropped. It is messages, topics never listened to, log lines, endpoints and
services of the graph, and what was asked of the grader's own servers."""


class DroppedSeen(Record):
    """What found no room in the evidence of an experiment, of one kind."""

    kind: Kind
    count: int = 0
    bytes: int = Field(default=0, description="As they came; 0 where nobody knows")


class UnreadablePart(Exception):
    """A part of the evidence was written by a newer capability than the one that is here."""

    def __init__(self, name: str, version: int) -> None:
        self.name, self.version = name, version
        super().__init__(
            f"the evidence of {name} has version {version}, which this roslings cannot read;"
            " bring roslings up to date"
        )


def _read_parts(parts: Any) -> Any:
    """Each part as its capability has it; one that nobody here can read is kept whole."""
    if not isinstance(parts, Mapping):
        raise ValueError("the parts are no mapping of names")
    divided = {each: it for name, content in parts.items() for each, it in _own(name, content)}
    return {name: _read_part(name, content) for name, content in divided.items()}


def _own(name: str, content: Any) -> Iterator[tuple[str, Any]]:
    """A part, and before it what others have a record of their own for since its version."""
    known = capability(name)
    version = content.get("v") if isinstance(content, Mapping) else None
    if known is not None and isinstance(version, int) and version < known.version:
        for each in capabilities():
            fields = each.formerly.get((name, version), ())
            if found := {one: content[one] for one in fields if content.get(one)}:
                yield each.name, {"v": 1, **found}
    yield name, content


def _read_part(name: str, content: Any) -> PartSeen:
    if isinstance(content, PartSeen):
        return content
    if not isinstance(content, Mapping) or not isinstance(version := content.get("v"), int):
        raise ValueError(f"the part {name} has no version")
    known = capability(name)
    if known is None or known.seen is None or version > known.version:
        return UnknownPart.model_validate(content)
    fields = dict(content)
    for step in range(version, known.version):
        fields = known.upgrade[step](fields)
    return known.seen.model_validate({**fields, "v": known.version})  # type: ignore[no-any-return]


Parts = Annotated[dict[str, SerializeAsAny[PartSeen]], BeforeValidator(_read_parts)]


class ExperimentSeen(Record):
    """One experiment: the processes it ran, and all that was seen while they ran."""

    name: str
    clock: Literal["wall", "sim"]
    graph: GraphSeen = Field(default_factory=lambda: GraphSeen(nodes=[], endpoints=[]))
    topics: dict[str, TopicSeen] = Field(default_factory=dict)
    rosout: dict[str, Columns[LogLine]] = Field(
        default_factory=dict, description="Logger's name to its lines"
    )
    processes: dict[str, ProcessSeen] = Field(default_factory=dict, description="By executable")
    sent_ns: dict[str, Columns[int]] = Field(
        default_factory=dict,
        description="Topic to the times of its messages on the network, where nothing of ours was"
        " in the domain; without the topic where the kernel shows no packets",
    )
    spoken: Columns[Spoken] = Field(default_factory=list)
    ticks: Columns[Tick] = Field(default_factory=list)
    segments: Columns[Segment] = Field(default_factory=list)
    canary: CanarySeen | None = None
    parts: Parts = Field(
        default_factory=dict, description="Name of a capability to what was seen of it"
    )
    stages: Columns[StageMark] = Field(default_factory=list)
    stuck: list[str] = Field(
        default_factory=list, description="Nodes that ran, and whose callbacks ran no more"
    )
    dropped: Columns[DroppedSeen] = Field(
        default_factory=list, description="What found no room; of a process: see there"
    )
    watching_s: float = 0.0
    rate_until_ns: int | None = Field(
        default=None,
        description="The end of the watch for a rate in real time: of what came later nobody"
        " noted what this computer took from it",
    )
    patience_s: float = Field(
        default=20.0,
        description="So long a process that waited for a processor was waited for, at most",
    )
    stall_s: float = Field(
        default=0.0, description="Longest time for which the observer itself was not run"
    )
    held_up: dict[str, HeldUpSeen] = Field(
        default_factory=dict, description="Timed stretch to what this computer took from it"
    )
    devices_wait_s: float = Field(
        default=0.0,
        description="While a rate was watched beside stand-ins for devices: how long one of their"
        " threads was ready to run and the processor was not free, or the device kept its user"
        " waiting",
    )
    machine_fault: str | None = Field(
        default=None, description="Why its times say nothing about the student"
    )
    not_believed: str | None = Field(
        default=None, description="Why the simulated clock says nothing about this node"
    )
    ignores_clock: bool = Field(
        default=False,
        description="Measured here and in the run that counts: its messages come by real time",
    )

    def part(self, kind: type[P]) -> P:
        """What was seen of a capability; empty where nothing was. Raises UnreadablePart."""
        return _readable(self.parts.get(kind.NAME, kind()), kind)

    def recording(self, kind: type[P]) -> P:
        """The same, to write into it: it is kept from now on."""
        return _readable(self.parts.setdefault(kind.NAME, kind()), kind)

    @property
    def doubt(self) -> str | None:
        """Why its times say nothing about the student; None where they do."""
        return self.machine_fault or self.not_believed

    @property
    def prints_without_end(self) -> bool:
        """One of its processes was ended because of what it wrote; no other run tells more."""
        return any(process.prints_without_end for process in self.processes.values())

    @property
    def cpu_wait_s(self) -> float:
        """The longest time for which one of its processes waited for a processor."""
        return max((p.cpu_wait_s or 0.0 for p in self.processes.values()), default=0.0)


def _readable(part: PartSeen, kind: type[P]) -> P:
    if not isinstance(part, kind):
        raise UnreadablePart(kind.NAME, part.v)
    return part


class HeldUpSeen(Record):
    """What this computer took from a timed stretch of an experiment."""

    cpu_wait_s: float = Field(
        description="The longest time that a thread of the nodes was ready and no processor free"
    )
    stall_s: float = Field(description="Longest time for which the observer itself was not run")

    @property
    def longest_s(self) -> float:
        """By so much, at most, it made something late."""
        return self.cpu_wait_s + self.stall_s


class SoakSeen(Record):
    """The nodes among themselves, in real time, with nobody who watches what they say."""

    for_s: float = Field(description="So long they were meant to run")
    processes: dict[str, ProcessSeen] = Field(
        default_factory=dict, description="By executable; of what they wrote, the last lines"
    )


class BuildSeen(NotOrdinary):
    """What colcon did with the package."""

    succeeded: bool
    recognised_as: str | None = Field(description="colcon's word, e.g. `ros.ament_python`")
    seconds: float
    output: list[str] = Field(default_factory=list, description="Last lines")
    executables: list[str] = Field(default_factory=list)


class PictureSeen(Record):
    """An image file in the package."""

    path: str
    format: str | None = Field(description="e.g. `PNG`; None where it is no image")
    width: int = 0
    height: int = 0
    colours: int = Field(default=0, description="Different colours, counted up to 2")


class PackageSeen(Record):
    """What stands in the package's own files, read without running any of them."""

    name: str
    folder: str = Field(description="Name of the folder, without the path to it")
    build_type: str
    xml_problems: list[str] = Field(default_factory=list)
    missing_files: list[str] = Field(default_factory=list)
    syntax_errors: list[str] = Field(default_factory=list, description="`file:line: message`")
    declared: list[str] = Field(default_factory=list, description="Packages in package.xml")
    imported: dict[str, str] = Field(
        default_factory=dict, description="ROS package imported by the code, to `file:line`"
    )
    entry_points: dict[str, str] = Field(
        default_factory=dict, description="Name to target, as setup.py has it"
    )
    pictures: dict[str, PictureSeen] = Field(default_factory=dict, description="By path")
    documents: dict[str, str] = Field(
        default_factory=dict, description="Texts that the card asks for, by path"
    )
    content: str = Field(
        default="",
        description="Digest of its files; of Python without comments and docstrings",
    )
    handed_in_as: str = Field(
        default="", description="What the submission is called; empty where nobody handed it in"
    )


HeldBy = Literal["namespaces", "user", "none"]
"""The wall between a package's code and the machine that ran it."""


class MachineSeen(Record):
    """The machine and the versions that did the measuring."""

    roslings: str
    ros_distro: str
    rmw: str
    python: str
    platform: str
    isolation: Literal["namespace", "domain", "user"]
    wall: HeldBy | None = Field(
        default=None, description="What held the package's code; None where nobody wrote it down"
    )


Part = Literal["reading", "building", "starting", "watching", "ending", "judging"]
"""What a grading does with its time."""


class GradingSpan(Record):
    """A stretch of time that a grading took for one part of its work; no check looks at it."""

    part: Part
    of: str = Field(default="", description="Which package, or which experiment")
    began_ns: int = Field(description="Monotonic clock")
    ended_ns: int


class Evidence(Record):
    """All that was seen of one package in one grading; judged again without running anything."""

    schema_version: Literal[3] = Field(default=3, alias="schema")
    lab: str
    seed: int
    machine: MachineSeen
    package: PackageSeen
    build: BuildSeen | None = None
    experiments: dict[str, ExperimentSeen] = Field(default_factory=dict)
    attempts: list[ExperimentSeen] = Field(
        default_factory=list, description="Experiments that were made again: the earlier runs"
    )
    soak: SoakSeen | None = Field(default=None, description="None where none was made")
    advice: list[str] = Field(default_factory=list)
    timeline: Columns[GradingSpan] = Field(
        default_factory=list, description="Where the seconds went"
    )

    model_config = ConfigDict(
        extra="forbid", validate_by_name=True, validate_by_alias=True, ser_json_inf_nan="strings"
    )

    @property
    def runs(self) -> list[ExperimentSeen]:
        """Every run of every experiment: those that count, then the earlier ones."""
        return [*self.experiments.values(), *self.attempts]


@contextmanager
def nothing_collected() -> Iterator[None]:
    """Evidence is many objects and no garbage: while it is read, looking for some takes a third."""
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


def evidence_json(evidence: Evidence) -> bytes:
    """JSON in UTF-8, in one piece: large evidence has no room for a text of it beside its bytes."""
    with nothing_collected():
        return _ADAPTER.dump_json(evidence, by_alias=True)


def thin_json(evidence: Evidence, indent: int | None = None) -> bytes:
    """The same evidence in columns, to be kept: `record/columns.py` says how they are read."""
    with nothing_collected():
        return _ADAPTER.dump_json(evidence, by_alias=True, indent=indent, context=IN_COLUMNS)


_ADAPTER = TypeAdapter(Evidence)


def read_json(content: bytes) -> Evidence:
    """Evidence of this schema, or of an earlier one, step by step. Raises ValidationError."""
    with nothing_collected():
        return _read(content)


def _read(content: bytes) -> Evidence:
    found = _FIRST_FIELD.match(content)
    if found and int(found[1]) == SCHEMA_VERSION:
        return Evidence.model_validate_json(content)
    evidence = json.loads(content)
    while (version := evidence.get("schema")) in _UPGRADES:
        evidence = {**_UPGRADES[version](evidence), "schema": version + 1}
    return Evidence.model_validate(evidence)


_FIRST_FIELD = re.compile(rb'\s*\{\s*"schema"\s*:\s*([0-9]+)\b')
"""Whether evidence is of this schema is known by its first bytes: it may be large."""


def _with_parts(evidence: dict[str, Any]) -> dict[str, Any]:
    """From schema 1 to 2: what single capabilities saw goes from an experiment into its parts."""
    experiments = evidence.get("experiments", {})
    return {
        **evidence,
        "experiments": {name: _divided(seen) for name, seen in experiments.items()},
        "attempts": [_divided(seen) for seen in evidence.get("attempts", [])],
    }


def _divided(seen: dict[str, Any]) -> dict[str, Any]:
    rest, parts = dict(seen), {}
    for each in capabilities():
        found = {new: rest.pop(old) for old, new in each.in_schema_1.items() if old in rest}
        if any(found.values()):
            parts[each.name] = {"v": 1, **found}
    return {**rest, "parts": parts}


def _in_lists(evidence: dict[str, Any]) -> dict[str, Any]:
    """From schema 2 to 3: lists may be tables now, and need not be."""
    return evidence


_UPGRADES: dict[int, Callable[[dict[str, Any]], dict[str, Any]]] = {1: _with_parts, 2: _in_lists}
"""Schema to the step to the next one."""
