"""What speaks against believing a rate that was seen in real time."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ros2_on_pip.rates import Rate
from roslings.course import RateContract
from roslings.evidence import CanarySeen, ExperimentSeen, MessageSeen, ProcessSeen
from roslings.experiment.on_the_wall import trouble
from roslings.seen.rates import own_rate

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


class SingsOn(list[MessageSeen]):
    """Songs to which each who reads them all hears one more afterwards."""

    def __iter__(self) -> Iterator[MessageSeen]:
        yield from list(super().__iter__())
        self.append(song(len(self)))


def song(number: int) -> MessageSeen:
    """One message of a canary that is never late."""
    at_ns = round(number * 1e9 / LIMIT.hz)
    return MessageSeen(arrival_ns=at_ns, source_ns=at_ns, sequence=number, size=0)


def test_a_canary_that_sings_on_is_measured_all_the_same() -> None:
    """Beside two full processors another thread heard one more in the middle of the sum."""
    canary = CanarySeen(wanted_hz=LIMIT.hz)
    canary.messages = SingsOn(map(song, range(20)))
    seen = ExperimentSeen(name="alone", clock="wall")
    seen.canary = canary
    rate = Rate(LIMIT.hz, 0.001, (1 / LIMIT.hz,) * 20, 0, True)
    assert trouble(seen, rate, LIMIT) is None


def kept_waiting(rate: Rate | None, waited_s: float, devices_s: float = 0.0) -> str | None:
    """A node that waited so long for a processor, and its device, too."""
    node = ProcessSeen(executable="it", started_ns=0, cpu_wait_s=waited_s)
    seen = ExperimentSeen(
        name="alone", clock="wall", processes={"it": node}, devices_wait_s=devices_s
    )
    return trouble(seen, rate, LIMIT)


@pytest.mark.parametrize(
    ("stamped", "waited_s", "told"),
    [
        (True, 0.0, False),
        (True, 1.0, False),
        (True, 2.0, True),
        (False, 0.1, False),
        (False, 1.0, True),
    ],
)
def test_what_a_busy_computer_may_have_made_uneven_tells_nothing(
    stamped: bool, waited_s: float, told: bool
) -> None:
    """Twenty periods, all odd: fifteen too many. It takes half a period of waiting for two."""
    rate = Rate(LIMIT.hz, 0.001, (0.9, 0.1) * 10, 0, stamped)
    assert ("messages are even" in (kept_waiting(rate, waited_s) or "")) is told


def test_a_node_waits_for_its_device_too() -> None:
    """Two seconds in all are enough to make fifteen of twenty periods odd."""
    rate = Rate(LIMIT.hz, 0.001, (0.9, 0.1) * 10, 0, True)
    assert kept_waiting(rate, 0.5, devices_s=0.0) is None
    assert "messages are even" in (kept_waiting(rate, 0.5, devices_s=1.5) or "")


def test_the_silence_of_a_node_that_could_not_run_tells_nothing() -> None:
    """One period of waiting is enough to doubt it."""
    assert kept_waiting(None, 0.4) is None
    assert "silence" in (kept_waiting(None, 0.6) or "")


@pytest.mark.parametrize(("late_ms", "told"), [(0, False), (80, True)])
def test_a_loop_beside_a_late_canary_gets_no_rate_told(late_ms: int, told: bool) -> None:
    """The kernel saw no waiting, as in a virtual machine that is not run itself."""
    times_ms = [500 * n + (late_ms if n % 2 else 0) for n in range(21)]
    song = [
        MessageSeen(source_ns=at * 10**6, sequence=n + 1, arrival_ns=at * 10**6, size=4)
        for n, at in enumerate(times_ms)
    ]
    seen = ExperimentSeen(
        name="alone", clock="wall", canary=CanarySeen(wanted_hz=LIMIT.hz, messages=song)
    )
    loop = Rate(1.93, 0.01, (0.5, 0.53, 0.526) * 7, 0, True)
    assert ("own rate" in (trouble(seen, own_rate(loop, seen), LIMIT) or "")) is told
