"""What a grading says: the model behind `--json`, the terminal and every other report.

This module imports nothing of ours, so that every room can speak it.
"""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, JsonValue

SCHEMA_VERSION = 1

CheckOutcome = Literal["pass", "fail", "skip", "inconclusive"]
Outcome = Literal["pass", "fail", "inconclusive"]


class Frozen(BaseModel):
    """A model that nobody changes after it is made, and that refuses unknown fields."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class CheckResult(Frozen):
    """One line of the verdict: what was asked, what was seen, what to try."""

    id: str = Field(description="The check's stable name, e.g. `rate`")
    title: str = Field(description="What the check asks for, one sentence")
    outcome: CheckOutcome
    points: float = Field(ge=0, description="Points given")
    max_points: float = Field(ge=0, description="Points that the card gives this check")
    expected: str | None = Field(default=None, description="What the contract asks for")
    measured: str | None = Field(
        default=None, description="What was seen instead; of a check that passes: how long"
    )
    why: str | None = Field(default=None, description="Why it matters, or why it was not judged")
    hint: str | None = Field(default=None, description="Where to look next")
    mend: str | None = Field(
        default=None, description="What mends it; shown with the last of the hints"
    )
    fault: str | None = Field(default=None, description="The kind of fault, e.g. `WrongTopic`")
    fields: dict[str, JsonValue] = Field(
        default_factory=dict,
        description="What was found, by name; programs compare this, sentences are for people",
    )
    lesson: str | None = Field(default=None, description="Anchor of the lesson's paragraph")
    log: tuple[str, ...] = Field(default=(), description="The node's last lines, where they help")
    hidden: bool = Field(default=False, description="Students do not have this check")
    hints: tuple[str, ...] = Field(
        default=(), description="Three steps: where to look, which idea, the idea in other code"
    )

    # What a program asks of a fault stands here: it looks at fields, and never at sentences.

    @property
    def asked_rate(self) -> tuple[str | None, float] | None:
        """Topic and Hz of a rate that was asked for and not met; None where it is about no rate.

        The topic is the one that was measured; None where the fault does not name it.
        """
        rhythm = self.fields.get("rhythm")
        fields = rhythm if isinstance(rhythm, dict) else self.fields
        topic, hz = fields.get("topic"), fields.get("wanted_hz")
        if not isinstance(hz, int | float):
            return None
        return topic if isinstance(topic, str) else None, hz

    @property
    def exit_code(self) -> int | None:
        """The exit code of the process that it is about; None for a signal, and for no process."""
        went = self.fields.get("went")
        end = (went if isinstance(went, dict) else self.fields).get("end")
        status = end.get("status") if isinstance(end, dict) else None
        return status if isinstance(status, int) and status >= 0 else None


class Timings(Frozen):
    """Seconds of wall time, from command to verdict: the parts add up to `total`."""

    reading: float = Field(default=0.0, ge=0, description="Until colcon begins, start included")
    build: float = Field(default=0.0, ge=0)
    discovery: float = Field(default=0.0, ge=0, description="Nodes start and are found")
    watching: float = Field(default=0.0, ge=0)
    ending: float = Field(default=0.0, ge=0, description="From the first wait before Ctrl-C on")
    judging: float = Field(default=0.0, ge=0)
    rest: float = Field(default=0.0, ge=0, description="Of none of these parts")
    total: float = Field(default=0.0, ge=0)


class Environment(Frozen):
    """Where and with what the grading ran, so that an appeal can reproduce it."""

    roslings: str
    ros_distro: str
    rmw: str
    python: str
    platform: str
    isolation: str = Field(description="`namespace`, `domain` or `user`")
    wall: str | None = Field(
        default=None, description="What held the package's code: `namespaces`, `user` or `none`"
    )
    clock: str
    seed: int = Field(description="Seed of every random choice, e.g. the spoken sentence")


class Verdict(Frozen):
    """The whole answer to one package: outcome, score, and every check."""

    schema_version: Literal[1] = Field(default=1, alias="schema")
    lab: str
    package: str = Field(description="The package's name, as its package.xml has it")
    outcome: Outcome
    score: float | None = Field(description="0 to 100; null when inconclusive")
    checks: tuple[CheckResult, ...]
    advice: tuple[str, ...] = Field(default=(), description="Remarks that cost no points")
    soak_s: float = Field(
        default=0.0, ge=0, description="So long all nodes were left running in real time; 0: not"
    )
    seconds: Timings
    environment: Environment

    model_config = ConfigDict(
        frozen=True, extra="forbid", validate_by_name=True, validate_by_alias=True
    )

    def failed(self) -> tuple[CheckResult, ...]:
        """The checks that failed, in the grader's order."""
        return tuple(check for check in self.checks if check.outcome == "fail")


def outcome_of(checks: tuple[CheckResult, ...]) -> Outcome:
    """Sum up: one inconclusive check makes the verdict inconclusive, one failure makes it fail.

    A verdict that could not look everywhere gives no score, never a zero.
    """
    outcomes = {check.outcome for check in checks}
    if "inconclusive" in outcomes:
        return "inconclusive"
    return "fail" if outcomes & {"fail", "skip"} else "pass"


def score_of(checks: tuple[CheckResult, ...]) -> float | None:
    """Points given out of points possible, 0 to 100; None when a check is inconclusive."""
    if outcome_of(checks) == "inconclusive":
        return None
    possible = sum(check.max_points for check in checks)
    return round(100 * sum(check.points for check in checks) / possible, 1) if possible else 0.0
