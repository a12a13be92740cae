"""When something holds or happens: a part of many sentences, at their beginning or their end."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.sentences import SentencePart, Text, one_of


@dataclass(frozen=True)
class When(SentencePart):
    """The case that a sentence speaks of. What a lab's author has for it stays as it is written."""

    case: Literal[
        "answered", "done", "no_server", "server_is_missing", "answer_is", "feedback_is", "card"
    ]
    what: str = ""
    """The answer, the feedback, or the case in the card's words."""
    text = one_of(
        answered="after the answer",
        done="when its task is done",
        no_server="without a server",
        server_is_missing="when there is no server",
        answer_is="when the answer is {what!r}",
        feedback_is="when the feedback says {what}",
        card="when {what}",
    )

    @property
    def which_text(self) -> str:
        """Which case it is."""
        return self.case


@dataclass(frozen=True)
class AfterTold(SentencePart):
    """After something was said on a topic."""

    told: str
    """Fields and their values."""
    topic: str
    text = "after {told} on {topic}"


@dataclass(frozen=True)
class Then(SentencePart):
    """One thing after another."""

    before: Text
    after: str
    text = "{before}, then {after}"


@dataclass(frozen=True)
class Nothing(SentencePart):
    """Where a thing is asked for, and none is there."""

    what: Literal["thing", "text"] = "thing"
    text = one_of(thing="nothing", text="(empty)")

    @property
    def which_text(self) -> str:
        """Of what there is none."""
        return self.what


def one_after_the_other(things: Iterable[str]) -> Text:
    """As many as there are; for none, that there is nothing."""
    first, *rest = (*things,) or (Nothing(),)
    found: Text = first
    for thing in rest:
        found = Then(found, str(thing))
    return found


Thing = Literal[
    "answer",
    "answers",
    "client_end",
    "goal_answer",
    "goal_end",
    "cancel_answer",
    "node_answer",
    "topic",
    "camera_line",
    "picture",
    "picture_answer",
    "first_message",
    "message",
    "command",
    "operator",
    "stop",
    "event",
    "launch_topic",
    "its_line",
]
"""What somebody may wait for."""


@dataclass(frozen=True)
class Awaited(SentencePart):
    """What somebody waited for."""

    what: Thing
    name: str = ""
    """Of `topic` alone."""
    text = one_of(
        answer="an answer",
        answers="answers",
        client_end="the client's end",
        goal_answer="the answer to a goal",
        goal_end="the end of a goal",
        cancel_answer="the answer to a cancel",
        node_answer="an answer of the node",
        topic="what {name} says",
        camera_line="a line about the camera",
        picture="a picture",
        picture_answer="the answer to a picture",
        first_message="the first message",
        message="a message",
        command="a command",
        operator="the operator's command",
        stop="the stop",
        event="an event",
        launch_topic="a topic of the launch",
        its_line="its line",
    )

    @property
    def which_text(self) -> str:
        """Which of them it is."""
        return self.what
