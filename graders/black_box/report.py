"""Bags on the page: which the program got, and what was in them."""

from __future__ import annotations

from collections.abc import Iterator

from graders.black_box.record import BagGiven, BagsSeen
from ros2_on_pip.language import Text, said
from ros2_on_pip.markup import Markup, tag
from roslings.evidence import Evidence
from roslings.report.html.timeline_svg import table

TOPIC = Text("page.bags.topic", "topic")
BAG = (Text("page.bags.what", "what"), Text("page.bags.in", "in the bag"))
TOPICS = (TOPIC, Text("page.bags.messages", "messages"), Text("page.bags.hz", "Hz"))
PAUSES = (
    TOPIC,
    Text("page.bags.seconds", "seconds"),
    Text("page.bags.from", "from"),
    Text("page.bags.periods", "usual periods"),
)


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each bag with a drive that the program got."""
    given = [
        bag
        for seen in evidence.experiments.values()
        for bag in seen.part(BagsSeen).given
        if bag.holds
    ]
    if given:
        title = said("page.bags", "Bags that the program got")
        yield tag("section", tag("h2", title), *map(_figure, given))


def _figure(bag: BagGiven) -> Markup:
    holds = bag.holds
    assert holds is not None
    whole = [
        (said("page.bags.duration", "duration"), f"{holds.duration_s:.2f} s"),
        (said("page.bags.distance", "distance"), f"{holds.distance_m:.2f} m"),
        (said("page.bags.top_speed", "top speed"), f"{holds.top_speed_m_s:.2f} m/s"),
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
        table(said("page.bags.drive", "the drive in {bag}", bag=name), BAG, whole),
        table(said("page.bags.topics", "topics of {bag}", bag=name), TOPICS, topics),
        table(said("page.bags.pauses", "pauses of {bag}", bag=name), PAUSES, pauses),
    )
