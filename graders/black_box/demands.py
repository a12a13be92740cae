"""Demands on what a program tells of a bag, and on a diagnosis."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from graders.black_box import diagnosis as diagnoses
from graders.black_box.contract import (
    BagReaderContract,
    DiagnosisContract,
    LineContract,
    RefusalContract,
    shown,
)
from graders.black_box.faults import (
    GapMissed,
    LineMissing,
    LineTwice,
    NoBagNotTold,
    NoDiagnosis,
    NoDriveNotTold,
    NoGap,
    Number,
    OtherRover,
    ReadingFails,
    ReadingNeverEnds,
    RefusalMissing,
    TellsNothing,
    TooFewFound,
    UnknownTopicTold,
    UnreadableDiagnosis,
    WhenRead,
    Where,
    WrongNumber,
)
from graders.black_box.lines import Template, Told
from graders.black_box.reasons import NoBagGiven
from graders.black_box.record import BagGiven, BagsSeen, DriveHeld, PauseHeld
from roslings.judge.demands import require_steady
from roslings.judge.faults.sentences import Text
from roslings.judge.views import Demand, ExperimentView, PackageView, ProcessView
from roslings.judge.words import end_of
from roslings_rover.models.drives.sick_rover import NotARoverName, Planted, may_be, sick_rover

Whole = Literal["duration", "distance", "top_speed"]
"""Numbers of a whole bag."""

RATE_WITHIN = 0.01
"""The jitter of a timer moves the median, and other right ways to find the usual period."""
WORDS = re.compile(r"[\s/:,`'\"]+")
"""What stands between the words of a line, and between the names of a topic."""
ROUNDED = 0.55
"""Of the last digit: half of it, and what numbers lose on their way."""


@dataclass(frozen=True)
class Reading:
    """The program with one bag: what it was given, and what it wrote."""

    reader: BagReaderContract
    given: BagGiven
    process: ProcessView

    @property
    def holds(self) -> DriveHeld:
        """What is in the bag. Raises NothingToJudge."""
        if self.given.holds is None:
            raise NoBagGiven("empty")
        return self.given.holds

    def told(self, line: LineContract) -> list[Told]:
        """What each line says that is like this one of the card."""
        return list(Template(line.text).told_in(self.process.texts))

    def told_once(self, line: LineContract, of: str = "") -> Told:
        """The one line about this, or about the topic `of`. Raises LineMissing, LineTwice."""
        found = [each for each in self.told(line) if not of or each["topic"] == of]
        if not found:
            raise self._missing(line, of)
        if len(found) > 1:
            raise LineTwice(self._wanted(line, of), len(found))
        return found[0]

    def _missing(self, line: LineContract, of: str) -> LineMissing:
        texts = self.process.texts
        near = [text for text in Template(line.text).like(texts) if not of or of in text.split()]
        near = near or [text for text in texts if of and of in text]
        first = near[0] if near else None
        return LineMissing(self._wanted(line, of), first, len(texts), log=self.process.last_lines())

    def misspelled(self, line: Template, topic: str) -> list[str]:
        """Lines that begin as this one and name this topic, but are not written as the card says.

        Also where the slash before the topic, or its namespace, is left out.
        """
        name = topic.rpartition("/")[2]
        texts = [text for text in line.like(self.process.texts) if name in re.split(WORDS, text)]
        told = {text: list(line.told_in([text])) for text in texts}
        names = {each.name for each in self.holds.topics}
        return [text for text in texts if not any(t["topic"] in names for t in told[text])]

    def _wanted(self, line: LineContract, of: str) -> str:
        return shown(line.text).replace("TOPIC", of) if of else shown(line.text)

    def is_near(self, told: str, wanted: float) -> bool:
        """A number is right to the digits of the card."""
        return abs(float(told) - wanted) <= ROUNDED * 10.0**-self.reader.decimals

    def number(self, value: float) -> str:
        """As the program should write it."""
        return f"{value:.{self.reader.decimals}f}"


def _reading(experiment: ExperimentView, reader: BagReaderContract, label: str) -> Reading:
    """Raises NothingToJudge where the program never got this bag."""
    for given in experiment.seen.part(BagsSeen).given:
        if given.label == label and label in experiment.seen.processes:
            return Reading(reader, given, experiment.labelled(label))
    raise NoBagGiven("not_given")


def read_to_the_end(reader: BagReaderContract, label: str, of: str) -> Demand[ExperimentView]:
    """It ends by itself, with exit code 0, and has told something."""

    def demand(experiment: ExperimentView) -> None:
        process = _reading(experiment, reader, label).process
        _require_end(experiment, process, WhenRead(of))
        if process.seen.status != 0:
            end, log = end_of(process.seen), process.last_lines()
            raise ReadingFails(reader.executable, end, of, log=log)
        if not process.texts:
            raise TellsNothing(reader.executable, of)

    return demand


def _require_end(experiment: ExperimentView, process: ProcessView, when: Text) -> None:
    if not process.seen.ended_by_itself:
        require_steady(experiment.seen.stall_s)
        log = process.last_lines()
        raise ReadingNeverEnds(process.seen.executable, process.ran_s, when, log=log)


def tell(reader: BagReaderContract, label: str, line: Whole, field: str) -> Demand[ExperimentView]:
    """One number of the whole bag: its `duration`, `distance` or `top_speed`."""
    contract = reader.lines[line]

    def demand(experiment: ExperimentView) -> None:
        reading = _reading(experiment, reader, label)
        wanted = getattr(reading.holds, TRUTHS[line])
        told = reading.told_once(contract)[field]
        if not reading.is_near(told, wanted):
            raise WrongNumber(Number(line), reading.number(wanted), told, contract.about)

    return demand


TRUTHS: Mapping[Whole, str] = {
    "duration": "duration_s",
    "distance": "distance_m",
    "top_speed": "top_speed_m_s",
}


def tell_counts(reader: BagReaderContract, label: str) -> Demand[ExperimentView]:
    """A line for each topic, with its number of messages, and for no other."""
    contract = reader.lines["topic"]

    def demand(experiment: ExperimentView) -> None:
        reading = _reading(experiment, reader, label)
        for topic in reading.holds.topics:
            told = reading.told_once(contract, topic.name)["count"]
            if int(told) != topic.count:
                what = Number("count", topic.name)
                raise WrongNumber(what, str(topic.count), told, contract.about)
        there = tuple(topic.name for topic in reading.holds.topics)
        for each in reading.told(contract):
            if each["topic"] not in there:
                raise UnknownTopicTold(each["topic"], there)

    return demand


def tell_rates(reader: BagReaderContract, label: str) -> Demand[ExperimentView]:
    """The rate of each topic, whatever gaps it has."""
    contract = reader.lines["topic"]

    def demand(experiment: ExperimentView) -> None:
        reading = _reading(experiment, reader, label)
        for topic in reading.holds.topics:
            told = reading.told_once(contract, topic.name)["rate"]
            off = abs(float(told) - topic.rate_hz)
            if off > RATE_WITHIN * topic.rate_hz + 10.0**-reader.decimals:
                what = Number("rate", topic.name)
                raise WrongNumber(what, reading.number(topic.rate_hz), told, contract.about)

    return demand


def tell_gaps(reader: BagReaderContract, label: str) -> Demand[ExperimentView]:
    """Each gap, and nothing else as a gap."""
    contract, limit = reader.lines["gap"], reader.gap_periods

    def demand(experiment: ExperimentView) -> None:
        reading = _reading(experiment, reader, label)
        told = reading.told(contract)
        for gap in reading.holds.gaps(limit):
            fitting = [each for each in told if _is_told(reading, gap, each)]
            if not fitting:
                raise _missed(reading, gap)
            if len(fitting) > 1:
                raise LineTwice(contract.text.format(**fitting[0]), len(fitting))
            told.remove(fitting[0])
        _insist_on_none(reading, told)

    return demand


def _missed(reading: Reading, gap: PauseHeld) -> GapMissed:
    """With all lines about its topic: those of other gaps, those that fit none, misspelled ones."""
    line, limit = Template(reading.reader.lines["gap"].text), reading.reader.gap_periods
    wanted = line.filled(
        {
            "topic": gap.topic,
            "seconds": reading.number(gap.seconds),
            "start": reading.number(gap.start_s),
        }
    )
    of_topic = [t for t in reading.told(reading.reader.lines["gap"]) if t["topic"] == gap.topic]
    right = [each for each in of_topic if _is_a_gap(reading, each)]
    others = [line.filled(each) for each in of_topic if each not in right]
    misspelled = reading.misspelled(line, gap.topic)
    told = tuple([*others, *misspelled])
    return GapMissed(wanted, gap.topic, told, tuple(map(line.filled, right)), limit)


def _is_a_gap(reading: Reading, told: Told) -> bool:
    gaps = reading.holds.gaps(reading.reader.gap_periods)
    return any(_is_told(reading, gap, told) for gap in gaps)


def _is_told(reading: Reading, gap: PauseHeld, told: Told) -> bool:
    return (
        told["topic"] == gap.topic
        and reading.is_near(told["seconds"], gap.seconds)
        and reading.is_near(told["start"], gap.start_s)
    )


def _insist_on_none(reading: Reading, told: Sequence[Told]) -> None:
    for each in told:
        pauses = (p.periods for p in reading.holds.pauses if _is_told(reading, p, each))
        line = reading.reader.lines["gap"].text.format(**each)
        raise NoGap(line, reading.reader.gap_periods, next(pauses, None))


def tell_no_bag(reader: BagReaderContract, label: str) -> Demand[ExperimentView]:
    """Where there is no bag, it writes so, and its exit code says it, too."""
    return _refuse(reader, label, reader.no_bag, NoBagNotTold)


def tell_no_drive(reader: BagReaderContract, label: str) -> Demand[ExperimentView]:
    """The same where no message tells of the drive."""
    return _refuse(reader, label, reader.no_drive, NoDriveNotTold)


def _refuse(
    reader: BagReaderContract, label: str, refusal: RefusalContract, fault: type[RefusalMissing]
) -> Demand[ExperimentView]:
    def demand(experiment: ExperimentView) -> None:
        reading = _reading(experiment, reader, label)
        process = reading.process
        _require_end(experiment, process, Where(refusal.when))
        line = refusal.log.format(path=reading.given.path, topic=reader.odometry)
        is_told = any(text.strip() == line for text in process.texts)
        if is_told and process.seen.status == refusal.exit_code:
            return
        begin = Template(refusal.log.partition(":")[0])
        near = next(iter(begin.like(process.texts)), None)
        raise fault(
            refusal.when,
            line,
            refusal.exit_code,
            near,
            is_told,
            end_of(process.seen),
            log=process.last_lines(),
        )

    return demand


# --- the diagnosis -----------------------------------------------------------------------------


def be_of_its_own_rover(path: str, contract: DiagnosisContract) -> Demand[PackageView]:
    """The diagnosis can be read, and is about the rover of who handed it in."""

    def demand(package: PackageView) -> None:
        found = _diagnosis(package, path)
        try:
            sick_rover(found.name, contract.faults)
        except NotARoverName:
            nobody = diagnoses.Problem("no_rover", said=found.name)
            raise UnreadableDiagnosis(path, nobody) from None
        handed_in_as = package.files.handed_in_as
        if not may_be(found.name, handed_in_as, f"{package.lab} {package.files.name}"):
            raise OtherRover(found.name, handed_in_as)

    return demand


def _diagnosis(package: PackageView, path: str) -> diagnoses.Diagnosis:
    text = package.files.documents.get(path)
    if text is None:
        raise NoDiagnosis(path)
    try:
        return diagnoses.read(text)
    except diagnoses.Unreadable as error:
        raise UnreadableDiagnosis(path, error.problem) from None


def find(count: int, path: str, contract: DiagnosisContract) -> Demand[PackageView]:
    """So many more entries are right than wrong."""

    def demand(package: PackageView) -> None:
        found = _diagnosis(package, path)
        truth: tuple[Planted, ...] = sick_rover(found.name, contract.faults).planted
        tally = diagnoses.tally(found.entries, truth, contract.number_within)
        if tally.net < count:
            right, wrong = len(tally.right), len(tally.wrong)
            raise TooFewFound(count, right, wrong, tally.near, tally.again)

    return demand
