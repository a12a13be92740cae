"""Pictures on the page: those that an experiment kept."""

from __future__ import annotations

from collections.abc import Iterator

from ros2_on_pip.language import said
from ros2_on_pip.markup import Markup, tag
from roslings.capabilities.camera.record import CameraSeen, PictureKept
from roslings.evidence import Evidence

WIDE_ENOUGH = 480
"""Small pictures are shown larger, by a whole number, up to this many CSS pixels."""


def pictures(evidence: Evidence) -> Iterator[Markup]:
    """Each picture that was kept, with its words."""
    figures = [
        _picture(each, seen.name)
        for seen in evidence.experiments.values()
        for each in seen.part(CameraSeen).pictures
    ]
    if figures:
        yield tag("section", tag("h2", said("page.pictures", "Pictures")), *figures)


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
    words = "{title}, in {experiment}"
    heading = said("page.picture", words, title=kept.title, experiment=experiment)
    return tag("figure", tag("h3", heading), image, tag("figcaption", kept.caption))
