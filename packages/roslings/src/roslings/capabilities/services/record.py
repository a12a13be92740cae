"""What was seen of services: who offers them, who calls them, and each call."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from roslings.record import Columns, PartSeen, Record


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


CLIENT_ENDS = "a client's end"
"""The timed stretch in which a client is to end by itself."""


class CallLimits(Record):
    """How long whoever measured waited."""

    answer_within_s: float = Field(default=5.0, description="No answer for so long is none")


class ServicesSeen(PartSeen):
    """All that was seen of services in an experiment."""

    NAME = "services"
    REQUESTS = ("served",)

    limits: CallLimits = Field(default_factory=CallLimits)
    ends: Columns[ServiceEnd] = Field(default_factory=list)
    calls: Columns[CallSeen] = Field(default_factory=list, description="Made by the grader")
    served: Columns[CallSeen] = Field(default_factory=list, description="Answered by the grader")
