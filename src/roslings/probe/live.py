"""The graph that runs in the student's own terminals, outside any arena."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager

from roslings.arena import QUICK_DISCOVERY
from roslings.evidence import ExperimentSeen, GraphSeen
from roslings.probe.probe import Probe

QUIET_S = 1.5
"""The graph counts as complete when nothing new came for this long."""

EMPTY_S = 4.0
"""A running node was always found within 2.7 s; so nothing found for longer means none runs."""

LONGEST_S = 15.0


def live_graph() -> GraphSeen:
    """Every node of this terminal's ROS domain.

    Where the terminal does not say how far to look (ROS_AUTOMATIC_DISCOVERY_RANGE), only this
    computer is asked: nothing goes out to the network.
    """
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    os.environ.setdefault("FASTRTPS_DEFAULT_PROFILES_FILE", str(QUICK_DISCOVERY))
    with (
        tempfile.TemporaryDirectory() as logs,
        _logging_to(logs),
        Probe(domain_id(), ExperimentSeen(name="live", clock="wall"), record=False) as probe,
    ):
        settled = Settled()
        probe.until(lambda: settled.after(probe.seen.graph), LONGEST_S)
        return probe.seen.graph


@contextmanager
def _logging_to(folder: str) -> Iterator[None]:
    """A look leaves no log file behind in ~/.ros, which nobody ever tidies."""
    before = os.environ.get("ROS_LOG_DIR")
    os.environ["ROS_LOG_DIR"] = folder
    try:
        yield
    finally:
        os.environ.pop("ROS_LOG_DIR")
        if before is not None:
            os.environ["ROS_LOG_DIR"] = before


def domain_id() -> int:
    """This terminal's ROS domain; 0 where it says none or nonsense."""
    text = os.environ.get("ROS_DOMAIN_ID", "")
    return int(text) if text.isdecimal() else 0


class Settled:
    """Tells when a graph has stopped to grow."""

    def __init__(self) -> None:
        self._before: tuple[int, int] = (-1, -1)
        self._since_s = time.monotonic()

    def after(self, graph: GraphSeen) -> bool:
        """Nothing new came for long enough."""
        now = (len(graph.nodes), len(graph.endpoints))
        if now != self._before:
            self._before, self._since_s = now, time.monotonic()
        quiet_s = time.monotonic() - self._since_s
        return quiet_s > (QUIET_S if graph.nodes else EMPTY_S)
