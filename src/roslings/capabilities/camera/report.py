"""Pictures on the page: those that an experiment kept, and the ways that were gone."""

from __future__ import annotations

from collections.abc import Iterator

from roslings.capabilities.robot import report as way_svg
from roslings.evidence import Evidence, ExperimentSeen, PictureKept
from roslings.report.html.markup import Markup, tag

WIDE_ENOUGH = 480
"""Small pictures are shown larger, by a whole number, up to this many CSS pixels."""


def pictures(evidence: Evidence) -> Iterator[Markup]:
    """Each picture that was kept, with its words."""
    figures = [
        _picture(each, seen.name)
        for seen in evidence.experiments.values()
        for each in seen.pictures
    ]
    if figures:
        yield tag("section", tag("h2", "Pictures"), *figures)


def _picture(kept: PictureKept, experiment: str) -> Markup:
    larger = max(1, WIDE_ENOUGH // kept.width)
    image = tag(
        "img",
        src=f"data:image/png;base64,{kept.png}",
        alt=kept.caption,
        width=str(kept.width * larger),
        height=str(kept.height * larger),
        class_="picture",
    )
    heading = tag("h3", f"{kept.title}, in {experiment}")
    return tag("figure", heading, image, tag("figcaption", kept.caption))


def ways(evidence: Evidence) -> Iterator[Markup]:
    """For each drive, where it really went and where the nodes said it went."""
    figures = [_ways(seen) for seen in evidence.experiments.values() if way_svg.ways_of(seen)]
    if figures:
        words = "A ring is where a line begins, a dot is where it ends."
        note = tag("p", words, class_="about")
        yield tag("section", tag("h2", "The way that it went"), note, *figures)


def _ways(seen: ExperimentSeen) -> Markup:
    found = way_svg.ways_of(seen)
    heading = tag("h3", f"in {seen.name}")
    caption = tag("figcaption", way_svg.describe(found))
    return tag("figure", heading, way_svg.way_picture(found), way_svg.legend(found), caption)
