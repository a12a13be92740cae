"""The sick rover of a name: which faults it has, and the drive that shows them."""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import permutations

from roslings_rover.models.differential_drive import Motion, Pose
from roslings_rover.models.drives.chance import Chance
from roslings_rover.models.drives.faults import FAULTS, RoverFault
from roslings_rover.models.drives.recording import (
    NS,
    DrivePlan,
    Piece,
    RecordedMessage,
    TopicPlan,
    recorded,
)
from roslings_rover.models.drives.sheet import MAX_SPEED_M_S, SHEET, TopicSheet

PLANTED = 5
START_S = 1_793_520_000
"""1 November 2026: a bag of a name is the same, whenever it is made."""
DAYS, DAY_S = 28, 86_400
SHORTEST_NAME = 2


class NotARoverName(ValueError):
    """A text that no rover can be made from."""


def words_of(name: str) -> tuple[str, ...]:
    """The words of a name, small, without accents, in the order of the alphabet.

    >>> words_of("Lovelace, Ada")
    ('ada', 'lovelace')
    """
    apart = unicodedata.normalize("NFKD", name).casefold()
    plain = "".join(char for char in apart if not unicodedata.combining(char))
    spaced = "".join(char if char.isalnum() else " " for char in plain)
    return tuple(sorted(spaced.split()))


NOT_OF_A_NAME = frozenset(
    {"assignment", "assignsubmission", "file", "lab", "late", "onlinetext", "submission", "zip"}
)
"""Words that a platform or a teacher puts beside the name."""
MOST_WORDS = 4
"""A name of more words is compared word by word alone."""


def may_be(name: str, handed_in_as: str, beside: str = "") -> bool:
    """Whether who wrote this name may have handed in what is called so.

    `beside` are other words that stand there, of the lab. Where no word of letters alone is left
    (`s1001_v2`), nobody can say who it was, and every name may be theirs.

    >>> may_be("Ada Lovelace", "Lovelace_Ada_4711_black-box", "black box")
    True
    >>> may_be("Ada Lovelace", "bbabbage", "black box")
    False
    """
    others = {*NOT_OF_A_NAME, *words_of(beside)}
    theirs = {word for word in words_of(handed_in_as) if word not in others}
    if not any(word.isalpha() for word in theirs):
        return True
    own = words_of(name)
    if set(own) <= theirs:
        return True
    orders = permutations(own) if len(own) <= MOST_WORDS else [own]
    return any("".join(order) in theirs for order in orders)


@dataclass(frozen=True)
class Planted:
    """A fault in one topic, and the number that proves it."""

    fault: str
    topic: str
    """As it stands in the bag."""
    number: float


@dataclass(frozen=True)
class SickRover:
    """A rover with planted faults, and all that was recorded of it."""

    plan: DrivePlan
    faults: tuple[tuple[RoverFault, TopicSheet], ...]

    @cached_property
    def said(self) -> Sequence[RecordedMessage]:
        """The messages of its bag."""
        return recorded(self.plan)

    @cached_property
    def planted(self) -> tuple[Planted, ...]:
        """The truth about it."""
        plans = {topic.sheet: topic for topic in self.plan.topics}
        return tuple(
            Planted(
                fault.name, plans[sheet].name, fault.measure(self.said, plans[sheet], self.plan)
            )
            for fault, sheet in self.faults
        )


@lru_cache(maxsize=4)
def sick_rover(name: str, count: int = PLANTED) -> SickRover:
    """The rover of a name, however that is written. Raises NotARoverName."""
    words = words_of(name)
    if len("".join(words)) < SHORTEST_NAME:
        raise NotARoverName(name)
    chance = Chance(f"sick rover 1: {' '.join(words)}")
    faults = _chosen(chance, count)
    plan = _healthy(chance)
    for fault, sheet in faults:
        topic = next(each for each in plan.topics if each.sheet is sheet)
        plan = fault.plant(plan, topic, chance)
    return SickRover(plan, faults)


def _chosen(chance: Chance, count: int) -> tuple[tuple[RoverFault, TopicSheet], ...]:
    """So many faults, each with a topic of its own: who has the least choice chooses first."""
    some = chance.shuffled(tuple(FAULTS.values()))[:count]
    found: list[tuple[RoverFault, TopicSheet]] = []
    for fault in sorted(some, key=lambda each: len(each.topics)):
        taken = {sheet for _, sheet in found}
        found.append((fault, chance.pick([each for each in fault.topics if each not in taken])))
    return tuple(found)


def _healthy(chance: Chance) -> DrivePlan:
    start_s = START_S + int(chance.between(0, DAYS)) * DAY_S + int(chance.between(30_000, 60_000))
    return DrivePlan(
        seed=f"{chance.between(0, 1):.17f}",
        start_ns=start_s * NS + int(chance.between(0, NS)),
        pieces=tuple(_pieces(chance)),
        topics=tuple(TopicPlan.healthy(sheet) for sheet in SHEET),
        begin=Pose(chance.around(0, 1), chance.around(0, 1), chance.around(0, 3)),
    )


def _pieces(chance: Chance) -> list[Piece]:
    """Straight on, and a turn, again and again; at least once as fast as it may."""
    found = [Piece(Motion(), 1.0)]
    for number in range(5):
        speed = MAX_SPEED_M_S if number == 1 else chance.between(0.12, 0.28)
        turn = chance.pick((-1, 1)) * chance.between(0.4, 0.9)
        found.append(Piece(Motion(speed), chance.between(4, 6)))
        found.append(Piece(Motion(chance.between(0.05, 0.15), turn), chance.between(1.5, 3)))
    return [*found, Piece(Motion(), 1.0)]
