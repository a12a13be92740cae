"""What was seen of a student's package: the only thing that a check may look at.

This module imports nothing of ours, so that every room can speak it. Times that end in `_ns`
are nanoseconds: `arrival_ns` on the monotonic clock, `source_ns` on the publisher's wall clock.
"""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter
from pydantic.dataclasses import dataclass

SCHEMA_VERSION = 1


class Record(BaseModel):
    """A model that is written once, and that refuses unknown fields when it is read back.

    Numbers that JSON cannot hold become the texts NaN, Infinity and -Infinity: float() reads them.
    """

    model_config = ConfigDict(extra="forbid", ser_json_inf_nan="strings")


SMALL = ConfigDict(extra="forbid", ser_json_inf_nan="strings")
"""Of the records that there are thousands of: with slots, they take a third of a model's memory."""


@dataclass(slots=True, kw_only=True, config=SMALL)
class Qos:
    """The quality of service of one endpoint, in rclpy's words, lower case."""

    reliability: str = "reliable"
    durability: str = "volatile"
    depth: int | None = Field(default=None, description="None where discovery does not tell it")
    deadline_ns: int | None = None
    liveliness: str = "automatic"


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
    endpoints: list[Endpoint]
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
    messages: list[MessageSeen] = Field(default_factory=list)
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
        if self.text.startswith("[") and "]: " in self.text:
            return self.text.partition("]: ")[2]
        return self.text


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


class ProcessSeen(Record):
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
    lines: list[LogLine] = Field(default_factory=list)
    output_bytes: int = 0
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
    bounds_met: list[Literal["pids", "memory", "files"]] = Field(
        default_factory=list,
        description="What it wanted more of than a sandbox has: processes, memory, files",
    )


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
    messages: list[MessageSeen] = Field(default_factory=list)
    imitated: bool = Field(
        default=False, description="Somebody else published on its topic: it tells nothing"
    )


class ServiceEnd(Record):
    """One side of a service: who answers it, or who may call it."""

    kind: Literal["server", "client"]
    node: str = Field(description="Full name of the node")
    service: str
    type: str = Field(description="e.g. `std_srvs/srv/SetBool`")


class CallSeen(Record):
    """One call of a service: what was asked, what came back, and when."""

    service: str
    type: str
    request: Any
    response: Any = Field(default=None, description="None where no answer came")
    sent_ns: int
    answered_ns: int | None = Field(default=None, description="None where no answer came")
    part: str = Field(default="", description="The part of the experiment that it belongs to")
    number: int = Field(default=0, description="Its place in that part, from 0")
    client: int = Field(default=0, description="Which of several clients at once called")
    watched_until_ns: int | None = Field(
        default=None, description="How long the topics were watched for its effect"
    )


class ActionEnd(Record):
    """One side of an action: who performs it, or who may give goals to it."""

    kind: Literal["server", "client"]
    node: str = Field(description="Full name of the node")
    action: str
    type: str = Field(description="e.g. `test_msgs/action/Fibonacci`")


class GoalSeen(Record):
    """One goal of an action: what was asked, what came of it, and when."""

    action: str
    type: str
    goal: Any
    part: str = Field(default="", description="The part of the experiment that it belongs to")
    id: list[int] = Field(description="The goal's number of 16 bytes; its feedback carries it")
    sent_ns: int
    answered_ns: int | None = Field(default=None, description="None where nobody answered")
    accepted: bool | None = None
    cancel_sent_ns: int | None = Field(default=None, description="None where it was not cancelled")
    cancel_answered_ns: int | None = None
    cancel_accepted: bool | None = None
    ended_ns: int | None = Field(default=None, description="None where no result came")
    status: str | None = Field(default=None, description="ROS's word, e.g. `succeeded`")
    result: Any = None
    watched_until_ns: int | None = Field(
        default=None, description="How long the robot was watched after it"
    )
    cpu_wait_s: float = Field(
        default=0.0,
        description="From the request to cancel on: how long threads of the node were ready to run"
        " and no processor was free, added up, since a cancel goes from one to the next",
    )

    @property
    def feedback_topic(self) -> str:
        """Where ROS hides the feedback of the action."""
        return f"{self.action}/_action/feedback"


class PoseSeen(Record):
    """Where a robot really was at a moment."""

    arrival_ns: int = Field(description="Observer's monotonic clock")
    x_m: float
    y_m: float
    heading_rad: float


class CommandSeen(Record):
    """One command that reached a robot."""

    arrival_ns: int
    forward_m_s: float
    turn_rad_s: float


class DriveSeen(Record):
    """A drive: how a robot moved, and what it was told."""

    path: list[PoseSeen] = Field(default_factory=list)
    commands: list[CommandSeen] = Field(default_factory=list)


