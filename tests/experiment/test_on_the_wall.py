"""What speaks against believing a rate that was seen in real time."""

from __future__ import annotations

import pytest

from roslings.course import RateContract
from roslings.evidence import CanarySeen, ExperimentSeen, ProcessSeen
from roslings.experiment.on_the_wall import trouble
from roslings.rates import Rate

LIMIT = RateContract(hz=2.0, within=0.02)


def watched(hz: float, stall_s: float = 0.0) -> str | None:
    """A node that came at `hz`, on a computer whose canary did not come up."""
    seen = ExperimentSeen(
        name="alone", clock="wall", canary=CanarySeen(wanted_hz=LIMIT.hz), stall_s=stall_s
    )
    periods_s = (1 / hz,) * 20
    return trouble(seen, Rate(hz, 0.001, periods_s, 0, True), LIMIT)


@pytest.mark.parametrize("hz", [0.5, 1.5, 2.0, 3.9])
def test_without_its_canary_a_rate_tells_nothing(hz: float) -> None:
    """It may be the computer's doing, and near the limit also what is too fast."""
    assert "did not come up" in (watched(hz) or "")


@pytest.mark.parametrize("hz", [4.2, 20_000.0])
def test_no_computer_makes_a_node_twice_as_fast(hz: float) -> None:
    """A node that takes all processors, so that the canary is late, gets its own rate told."""
    assert watched(hz, stall_s=3.0) is None


@pytest.mark.parametrize(("waited_s", "told"), [(0.0, False), (1.0, False), (2.0, True)])
def test_what_a_busy_computer_may_have_made_uneven_tells_nothing(
    waited_s: float, told: bool
) -> None:
    """Twenty periods, all odd: fifteen too many. It takes half a period of waiting for two."""
    node = ProcessSeen(executable="it", started_ns=0, cpu_wait_s=waited_s)
    seen = ExperimentSeen(name="alone", clock="wall", processes={"it": node})
    rate = Rate(LIMIT.hz, 0.001, (0.9, 0.1) * 10, 0, True)
    assert ("messages are even" in (trouble(seen, rate, LIMIT) or "")) is told
