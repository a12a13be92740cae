"""Trouble of the middleware itself, which is nobody's mistake in a package.

It was seen once in some thousand gradings, without a wall and at load 13. Fast DDS could not lock
the shared memory of a port that another grading had just left (`[RTPS_TRANSPORT_SHM Error] Failed
init_port ... open_and_lock_file failed`). Its node then ran, and nobody could see it.
"""

from __future__ import annotations

import re

from roslings.evidence import ExperimentSeen

TRANSPORT_ERROR = re.compile(r"\[RTPS_TRANSPORT\w* Error\]")


def note_a_deaf_node(seen: ExperimentSeen) -> None:
    """A run in which no node was seen, and the middleware said why, tells nothing of the nodes."""
    if seen.graph.nodes or not _complained(seen):
        return
    why = "the middleware could not open a port on this computer, so your node could not be seen"
    if seen.clock == "sim":
        seen.not_believed = seen.not_believed or why
    else:
        seen.machine_fault = seen.machine_fault or why


def _complained(seen: ExperimentSeen) -> bool:
    return any(
        TRANSPORT_ERROR.search(line.text)
        for process in seen.processes.values()
        for line in process.lines
    )
