"""What a card says about a program that reads bags, and about a diagnosis; its rows in task.md."""

from __future__ import annotations

import string
from collections.abc import Iterable, Mapping
from typing import Annotated

from pydantic import Field, model_validator

from roslings.capability import Row, Words
from roslings.course.contract import CardWords, Contract, Expected, Promise, Stimulus
from roslings.course.kinds import Kind

LINES: Mapping[str, frozenset[str]] = {
    "duration": frozenset({"seconds"}),
    "topic": frozenset({"topic", "count", "rate"}),
    "gap": frozenset({"topic", "seconds", "start"}),
    "distance": frozenset({"metres"}),
    "top_speed": frozenset({"speed"}),
}
"""What a program may tell of a bag, and the fields that such a line has."""


class LineContract(Contract):
    """A line that the program writes."""

    text: Annotated[str, Expected] = Field(description="Fields in braces stand for what is read")
    about: Annotated[str, Promise]


class RefusalContract(Contract):
    """What the program does with a bag that it can tell nothing of."""

    when: Annotated[str, Promise]
    log: Annotated[str, Expected] = Field(
        description="`{path}` is that of the bag, `{topic}` that of the drive"
    )
    exit_code: Annotated[int, Expected]


class BagReaderContract(Contract):
    """A program that gets the path of a bag, tells what is in it, and ends."""

    executable: Annotated[str, Kind.KEY]
    storages: Annotated[tuple[str, ...], Stimulus] = Field(description="How bags are stored")
    odometry: Annotated[str, Expected] = Field(description="The topic that tells of the drive")
    gap_periods: Annotated[float, Kind.EDGE] = Field(
        gt=1, description="A longer time between two messages is a gap; in usual periods"
    )
    decimals: Annotated[int, Expected] = Field(
        ge=0, le=3, description="So many digits after the point are right"
    )
    lines: dict[str, LineContract]
    no_bag: RefusalContract
    no_drive: RefusalContract

    @model_validator(mode="after")
    def _lines_are_known(self) -> BagReaderContract:
        if set(self.lines) != set(LINES):
            raise ValueError(f"the lines are {sorted(self.lines)}, not {sorted(LINES)}")
        for name, line in self.lines.items():
            if _fields(line.text) != LINES[name]:
                raise ValueError(f"the line {name!r} has the fields {sorted(LINES[name])}")
        return self


class DiagnosisContract(Contract):
    """A file that tells what is wrong with the rover of a name."""

    faults: Annotated[int, Expected] = Field(ge=1, le=9, description="So many are planted")
    number_within: Annotated[float, Stimulus] = Field(
        gt=0, lt=1, description="So far off a measured number may be, as a part of it"
    )


class BagWords(CardWords):
    """What a card may say of the package."""

    reads_bags: BagReaderContract | None = None
    diagnosis: DiagnosisContract | None = None


def _fields(template: str) -> set[str]:
    return {field for _, field, _, _ in string.Formatter().parse(template) if field}


def shown(template: str) -> str:
    """A template as people read it: its fields are in capital letters.

    >>> shown("gap {topic}: {seconds} s")
    'gap TOPIC: SECONDS s'
    """
    return template.format(**{field: field.upper() for field in _fields(template)})


def rows(card: BagWords) -> Iterable[Row]:
    """The program that reads bags, and the diagnosis."""
    if card.reads_bags:
        yield from _reader_rows(card.reads_bags)
    if card.diagnosis:
        yield from _diagnosis_rows(card.diagnosis)


def _reader_rows(reader: BagReaderContract) -> Iterable[Row]:
    yield "executable", f"`{reader.executable}`; behind it stands the path of a bag"
    yield "reads", f"bags that are stored as {' or '.join(reader.storages)}"
    yield "the drive", f"is told by the topic `{reader.odometry}`"
    yield "a gap", f"is longer than {reader.gap_periods:g} usual periods of its topic"
    yield "numbers", f"are right to {reader.decimals} digits after the point"
    for line in reader.lines.values():
        yield f"`{shown(line.text)}`", line.about
    yield "else", "ends by itself with exit code 0"
    for refusal in (reader.no_bag, reader.no_drive):
        log = f"`{shown(refusal.log)}`"
        yield refusal.when, f"writes {log}; ends by itself with exit code {refusal.exit_code}"


def _diagnosis_rows(diagnosis: DiagnosisContract) -> Iterable[Row]:
    yield "a sick rover", f"has {diagnosis.faults} of the ten faults"
    yield (
        "a measured number",
        f"is right when it is at most {diagnosis.number_within * 100:g} % off",
    )


WORDS = Words(card=BagWords, package=rows)
