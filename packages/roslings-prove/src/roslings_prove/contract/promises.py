"""Which sentences of a task are judged: each has its checks, and a mutant that breaks it.

A sentence is accounted for where each of its words stands in an entry of `promises.yaml`. A mutant
for each, and not only one for its check: a check may look at three things, and a mutant shows one.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from roslings.course import Lab, Mutant
from roslings.course.files import line_in
from roslings.course.promises import NAME, Promise, Promises, promises_in
from roslings.course.sentences import Passage, TaskSentence, passages_of
from roslings_changes.card_words import CardWord, texts_of, words_of
from roslings_prove.prove import Proof

JOINING = {"and", "or", "but", "so", "then"}
"""What may stand between two entries."""
SHORT = 40
"""Letters of a sentence in a line about it."""


@dataclass(frozen=True)
class PromiseAccount:
    """What accounts for the sentences of a task, and the texts of a card."""

    lab: str
    sentences: int
    ways: Mapping[str, int]
    """Way to how many sentences it is the first one of."""

    @property
    def accounted(self) -> int:
        """How many have one."""
        return sum(self.ways.values())

    @property
    def line(self) -> str:
        """In words."""
        ways = ", ".join(f"{number} {way}" for way, number in self.ways.items() if number)
        return (
            f"{self.lab}: {self.accounted} of {self.sentences} sentences of the task are accounted"
            f" for ({ways or 'none'})"
        )


WAYS = {
    "checks": "judged by checks",
    "repeats": "as the card says",
    "not_judged": "not judged on purpose",
    "explains": "ask for nothing",
}


@dataclass(frozen=True)
class CourseText:
    """A passage of the task, or a text of the card."""

    where: str
    """File and line, for people."""
    passage: Passage
    place: str = ""
    """Of a text of the card."""


@dataclass(frozen=True)
class PromiseSpan:
    """Where the words of an entry stand in what was said."""

    said: CourseText
    start: int
    end: int
    promise: Promise


class Task:
    """All that a lab's task says, and what accounts for it. Raises BadCourseFile."""

    def __init__(self, lab: Lab) -> None:
        self.lab = lab
        self.promises: Promises = promises_in(lab.folder)
        card = lab.folder / "card.yaml"
        self.texts = {word.place: word for word in texts_of(card)}
        self.words = {word.place: word for word in words_of(card)}
        self.mutants: dict[str, Mutant] = {mutant.name: mutant for mutant in lab.mutants()}

    @cached_property
    def said(self) -> list[CourseText]:
        """Passages of the task, then texts of the card."""
        passages = passages_of(self.lab.task.read_text("utf-8"))
        of_task = [CourseText(f"task.md:{each.line}", each) for each in passages]
        return of_task + [_text(word) for word in self.texts.values()]

    @cached_property
    def spans(self) -> list[PromiseSpan]:
        """Of all entries whose words are found once."""
        found = (self.found(promise) for promise in self.promises.sentences)
        return [spans[0] for spans in found if len(spans) == 1]

    def found(self, promise: Promise) -> list[PromiseSpan]:
        """Where an entry's words stand."""
        words = " ".join(promise.says.split())
        there = [said for said in self.said if said.place == promise.at]
        return [
            PromiseSpan(said, start, start + len(words or said.passage.text), promise)
            for said in there
            for start in _starts(words, said.passage.text)
        ]

    def problem(self, promise: Promise) -> str:
        """What is wrong with an entry; empty where nothing is."""
        return (
            self._not_once(promise)
            or _unknown("check", promise.checks, self.lab.card.points)
            or _unknown("mutant", promise.broken_by, self.mutants)
            or _unknown("place of the card", promise.repeats, {**self.texts, **self.words})
            or self.undeclared(promise.not_judged)
            or self._not_shown(promise)
        )

    def _not_once(self, promise: Promise) -> str:
        if promise.at and promise.at not in self.texts:
            return f"the card has no text at {promise.at}"
        times = len(self.found(promise))
        where = f"the card's text at {promise.at}" if promise.at else "task.md"
        return "" if times == 1 else f"{where} says this {times} times; it must say it once"

    def undeclared(self, line: str) -> str:
        """That the task does not tell students of it."""
        if not line or line in self.lab.card.not_judged:
            return ""
        return f"the card does not say so under not_judged: {line!r}"

    def _not_shown(self, promise: Promise) -> str:
        """Each check by a mutant, and each mutant in a check."""
        fails = {name: set(self.mutants[name].fails) for name in promise.broken_by}
        unseen = set(promise.checks) - {check for checks in fails.values() for check in checks}
        if unseen:
            return f"none of its mutants fails in {', '.join(sorted(unseen))}"
        idle = [name for name, checks in fails.items() if not checks & set(promise.checks)]
        return f"these mutants fail in other checks: {', '.join(idle)}" if idle else ""


