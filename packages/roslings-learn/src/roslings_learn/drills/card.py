"""A drill's card: what its one program must do, and what the student reads."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field, field_validator, model_validator

from ros2_on_pip.language import Text
from roslings.capabilities.actions.contract import ActionContract
from roslings.capabilities.services.contract import ServiceWords
from roslings.course.card import GroupName, NodeContract, TopicContract
from roslings.course.contract import Contract, Plain

PROGRAM = "your program"
"""What the student's one file is called where a lab's card has the name of an executable."""
KINDS = {
    "mend": Text("drill.kind.mend", "It does not work. Mend it."),
    "listen": Text("drill.kind.listen", "Nobody hears it. Find out why."),
    "predict": Text("drill.kind.predict", "Say what it will show. Then run it."),
    "write": Text("drill.kind.write", "Write it."),
}
"""Kind of drill to its word for the student."""
Shows = Literal["line", "lines", "node", "topic", "type", "rate_hz", "value", "messages", "state"]


class Tell(Contract):
    """One message that is said to the program, and what it must make of it."""

    topic: str
    message: dict[str, Plain] = Field(description="The fields; a dot leads into a field")
    type: str
    log: str | None = Field(default=None, description="A line that it writes then")
    publishes: TopicContract | None = Field(
        default=None, description="What comes then, by its `fields`"
    )

    @property
    def heard(self) -> TopicContract:
        """Where it is said."""
        return TopicContract(topic=self.topic, type=self.type)

    @model_validator(mode="after")
    def _shows(self) -> Tell:
        if self.log is None and not (self.publishes and self.publishes.fields):
            raise ValueError("nothing comes of it: give a log, or publishes with fields")
        return self


class Give(Contract):
    """A goal that is given to the program, and what must come of it."""

    action: str
    type: str
    goal: dict[str, float]
    when: str = "at the end"
    accepted: bool = True
    because: str = Field(default="it cannot be done", description="Why it must be refused")
    cancel: bool = Field(default=False, description="It is cancelled after its first feedback")
    status: Literal["succeeded", "canceled", "aborted"] = "succeeded"
    result: dict[str, Plain] = Field(default_factory=dict)
    feedback: int = Field(default=0, ge=0, description="At least so many come")


class Take(Contract):
    """The goal that the program must give, and what our server makes of it."""

    action: str
    type: str
    goal: dict[str, float]
    accepts: bool = True
    ends: Literal["succeed", "abort"] = "succeed"
    result: dict[str, Plain] = Field(default_factory=dict)

    @property
    def contract(self) -> ActionContract:
        """The action that it is a client of."""
        return ActionContract(action=self.action, type=self.type)


class Prediction(Contract):
    """What the student foretells in the file, as `ANSWER = ...`, and where the truth is seen."""

    shows: Shows
    number: int = Field(default=1, ge=1, description="Which one, counted from 1")
    holding: str = Field(default="", description="Only lines with this text in them are counted")
    within: float = Field(default=0.0, ge=0, lt=1, description="So far off still counts, as a part")
    question: str
    because: str = Field(description="Why it is so; told with the verdict")
    wrong: Plain = Field(description="What many say; the proof tries it")


class Beside(Contract):
    """A program of the course's own that runs beside the student's, from the drill's folder."""

    file: str = Field(pattern=r"^[a-z0-9_]+\.py$")
    nodes: tuple[str, ...] = Field(min_length=1)


class StarterFault(Contract):
    """What the program that the student gets must be found guilty of."""

    check: str
    fault: str
    names: str = Field(description="Stands in the first line of the verdict")


class DrillCard(Contract):
    """All of a drill but its programs."""

    title: str = Field(max_length=60)
    kind: Literal["mend", "listen", "predict", "write"]
    lesson: str = Field(pattern=r"^days/[0-9]{2}-[a-z0-9-]+#[a-z0-9-]+$")
    idea: str = Field(max_length=200, description="The one thing to take along, one sentence")
    program: Literal["python", "bash"] = "python"
    groups: tuple[GroupName, ...] = Field(
        default=(), description="Dependency groups that it needs besides the usual ones"
    )
    nodes: tuple[NodeContract, ...] = ()
    named: str | None = Field(default=None, description="The full name that it is started with")
    given: dict[str, Plain] = Field(default_factory=dict, description="Parameters at the start")
    remaps: tuple[str, ...] = Field(default=(), description="For example `chatter:=news`")
    says: int = Field(default=0, ge=0, le=3, description="Sentences said to each subscription")
    tells: tuple[Tell, ...] = ()
    gives: tuple[Give, ...] = ()
    takes: tuple[Take, ...] = ()
    prints: tuple[str, ...] = Field(default=(), description="Texts that stand in its output")
    never_prints: tuple[str, ...] = ()
    exits: int | None = Field(default=None, description="It ends by itself, with this exit code")
    ends_well: bool = Field(default=False, description="Ctrl-C ends it without an error")
    beside: Beside | None = None
    answer: Prediction | None = None
    starter: StarterFault
    hints: tuple[str, str, str] = Field(
        description="Where to look; which idea; the same idea in other code"
    )

    @field_validator("nodes", mode="before")
    @classmethod
    def _of_one_program(cls, nodes: Any) -> Any:
        """All nodes of a drill are in its one program."""
        if not isinstance(nodes, (list, tuple)):
            return nodes
        return [{"executable": PROGRAM, **n} if isinstance(n, dict) else n for n in nodes]

    @model_validator(mode="after")
    def _fits(self) -> DrillCard:
        if (self.answer is None) == (self.kind == "predict"):
            raise ValueError("a drill of the kind predict has an answer, and no other has")
        if not self.nodes and not self.prints and self.answer is None:
            raise ValueError("nothing is judged: give nodes, prints or an answer")
        if not self.nodes and (self.says or self.tells or self.gives or self.takes):
            raise ValueError("only a node is told, asked or given something: name it under nodes")
        if self.exits is not None and self.ends_well:
            raise ValueError("it ends by itself (exits), so nobody presses Ctrl-C (ends_well)")
        return self

    @property
    def follows_the_clock(self) -> bool:
        """All that is seen of it comes from timers, so that simulated time shows it sooner."""
        speaks = any(node.publishes for node in self.nodes)
        talks = self._calls or any(n.of(ServiceWords).serves or n.subscribes for n in self.nodes)
        told = self.says or self.tells or self.gives or self.takes
        asked = (told, self.beside, self.exits is not None, talks)
        return speaks and self.program == "python" and not any(asked)

    @property
    def waits_for_answers(self) -> bool:
        """It asks others for something, and cannot go on where no answer comes."""
        return bool(self.takes) or self._calls

    @property
    def _calls(self) -> bool:
        return any(node.of(ServiceWords).calls for node in self.nodes)