class CableLine(Record):
    """One whole line on a serial cable, without the end of line, as it was sent."""

    board_s: float = Field(description="The board's clock")
    sent_ns: int = Field(description="Observer's monotonic clock")
    text: str


class MotorsSeen(Record):
    """What reached the motors, from one moment on."""

    board_s: float
    left_pwm: int
    right_pwm: int


class BoardMark(Record):
    """How things really stood at a moment of the experiment."""

    part: str
    arrival_ns: int = Field(description="Observer's monotonic clock")
    board_s: float
    x_m: float
    y_m: float
    heading_rad: float
    left_pwm: int
    right_pwm: int


class BoardSeen(Record):
    """All that was seen at the board's end of a serial cable."""

    told: list[CableLine] = Field(default_factory=list, description="By the board, unspoiled")
    heard: list[CableLine] = Field(default_factory=list, description="From the node")
    motors: list[MotorsSeen] = Field(default_factory=list)
    marks: list[BoardMark] = Field(default_factory=list)
    rejected: int = Field(default=0, description="Lines of the node that the board refused")
    lost_bytes: int = Field(default=0, description="Sent by the board, and read too late")
    host_bits_s: int | None = Field(
        default=None, description="To which the node has set its end at last; None where it has not"
    )


class ParameterDeclared(Record):
    """One parameter of a node, as the node itself says it."""

    node: str
    name: str
    type: Literal["bool", "integer", "double", "string", "other"]
    value: bool | int | float | str | None = Field(description="None where the type is another")


class ParameterSet(Record):
    """One try to set a node's parameter while it ran."""

    node: str
    name: str
    value: bool | int | float | str
    asked_ns: int = Field(description="Observer's monotonic clock")
    answered_ns: int | None = Field(default=None, description="None where no answer came")
    accepted: bool = False
    reason: str = Field(default="", description="Why it was refused, in the node's words")


class PixelsSeen(Record):
    """What the bytes of one picture held; the bytes themselves are not kept."""

    bytes: int
    level: float | None = Field(
        default=None, description="Mean of all values, 0 to 255; None where they cannot be read"
    )
    shows: int | None = Field(default=None, description="Which known picture is most like it")
    off: float | None = Field(default=None, description="Mean distance from that one, in levels")
    swapped_off: float | None = Field(
        default=None, description="The same, with red and blue exchanged"
    )
    round_off: float | None = Field(
        default=None,
        description="Its distance where values beyond 0 and 255 came out at the other end, or with"
        " the other sign; looked at where `off` is large",
    )
    lighter: float = Field(default=0.0, description="Levels added to the known picture before")
    marked: float | None = Field(
        default=None, description="Part of the pixels around the ball that were drawn over"
    )
    swapped_marked: float | None = Field(
        default=None, description="The same, where red and blue are exchanged back"
    )
    spoiled: float | None = Field(
        default=None, description="Part of all other pixels that were changed"
    )


class DiscShown(Record):
    """A ball in a picture, from the upper left corner."""

    x_px: float
    y_px: float
    radius_px: float
    hue: int


class PictureShown(Record):
    """One picture that the grader showed to a node, without its pixels."""

    part: str
    topic: str
    width: int
    height: int
    encoding: str
    step: int
    bytes: int
    stamp_ns: int
    frame_id: str
    ball: DiscShown | None = None
    decoy: DiscShown | None = Field(default=None, description="A ball of another colour")
    sent_ns: int = Field(default=0, description="Observer's monotonic clock, at the first try")
    until_ns: int = Field(default=0, description="How long its answer was waited for")
    tries: int = Field(default=0, description="How often it was sent: some are lost on the way")
    answered: bool = Field(default=False, description="The node published something after it")
    turned: bool = Field(default=False, description="The node's callbacks ran after it")


class StageMark(Record):
    """The moment at which a part of an experiment began."""

    part: str
    at_ns: int = Field(description="Observer's monotonic clock")


class PictureKept(Record):
    """A picture for the reader of the report; bounded, so that evidence stays small."""

    title: str
    caption: str = Field(description="What it shows, in words")
    png: str = Field(description="A PNG, in base64", pattern=r"^[A-Za-z0-9+/=]+$")
    width: int
    height: int


class WaySeen(Record):
    """Where something went, on the floor."""

    name: str
    points_m: list[tuple[float, float]] = Field(description="x and y, metres")


Kind = Literal["messages", "topics", "rosout", "graph", "requests"]
"""What evidence can be dropped: messages, topics never listened to, log lines, endpoints and
services of the graph, and what was asked of the grader's own servers."""


class Dropped(Record):
    """What found no room in the evidence of an experiment, of one kind."""

    kind: Kind
    count: int = 0
    bytes: int = Field(default=0, description="As they came; 0 where nobody knows")


