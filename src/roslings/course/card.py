"""A lab's card: the contract between student and grader, said once.

An instructor changes a rate, a text or the points here for a new term; the grader, `task.md`
and the lesson read it from here.
"""

from __future__ import annotations

import string
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, RootModel, field_validator, model_validator

from roslings.course.kinds import Kind
from roslings.course.outline import DAY, PACKAGE

DEFAULT_WITHIN = 0.1
"""The part of a rate that it may be off, where the card says nothing."""


Plain = bool | int | float | str
Expected = Kind.EXPECTED
Stimulus = Kind.STIMULUS
Promise = Kind.PROMISE
Prose = Kind.PROSE
GroupName = Annotated[str, Field(pattern=r"^[a-z][a-z0-9-]*$")]


class Contract(BaseModel):
    """A part of the card; an unknown word in it is a mistake, not a comment."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class RateContract(Contract):
    """How often messages come, and how far from it still counts."""

    hz: Annotated[float, Expected] = Field(gt=0)
    within: Annotated[float, Kind.TOLERANCE] = Field(
        gt=0, lt=1, description="Part of the rate, e.g. 0.05 for 5 %"
    )

    @property
    def low_hz(self) -> float:
        """The slowest rate that counts."""
        return self.hz * (1 - self.within)

    @property
    def high_hz(self) -> float:
        """The fastest rate that counts."""
        return self.hz * (1 + self.within)


class QosContract(Contract):
    """The quality of service that the other side of the topic uses: ours must match it."""

    reliability: Annotated[Literal["reliable", "best_effort"], Expected] = "reliable"
    durability: Annotated[Literal["volatile", "transient_local"], Expected] = "volatile"
    exact: Annotated[bool, Expected] = Field(
        default=False, description="Ours must be just this, not only match it"
    )


class TopicContract(Contract):
    """One topic that a node publishes or subscribes to."""

    topic: Annotated[str, Expected] = Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_/]*$")
    type: Annotated[str, Expected] = Field(pattern=r"^[a-z][a-z0-9_]*/msg/[A-Z][A-Za-z0-9]*$")
    qos: QosContract = QosContract()
    rate: RateContract | None = None
    text: Annotated[str | None, Expected] = Field(
        default=None, description="The message's text; `{n}` is a counter"
    )
    about: Annotated[str, Promise] = Field(
        default="", description="What the message says, in words"
    )
    fields: Annotated[dict[str, Plain], Expected] = Field(
        default_factory=dict, description="What each message holds; a dot leads into a field"
    )

    def at(self, hz: float) -> TopicContract:
        """The same topic at another rate, as tolerant as before."""
        within = self.rate.within if self.rate else DEFAULT_WITHIN
        return self.model_copy(update={"rate": RateContract(hz=hz, within=within)})


class ParameterContract(Contract):
    """A setting of a node that is chosen when it starts; a live one also while it runs."""

    name: Annotated[str, Kind.KEY] = Field(pattern=r"^[a-z][a-z0-9_]*$")
    type: Annotated[Literal["bool", "integer", "double", "string"], Expected]
    about: Annotated[str, Promise] = Field(
        description="What it sets, with its unit, e.g. `seconds between messages`"
    )
    default: Annotated[Plain, Expected]
    tried: Annotated[Plain, Stimulus] = Field(description="The other value that the check gives it")
    least: Annotated[float | None, Kind.EDGE] = Field(
        default=None, description="What is below is refused"
    )
    most: Annotated[float | None, Kind.EDGE] = Field(
        default=None, description="What is above is refused"
    )
    live: Annotated[bool, Expected] = Field(
        default=False, description="A change acts at once, while the node runs"
    )

    @property
    def ends(self) -> tuple[int, int]:
        """The smallest and the largest whole number that it takes. Raises ValueError."""
        if self.least is None or self.most is None:
            raise ValueError(f"the parameter {self.name} has no limits: give it least and most")
        return int(self.least), int(self.most)

    @property
    def beyond(self) -> tuple[int, int]:
        """The nearest whole numbers that it refuses, below and above. Raises ValueError."""
        least, most = self.ends
        return least - 1, most + 1


class ConstantContract(Contract):
    """A number that the node reckons with."""

    name: Annotated[str, Prose]
    value: Annotated[float, Expected]
    about: Annotated[str, Promise] = Field(description="Its unit, and what it is for")


class AnswerContract(Contract):
    """What a server answers to one request, and what is to be seen of it afterwards."""

    when: Annotated[str, Prose] = Field(
        description="In what state it is asked, e.g. `the limit is on`"
    )
    request: Annotated[dict[str, Plain], Stimulus] = Field(default_factory=dict)
    response: Annotated[dict[str, Plain], Expected]
    state: Annotated[Plain | None, Expected] = Field(
        default=None, description="What the node's first topic carries afterwards, in `data`"
    )


class ServiceContract(Contract):
    """One service that a node offers, or that it calls."""

    service: Annotated[str, Expected] = Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_/]*$")
    type: Annotated[str, Expected] = Field(pattern=r"^[a-z][a-z0-9_]*/srv/[A-Z][A-Za-z0-9]*$")
    within_s: Annotated[float | None, Kind.MOST] = Field(
        default=None, gt=0, description="The answer comes in this time"
    )
    answers: tuple[AnswerContract, ...] = ()

    @property
    def whatever_it_answers(self) -> ServiceContract:
        """The same, with one answer that is not compared: for who asks only how soon it comes."""
        any_answer = self.answers[0].model_copy(update={"response": {}})
        return self.model_copy(update={"answers": (any_answer,)})


class ActionContract(Contract):
    """One action that a node performs, or that it gives goals to."""

    action: Annotated[str, Expected] = Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_/]*$")
    type: Annotated[str, Expected] = Field(pattern=r"^[a-z][a-z0-9_]*/action/[A-Z][A-Za-z0-9]*$")
    goal: Annotated[dict[str, float], Prose] = Field(
        default_factory=dict, description="One goal, as an example"
    )
    feedback: RateContract | None = None
    cancels_within_s: Annotated[float | None, Kind.MOST] = Field(
        default=None, gt=0, description="From the request to cancel until all stands still"
    )
    rules: Annotated[dict[str, str], Promise] = Field(
        default_factory=dict, description="What happens when: two columns of the task's table"
    )


class OutcomeContract(Contract):
    """One way in which a program that has a single task can come to its end."""

    when: Annotated[str, Promise]
    log: Annotated[str, Expected] = Field(
        description="A line it writes; `{text}` is something of the answer"
    )
    log_about: Annotated[str, Promise] = Field(default="", description="What `{text}` stands for")
    exit_code: Annotated[int, Expected]


class GiveUpContract(Contract):
    """What a client does that finds no server."""

    within_s: Annotated[float, Kind.MOST] = Field(gt=0, description="From its start to its end")
    log: Annotated[str, Expected]
    exit_code: Annotated[int, Expected]


class NodeContract(Contract):
    """One node: its full name, the executable that starts it, and its topics."""

    node: Annotated[str, Expected] = Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_/]*$")
    executable: Annotated[str, Kind.KEY]
    publishes: tuple[TopicContract, ...] = ()
    subscribes: tuple[TopicContract, ...] = ()
    parameters: tuple[ParameterContract, ...] = ()
    constants: tuple[ConstantContract, ...] = ()
    serves: tuple[ServiceContract, ...] = ()
    calls: tuple[ServiceContract, ...] = ()
    performs: tuple[ActionContract, ...] = ()
    orders: tuple[ActionContract, ...] = ()
    outcomes: dict[str, OutcomeContract] = Field(
        default_factory=dict, description="By a word for the grader, e.g. `refused`"
    )
    gives_up: GiveUpContract | None = None
    other_names: Annotated[tuple[str, ...], Stimulus] = Field(
        default=(), description="Full names that it takes when it is started with remaps"
    )
    log: Annotated[str | None, Expected] = Field(
        default=None, description="A line it writes; `{text}` is the message"
    )
    log_about: Annotated[str, Promise] = Field(
        default="the message's text", description="What `{text}` stands for"
    )
    log_examples: Annotated[tuple[str, ...], Prose] = Field(
        default=(), description="For `{text}` in the task, where no topic has a text"
    )

    @property
    def stays(self) -> bool:
        """It runs until somebody ends it; the others have one task, and end after it."""
        return not self.outcomes and self.gives_up is None

    def constant(self, name: str) -> float:
        """A number of the card. Raises KeyError where there is none of this name."""
        return {each.name: each.value for each in self.constants}[name]

    def parameter(self, name: str) -> ParameterContract:
        """A parameter of the card. Raises KeyError where there is none of this name."""
        return {each.name: each for each in self.parameters}[name]


class LaunchContract(Contract):
    """A launch file of the package, and the executables that it starts."""

    file: Annotated[str, Expected] = Field(pattern=r"^launch/[a-z0-9_]+\.launch\.(xml|yaml|py)$")
    starts: Annotated[tuple[str, ...], Expected]

    @property
    def name(self) -> str:
        """What stands behind `ros2 launch PACKAGE`."""
        return self.file.rpartition("/")[2]


class PictureContract(Contract):
    """An image that the package holds."""

    path: Annotated[str, Expected]
    format: Annotated[Literal["PNG"], Expected] = "PNG"
    min_width_px: Annotated[int, Kind.LEAST] = Field(gt=0)
    min_height_px: Annotated[int, Kind.LEAST] = Field(gt=0)


class Hint(Contract):
    """What a check offers to who is stuck, in three steps, and where the lesson explains it."""

    lesson: str = Field(pattern=r"^days/[0-9]{2}-[a-z0-9-]+#[a-z0-9-]+$")
    steps: tuple[str, str, str] = Field(
        description="Where to look; which idea; the same idea in other code"
    )


class Hints(RootModel[dict[str, Hint]]):
    """The file `hints.yaml`: check's name to its hint."""


