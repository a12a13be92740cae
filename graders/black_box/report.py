"""Bags on the page: which the program got, and what was in them."""

from __future__ import annotations

from collections.abc import Iterator

from graders.black_box.record import BagGiven, BagsSeen
from ros2_on_pip.markup import Markup, tag
from roslings.evidence import Evidence
from roslings.report.html.timeline_svg import table

BAG = ("what", "in the bag")
TOPICS = ("topic", "messages", "Hz")
PAUSES = ("topic", "seconds", "from", "usual periods")


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each bag with a drive that the program got."""
    given = [
        bag
        for seen in evidence.experiments.values()
        for bag in seen.part(BagsSeen).given
        if bag.holds
    ]
    if given:
        yield tag("section", tag("h2", "Bags that the program got"), *map(_figure, given))


def _figure(bag: BagGiven) -> Markup:
    holds = bag.holds
    assert holds is not None
    whole = [
        ("duration", f"{holds.duration_s:.2f} s"),
        ("distance", f"{holds.distance_m:.2f} m"),
        ("top speed", f"{holds.top_speed_m_s:.2f} m/s"),
    ]
    topics = [(each.name, str(each.count), f"{each.rate_hz:.2f}") for each in holds.topics]
    pauses = [
        (each.topic, f"{each.seconds:.2f}", f"{each.start_s:.2f}", f"{each.periods:.1f}")
        for each in holds.pauses
    ]
    name = bag.path.rpartition("/")[2]
    return tag(
        "figure",
        tag("h3", name),
        table(f"the drive in {name}", BAG, whole),
        table(f"topics of {name}", TOPICS, topics),
        table(f"pauses of {name}", PAUSES, pauses),
    )
