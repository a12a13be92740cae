"""What a student learns of a run in simulated time that was not believed: sums over evidence.

That a run was not believed tells nothing of the node: the computer may be slow, or the experiment
belongs on the wall. Whether a node goes by real time is measured in two runs. By real time it has a
rate. In the simulated run it sent as many messages as that rate makes of the real seconds. That is
clearly not as many as it makes of the simulated ones.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ros2_on_pip.rates import NS_PER_S, measure_rate
from roslings.evidence import Endpoint, Evidence, ExperimentSeen, MessageSeen, ProcessSeen
from roslings.experiment.simulated import clock_publishers
from roslings.seen.exits import is_outlived, tracebacks

AT_ONCE = 1
"""A timer speaks once when the clock first moves, however far."""
COUNTS_DIFFER, COUNTS_DIFFER_SHARE = 1.5, 0.25
"""By so many messages, or by this part of them, a count may be off by chance."""
CLEARLY, CLEARLY_SHARE = 2.5, 0.4
"""By so many, or by this part of them, it is off by more than chance."""


def advice_on_clocks(evidence: Evidence) -> list[str]:
    """What to say of the runs in simulated time that did not count; each thing once."""
    found: list[str] = []
    for seen in evidence.attempts:
        found += _advice_on(seen, evidence.experiments[seen.name])
    return list(dict.fromkeys(found))


def _advice_on(seen: ExperimentSeen, counted: ExperimentSeen) -> Iterator[str]:
    for topic in topics_by_real_time(seen, counted):
        names = ", ".join(sorted({each.node for each in _publishers(counted, topic)}))
        yield (
            f"{names or topic} does not follow simulated time (/clock), so it was watched in real"
            " time. A timer of create_timer() follows it; time.sleep() and threads do not."
        )
    yield from _on_ends(seen, counted)
    for node in clock_publishers(seen):
        yield f"{node} publishes on /clock. That is for a simulator: it sets the time of all nodes."


def note_who_ignores_the_clock(evidence: Evidence) -> None:
    """Write down of each run in simulated time what it and the run that counts show together."""
    for seen in evidence.attempts:
        seen.ignores_clock = bool(topics_by_real_time(seen, evidence.experiments[seen.name]))


def topics_by_real_time(simulated: ExperimentSeen, counted: ExperimentSeen) -> list[str]:
    """Those of which it was measured that their messages come by real time."""
    if not simulated.not_believed or not simulated.ticks or not _is_whole(simulated, counted):
        return []
    return [name for name in counted.topics if _comes_by_real_time(name, simulated, counted)]


def _is_whole(simulated: ExperimentSeen, counted: ExperimentSeen) -> bool:
    """Both runs tell of a node that was there all the time."""
    if simulated.clock != "sim" or counted.clock != "wall" or counted.machine_fault:
        return False
    processes = [*simulated.processes.values(), *counted.processes.values()]
    return not any(process.ended_by_itself for process in processes)


def _comes_by_real_time(topic: str, simulated: ExperimentSeen, counted: ExperimentSeen) -> bool:
    rate = measure_rate(counted.topics[topic].messages)
    if rate is None or not _publishers(simulated, topic):
        return False
    heard = simulated.topics.get(topic)
    span = _span(simulated, heard.messages if heard else ())
    by_real, by_simulated = rate.hz * span.real_s, rate.hz * span.simulated_s
    return abs(span.count - by_real) <= max(COUNTS_DIFFER, COUNTS_DIFFER_SHARE * by_real) and abs(
        span.count - by_simulated
    ) > max(CLEARLY, CLEARLY_SHARE * by_simulated)


def _publishers(seen: ExperimentSeen, topic: str) -> list[Endpoint]:
    ends = seen.graph.endpoints
    return [end for end in ends if (end.topic, end.kind) == (topic, "publisher")]


@dataclass(frozen=True)
class SimulatedSpan:
    """A stretch of a run in simulated time, and the messages that came in it."""

    count: int
    real_s: float
    simulated_s: float


def _span(seen: ExperimentSeen, messages: Sequence[MessageSeen]) -> SimulatedSpan:
    """From the first step of the clock, or the first message before it, to the last of both.

    While the clock stands still, no simulated time goes by.
    """
    moments_ns = [message.arrival_ns for message in messages]
    moments_ns += [seen.ticks[0].at_ns, seen.ticks[-1].at_ns]
    return SimulatedSpan(
        count=max(0, len(messages) - AT_ONCE),
        real_s=(max(moments_ns) - min(moments_ns)) / NS_PER_S,
        simulated_s=(seen.ticks[-1].sim_ns - seen.ticks[0].sim_ns) / NS_PER_S,
    )


def _on_ends(simulated: ExperimentSeen, counted: ExperimentSeen) -> Iterator[str]:
    """Of a program that ends by itself in simulated time, and only there."""
    for label, process in simulated.processes.items():
        if not is_outlived(label, simulated, counted):
            continue
        name = process.executable
        yield (
            f"{name} ended by itself in simulated time (use_sim_time){_error(process)}."
            " In real time it ran on, and that is what counts here. Until the first message on"
            " /clock a node's clock shows 0, so nothing can be subtracted from it."
        )


def _error(process: ProcessSeen) -> str:
    """Its own words, where it told an error."""
    traces = tracebacks(process)
    return f": {traces[-1][-1].strip().rstrip('.')}" if traces else ""
