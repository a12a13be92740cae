"""Evidence that is kept with the course: no word of the machine that measured it, nothing to spare.

Such words come from several places. Folders of a grading are in what colcon, `ros2 launch`,
Python's tracebacks and the nodes themselves write. They are also in what nodes are given (bags,
devices, parameter files). The course's folder and Python's own are in tracebacks. The kernel's
release is in `machine`. A computer's name is in the log folder that a launch tells of, where no
namespace hides it. Each is replaced by one word everywhere, so that what belongs together still
does.
"""

from __future__ import annotations

import json
import re
import socket
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from roslings import course
from roslings.evidence import Evidence, evidence_json, read_json

Replacement = tuple[str, str]
"""A pattern, and what stands in its place."""
IN_A_NAME = r"[\w.-]"


def without_machine(evidence: Evidence) -> Evidence:
    """The same evidence, as if it had been measured on no machine in particular."""
    text = evidence_json(evidence).decode()
    for pattern, word in replacements():
        text = re.sub(pattern, word, text)
    anywhere = read_json(text.encode())
    anywhere.machine.platform = anywhere.machine.platform.partition(" ")[0]
    return anywhere


TIMES = frozenset({"source_ns", "arrival_ns", "sent_ns", "at_ns"})
"""When something was said, heard, or was somewhere. What an experiment began or a stamp says is
compared with equal ones, and stays as it is."""
FINEST_NS = 10_000
"""No card asks for less than a millisecond. Finer digits are noise, and a third of all bytes."""


def for_judging(evidence: Evidence) -> Evidence:
    """The same evidence without what only a page shows, and with times to 10 microseconds."""
    kept = read_json(json.dumps(coarse(json.loads(evidence_json(evidence)))).encode())
    kept.timeline = []
    for part in [part for seen in kept.runs for part in seen.parts.values()]:
        for name in part.FOR_READERS:
            setattr(
                part, name, type(part).model_fields[name].get_default(call_default_factory=True)
            )
    return kept


def coarse(said: Any, name: str = "") -> Any:
    """The same, with times rounded down: which of two came first stays as it was."""
    if isinstance(said, dict):
        return {key: coarse(each, key) for key, each in said.items()}
    if isinstance(said, list):
        return [coarse(each, name) for each in said]
    return said // FINEST_NS * FINEST_NS if name in TIMES and isinstance(said, int) else said


def replacements() -> Iterator[Replacement]:
    """The longest folders first: one lies in the other."""
    yield (
        r"/(?:[\w.-]+/)*roslings-(?:user-)?\d+-\w+(?=/)",
        "/grading",
    )  # arena's folder, wherever it lies
    yield r"(?<=/grading/devices/)tmp\w+", "it"
    folders = {
        str(course.root()): "/course",
        sys.prefix: "/venv",
        sys.base_prefix: "/python",
        str(Path.home()): "/home",
    }
    for folder in sorted(filter(_is_a_place, folders), key=len, reverse=True):
        yield rf"{re.escape(folder)}(?!{IN_A_NAME})", folders[folder]
    yield rf"(?<=\d-){re.escape(socket.gethostname())}(?=-\d)", "computer"


def _is_a_place(folder: str) -> bool:
    """Not / and not /usr: those are everywhere."""
    return len(Path(folder).parts) > 2 or folder == "/root"