class Card(Contract):
    """All that a lab asks for. Points of all checks add up to 100."""

    id: Annotated[str, Prose] = Field(pattern=r"^[a-z][a-z0-9-]*$")
    title: Annotated[str, Prose]
    day: Annotated[str, Prose] = Field(pattern=DAY)
    needs: Annotated[tuple[str, ...], Prose] = Field(
        default=(), description="Labs to do before this one"
    )
    package: Annotated[str, Expected] = Field(pattern=PACKAGE)
    build_type: Annotated[Literal["ament_python"], Expected] = "ament_python"
    groups: Annotated[tuple[GroupName, ...], Prose] = Field(
        default=(), description="Dependency groups that its check needs besides the usual ones"
    )
    nodes: tuple[NodeContract, ...]
    launch: LaunchContract | None = None
    builds_within_s: Annotated[float, Kind.MOST] = Field(
        default=180.0, gt=0, description="The most that colcon may take"
    )
    ends_within_s: Annotated[float, Kind.MOST] = Field(
        default=2.0, gt=0, description="After Ctrl-C"
    )
    soak_s: Annotated[float, Stimulus] = Field(
        default=30.0, ge=0, le=600, description="So long the nodes run where results count; 0: not"
    )
    pictures: tuple[PictureContract, ...] = ()
    board: Annotated[bool, Prose] = Field(
        default=False, description="A node talks to a board on a serial port"
    )
    points: Annotated[dict[str, float], Prose] = Field(description="Check's name to its points")
    not_judged: Annotated[tuple[str, ...], Prose] = Field(
        default=(), description="What the student is free in"
    )

    @field_validator("points")
    @classmethod
    def _add_up(cls, points: dict[str, float]) -> dict[str, float]:
        if sum(points.values()) != 100:
            raise ValueError(f"the points add up to {sum(points.values()):g}, not to 100")
        return points

    @model_validator(mode="after")
    def _texts_have_known_fields(self) -> Card:
        for node in self.nodes:
            for log in (node.log, *(outcome.log for outcome in node.outcomes.values())):
                _allow_fields(log, {"text"})
            for topic in (*node.publishes, *node.subscribes):
                _allow_fields(topic.text, {"n"})
        return self

    def node(self, executable: str) -> NodeContract:
        """The node that `executable` starts. Raises KeyError where the card has none."""
        for node in self.nodes:
            if node.executable == executable:
                return node
        raise KeyError(f"the card of {self.id!r} has no executable {executable!r}")


def _allow_fields(template: str | None, allowed: set[str]) -> None:
    fields = {field for _, field, _, _ in string.Formatter().parse(template or "") if field}
    if fields - allowed:
        raise ValueError(f"{template!r} has unknown fields {sorted(fields - allowed)}")