def _text(word: CardWord) -> CourseText:
    text = " ".join(str(word.value).split())
    return CourseText(f"card.yaml:{word.line}: {word.name}", Passage(text, word.line), word.place)


def _starts(words: str, text: str) -> list[int]:
    return [found.start() for found in re.finditer(re.escape(words), text)] if words else [0]


def _unknown(kind: str, names: tuple[str, ...], known: Mapping[str, object]) -> str:
    strange = [name for name in names if name not in known]
    return f"there is no {kind} {', '.join(strange)}" if strange else ""


def prove_promises(lab: Lab) -> Iterator[Proof | PromiseAccount]:
    """A proof for each sentence that asks for something, and what is wrong with the entries."""
    task = Task(lab)
    yield from _entries(task)
    ways: Counter[str] = Counter()
    sentences = [(said, each) for said in task.said for each in _asking(said)]
    for said, sentence in sentences:
        own = [span for span in task.spans if span.said == said and _meet(span, sentence)]
        left = _left_over(said, sentence, own)
        yield _proof(task, said, sentence, own, left)
        ways.update([_way(own[0].promise)] if own and not left else [])
    yield PromiseAccount(lab.name, len(sentences), {word: ways[way] for way, word in WAYS.items()})


def _entries(task: Task) -> Iterator[Proof]:
    """Those that say something wrong."""
    file = task.lab.folder / NAME
    for number, promise in enumerate(task.promises.sentences):
        if problem := task.problem(promise):
            yield _wrong_entry(task, line_in(file, ("sentences", number)), problem)
    for place, line in task.promises.words.items():
        problem = _unknown("word of the card", (place,), task.words) or task.undeclared(line)
        if problem:
            yield _wrong_entry(task, line_in(file, ("words", place)), problem)


def _wrong_entry(task: Task, line: int, problem: str) -> Proof:
    return Proof(f"{task.lab.name}: {NAME}:{line} says what is so", problem)


def _asking(said: CourseText) -> list[TaskSentence]:
    """A text of the card is one; the whole of it asks."""
    if said.place:
        return [TaskSentence(0, len(said.passage.text), True)]
    return [each for each in said.passage.sentences if each.asks]


def _meet(span: PromiseSpan, sentence: TaskSentence) -> bool:
    return span.start < sentence.end and sentence.start < span.end


def _left_over(said: CourseText, sentence: TaskSentence, spans: list[PromiseSpan]) -> str:
    """The words of a sentence that stand in no entry."""
    letters = [
        " " if any(span.start <= at < span.end for span in spans) else said.passage.text[at]
        for at in range(sentence.start, sentence.end)
    ]
    words = " ".join("".join(letters).split())
    return words if set(re.findall(r"\w+", words.lower())) - JOINING else ""


def _way(promise: Promise) -> str:
    return next(way for way in WAYS if getattr(promise, way))


def _proof(
    task: Task, said: CourseText, sentence: TaskSentence, spans: list[PromiseSpan], left: str
) -> Proof:
    text = said.passage.text[sentence.start : sentence.end]
    about = f"{task.lab.name}: {said.where}: {_short(text)!r}"
    if left:
        problem = f"nothing judges {left!r}: name its checks in {NAME}, or say what it explains"
        return Proof(f"{about} is judged", problem)
    return Proof(f"{about}: {'; '.join(dict.fromkeys(map(_how, spans)))}")


def _how(span: PromiseSpan) -> str:
    """What accounts for it, in few words."""
    promise = span.promise
    if promise.checks:
        return f"{', '.join(promise.checks)}, by {', '.join(promise.broken_by)}"
    if promise.not_judged:
        return "not judged on purpose, and the task says so"
    return "as the card says" if promise.repeats else "asks for nothing"


def _short(text: str) -> str:
    return text if len(text) <= SHORT else f"{text[: SHORT - 3]}..."


def not_judged_words(folder: Path) -> Mapping[str, str]:
    """Place of a word of the card that is on purpose not judged, to what the task says of it."""
    return promises_in(folder).words
