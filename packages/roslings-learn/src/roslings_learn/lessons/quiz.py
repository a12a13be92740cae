"""A day's quiz. Each question has an id that never changes, and explains every choice.

An author writes the right choice first, as one thinks of it. What is read is mixed: the page, its
key, the notebook and the print all show the choices in the order that they have here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag, model_validator
from typing_extensions import Self

from roslings_learn.lessons.document import DocumentPart

ID = r"^[a-z][a-z0-9-]*$"


def mixed(question: str, count: int) -> list[int]:
    """The places 0 to `count` - 1 in an order that follows from the question's id alone.

    It is the same in each Python, on each machine and in each run.
    """
    return sorted(range(count), key=lambda place: sha256(f"{question}:{place}".encode()).digest())


class QuizQuestion(DocumentPart):
    """What every question has."""

    id: str = Field(pattern=ID, description="Stable: a student's progress is kept under it")
    ask: str = Field(min_length=1, description="The question; `code` and [words](#word-id) work")
    code: str = Field(default="", description="Shown below the question")
    language: str = "python"
    day: str = Field(default="", description="Filled in by the reader: the day that asked it first")

    def texts(self) -> tuple[str, ...]:
        """Every text of the question that may hold a link to a word."""
        return (self.ask,)

    def asked_on(self, day: str) -> Self:
        """The question as it is shown."""
        return self.model_copy(update={"day": day})


class QuizChoice(DocumentPart):
    """One answer that a student can choose."""

    text: str = Field(min_length=1)
    why: str = Field(min_length=1, description="Why it is right, or what is wrong in it")
    right: bool = False


class ChoiceQuestion(QuizQuestion):
    """A question with choices."""

    choices: tuple[QuizChoice, ...] = Field(min_length=2)

    @model_validator(mode="after")
    def _choices_differ(self) -> ChoiceQuestion:
        text, times = Counter(choice.text for choice in self.choices).most_common(1)[0]
        if times > 1:
            raise ValueError(f"The choice '{text}' of '{self.id}' is there twice. | Change one.")
        if not any(choice.right for choice in self.choices):
            mend = "Add 'right: true' to a choice."
            raise ValueError(f"The question '{self.id}' has no right answer. | {mend}")
        return self

    def texts(self) -> tuple[str, ...]:
        """Every text of the question."""
        return (self.ask, *(part for each in self.choices for part in (each.text, each.why)))

    def asked_on(self, day: str) -> Self:
        """The question as it is shown: with its choices mixed."""
        places = mixed(self.id, len(self.choices))
        return self.model_copy(update={"day": day, "choices": _at(places, self.choices)})


class One(ChoiceQuestion):
    """One choice is right: radio buttons."""

    kind: Literal["one"]

    @model_validator(mode="after")
    def _one_is_right(self) -> One:
        if sum(choice.right for choice in self.choices) > 1:
            mend = "Write 'kind: several', or take a 'right: true' away."
            raise ValueError(f"The question '{self.id}' has several right answers. | {mend}")
        return self


def _at(places: Sequence[int], choices: tuple[QuizChoice, ...]) -> tuple[QuizChoice, ...]:
    return tuple(choices[place] for place in places)


class Several(ChoiceQuestion):
    """One or more choices are right: check boxes."""

    kind: Literal["several"]


class OrderedStep(DocumentPart):
    """One step of a question about an order."""

    text: str = Field(min_length=1)
    why: str = Field(min_length=1, description="Why it stands at its place")


class OrderQuestion(QuizQuestion):
    """Steps to bring into order; the file has them in the right one."""

    kind: Literal["order"]
    steps: tuple[OrderedStep, ...] = Field(min_length=3)

    @model_validator(mode="after")
    def _steps_differ(self) -> OrderQuestion:
        text, times = Counter(step.text for step in self.steps).most_common(1)[0]
        if times > 1:
            raise ValueError(f"The step '{text}' of '{self.id}' is there twice. | Change one.")
        return self

    def texts(self) -> tuple[str, ...]:
        """Every text of the question."""
        return (self.ask, *(part for each in self.steps for part in (each.text, each.why)))

    @property
    def shown(self) -> list[int]:
        """The steps' places in the order in which they are shown: never the right one."""
        places = mixed(self.id, len(self.steps))
        return places[::-1] if places == sorted(places) else places


class CommonMistake(DocumentPart):
    """A wrong answer that many give, and what it shows."""

    text: str = Field(min_length=1)
    why: str = Field(min_length=1)


class Prints(QuizQuestion):
    """What does this code print? The student types it."""

    kind: Literal["prints"]
    code: str = Field(min_length=1)
    prints: str = Field(min_length=1)
    why: str = Field(min_length=1)
    mistakes: tuple[CommonMistake, ...] = ()

    @model_validator(mode="after")
    def _mistakes_are_wrong(self) -> Prints:
        if any(mistake.text == self.prints for mistake in self.mistakes):
            mend = "Take it out of 'mistakes', or correct 'prints'."
            raise ValueError(f"In '{self.id}' the right answer is also a mistake. | {mend}")
        return self

    def texts(self) -> tuple[str, ...]:
        """Every text of the question."""
        return (self.ask, self.why, *(mistake.why for mistake in self.mistakes))


class Again(DocumentPart):
    """A question of an earlier day, asked once more."""

    again: str


Question = One | Several | OrderQuestion | Prints


def _kind(entry: Any) -> str | None:
    if isinstance(entry, Again) or (isinstance(entry, dict) and "again" in entry):
        return "again"
    return entry.get("kind") if isinstance(entry, dict) else getattr(entry, "kind", None)


Entry = Annotated[
    Annotated[One, Tag("one")]
    | Annotated[Several, Tag("several")]
    | Annotated[OrderQuestion, Tag("order")]
    | Annotated[Prints, Tag("prints")]
    | Annotated[Again, Tag("again")],
    Discriminator(
        _kind,
        custom_error_type="question_kind",
        custom_error_message="A question needs a kind. | "
        "Write 'kind: one', 'several', 'order' or 'prints'; or '- again: ID'.",
    ),
]


class QuizFile(DocumentPart):
    """The file `days/NN-name/quiz.yaml`."""

    questions: tuple[Entry, ...] = Field(min_length=1)


@dataclass(frozen=True)
class Quiz:
    """What a day asks, questions of earlier days included."""

    day: str
    questions: tuple[Question, ...]
