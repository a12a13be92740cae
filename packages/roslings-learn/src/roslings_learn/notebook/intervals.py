"""The times between messages, as a picture."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Literal

from roslings_learn.notebook.errors import NotebookTrouble
from roslings_learn.notebook.hearing import HeardMessage
from roslings_learn.notebook.picture import NotebookPicture, show, svg_picture
from roslings_learn.notebook.place import on_the_site
from roslings_learn.notebook.session import any_session
from roslings_learn.notebook.simulated import simulated_times_s

WIDTH, HEIGHT = 640.0, 260.0
USUALLY = 20


class TooFew(NotebookTrouble):
    """One message has no interval."""

    def __init__(self, count: int) -> None:
        super().__init__(
            f"{count} messages are too few for a picture: two make one interval. Collect more."
        )


class NoStamps(NotebookTrouble):
    """The messages do not say when they were sent."""

    def __init__(self) -> None:
        super().__init__(
            "These messages carry no times. Collect them so: ros.collect(topic, stamps=True)"
        )


def plot_intervals(
    heard: str | Sequence[HeardMessage], *, count: int = USUALLY, timeout_s: float = 20.0
) -> None:
    """Show how long it took from message to message.

    `heard` is what `ros.collect(..., stamps=True)` gave, or a topic: then `count` messages are
    collected first. Times are the sender's; where the site is built, those of a simulated clock,
    so that a busy computer is not in the picture. Raises NoStamps, TooFew, NothingHeard.
    """
    show(intervals_picture(heard, count, timeout_s))


def intervals_picture(
    heard: str | Sequence[HeardMessage], count: int, timeout_s: float
) -> NotebookPicture:
    """The picture that `plot_intervals` shows."""
    name = heard if isinstance(heard, str) else "the topic"
    if isinstance(heard, str):
        with any_session() as ros:
            if on_the_site() and (times_s := simulated_times_s(ros, heard, count, timeout_s)):
                return _drawn(name, times_s, "sim")
            heard = ros.collect(heard, count=count, timeout_s=timeout_s, stamps=True)
    if not all(isinstance(each, HeardMessage) for each in heard):
        raise NoStamps
    return _drawn(name, [each.sent_s for each in heard], "wall")


def _drawn(name: str, times_s: Sequence[float], clock: Literal["sim", "wall"]) -> NotebookPicture:
    if len(times_s) < 2:
        raise TooFew(len(times_s))
    from roslings.evidence import ExperimentSeen, TopicSeen
    from roslings.report.html.interval_plot import describe, interval_plot
    from roslings.report.html.intervals import Interval, TopicIntervals

    intervals = tuple(Interval(b - times_s[0], b - a, 0) for a, b in pairwise(times_s))
    topic, place = TopicSeen(name=name, type=""), ExperimentSeen(name="cell", clock=clock)
    watched = TopicIntervals(place, topic, None, None, intervals)
    return svg_picture(interval_plot(watched, WIDTH, HEIGHT), describe(watched))
