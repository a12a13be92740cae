"""A rate on a computer that does other things, too: what can be held against the student."""

from __future__ import annotations

from roslings.course import TopicContract
from roslings.judge.demands import have_rate, require_steady, written
from roslings.judge.faults import Bursts, Inconclusive, TooSlow
from roslings.judge.views import Demand, TopicView

FAR_OFF = 0.5
"""A rate that is wrong by half of itself is no pause of the computer's."""


def keep_rate(contract: TopicContract) -> Demand[TopicView]:
    """The messages come at the card's rate, evenly; for rates that a short pause can bend."""

    def demand(topic: TopicView) -> None:
        try:
            topic.must(have_rate(contract))
        except (Bursts, TooSlow):
            require_undisturbed(topic, contract)
            raise

    return demand


def require_undisturbed(topic: TopicView, contract: TopicContract) -> None:
    """No pause of this computer explains a rate that is slow or uneven. Raises Inconclusive.

    A pause of half a period makes two periods look odd, and a timer that was not run in time
    leaves a message out.
    """
    require_steady(topic.stall_s)
    wanted_hz, rate = written(contract.rate, contract.topic).hz, topic.rate
    near = rate is not None and abs(rate.hz - wanted_hz) < FAR_OFF * wanted_hz
    if near and topic.stall_s > 0.5 / wanted_hz:
        raise Inconclusive(
            f"this computer stood still for {topic.stall_s:.2f} s while your nodes ran;"
            " close other programs and check again"
        )
