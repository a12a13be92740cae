"""The desk's node: that of a look at the graph, which other threads may ask for something."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import Any

from ros2_on_pip import qos
from ros2_on_pip.discovery import DirectNode

NOT_GIVEN = argparse.Namespace(
    qos_profile=None,
    qos_depth=None,
    qos_liveliness_lease_duration_seconds=None,
    **{f"qos_{policy}": None for policy in qos.POLICIES},
)
"""The options of `ros2 topic hz`, where nobody gives one."""


class DeskNode(DirectNode):
    """A look that goes on as long as the desk is open."""

    def soon(self, act: Callable[[], None]) -> None:
        """Run `act` in the thread that spins, between two callbacks; any thread may ask for it."""
        self._executor.create_task(act)


def heard_from_all(publishers: Sequence[Any]) -> Any:
    """A QoSProfile by which every one of `publishers` is heard, as `ros2 topic hz` asks for it.

    Where all of them keep what they said, it asks for that, too.
    """
    return qos.matching(NOT_GIVEN, publishers)