class ExperimentSeen(Record):
    """One experiment: the processes it ran, and all that was seen while they ran."""

    name: str
    clock: Literal["wall", "sim"]
    graph: GraphSeen = Field(default_factory=lambda: GraphSeen(nodes=[], endpoints=[]))
    topics: dict[str, TopicSeen] = Field(default_factory=dict)
    rosout: dict[str, list[LogLine]] = Field(
        default_factory=dict, description="Logger's name to its lines"
    )
    processes: dict[str, ProcessSeen] = Field(default_factory=dict, description="By executable")
    sent_ns: dict[str, list[int]] = Field(
        default_factory=dict,
        description="Topic to the times of its messages on the network, where nothing of ours was"
        " in the domain; without the topic where the kernel shows no packets",
    )
    spoken: list[Spoken] = Field(default_factory=list)
    ticks: list[Tick] = Field(default_factory=list)
    segments: list[Segment] = Field(default_factory=list)
    canary: CanarySeen | None = None
    services: list[ServiceEnd] = Field(default_factory=list)
    calls: list[CallSeen] = Field(default_factory=list, description="Made by the grader")
    served: list[CallSeen] = Field(default_factory=list, description="Answered by the grader")
    actions: list[ActionEnd] = Field(default_factory=list)
    goals: list[GoalSeen] = Field(default_factory=list, description="Given by the grader")
    orders: list[GoalSeen] = Field(default_factory=list, description="Given to the grader")
    drive: DriveSeen | None = Field(default=None, description="The robot, where there was one")
    board: BoardSeen | None = Field(default=None, description="The board, where there was one")
    parameters: dict[str, list[str]] = Field(
        default_factory=dict, description="Node to the names of its parameters"
    )
    declared: list[ParameterDeclared] = Field(default_factory=list)
    parameter_sets: list[ParameterSet] = Field(default_factory=list)
    shown: list[PictureShown] = Field(default_factory=list, description="By the grader")
    stages: list[StageMark] = Field(default_factory=list)
    pictures: list[PictureKept] = Field(default_factory=list)
    ways: list[WaySeen] = Field(default_factory=list)
    stuck: list[str] = Field(
        default_factory=list, description="Nodes that ran, and whose callbacks ran no more"
    )
    dropped: list[Dropped] = Field(
        default_factory=list, description="What found no room; of a process: see there"
    )
    watching_s: float = 0.0
    rate_until_ns: int | None = Field(
        default=None,
        description="The end of the watch for a rate in real time: of what came later nobody"
        " noted what this computer took from it",
    )
    stall_s: float = Field(
        default=0.0, description="Longest time for which the observer itself was not run"
    )
    held_up: dict[str, HeldUp] = Field(
        default_factory=dict, description="Timed stretch to what this computer took from it"
    )
    devices_wait_s: float = Field(
        default=0.0,
        description="While a rate was watched beside stand-ins for devices: how long one of their"
        " threads was ready to run and the processor was not free",
    )
    machine_fault: str | None = Field(
        default=None, description="Why its times say nothing about the student"
    )
    not_believed: str | None = Field(
        default=None, description="Why the simulated clock says nothing about this node"
    )
    ignores_clock: bool = Field(
        default=False, description="... because the node takes its time from elsewhere"
    )

    @property
    def doubt(self) -> str | None:
        """Why its times say nothing about the student; None where they do."""
        return self.machine_fault or self.not_believed

    @property
    def cpu_wait_s(self) -> float:
        """The longest time for which one of its processes waited for a processor."""
        return max((p.cpu_wait_s or 0.0 for p in self.processes.values()), default=0.0)


class HeldUp(Record):
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


class BuildSeen(Record):
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


class Span(Record):
    """A stretch of time that a grading took for one part of its work; no check looks at it."""

    part: Part
    of: str = Field(default="", description="Which package, or which experiment")
    began_ns: int = Field(description="Monotonic clock")
    ended_ns: int


class Evidence(Record):
    """All that was seen of one package in one grading; judged again without running anything."""

    schema_version: Literal[1] = Field(default=1, alias="schema")
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
    timeline: list[Span] = Field(default_factory=list, description="Where the seconds went")

    model_config = ConfigDict(
        extra="forbid", validate_by_name=True, validate_by_alias=True, ser_json_inf_nan="strings"
    )


def evidence_json(evidence: Evidence, indent: int | None = None) -> bytes:
    """JSON in UTF-8, in one piece: large evidence has no room for a text of it beside its bytes."""
    return TypeAdapter(Evidence).dump_json(evidence, by_alias=True, indent=indent)


def read_json(content: bytes) -> Evidence:
    """Evidence of this schema or an earlier one. Raises pydantic's ValidationError."""
    return Evidence.model_validate_json(content)
