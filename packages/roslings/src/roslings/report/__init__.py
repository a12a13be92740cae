"""One verdict in, many shapes out: terminal, JSON, HTML; the ROS graph as a PNG.

Nothing here knows how a verdict was measured. rich, pydantic and matplotlib are imported when a
name is first used, so that `./roslings --help` stays quick.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from roslings.report.check50 import write_check50
    from roslings.report.classroom import write_classroom
    from roslings.report.evidence_file import BadEvidence, read_evidence
    from roslings.report.evidence_folder import CannotKeepThere
    from roslings.report.gradescope import write_gradescope
    from roslings.report.graph_picture import draw_graph
    from roslings.report.json_file import BadVerdictFile, read_json, write_json
    from roslings.report.junit import write_junit
    from roslings.report.prairielearn import write_prairielearn
    from roslings.report.progress import Progress
    from roslings.report.refusal import Refusal
    from roslings.report.terminal import NoSuchCheck, print_verdict
    from roslings.report.vpl import write_vpl
    from roslings.report.whole_file import CannotWrite

__all__ = [
    "BadEvidence",
    "BadVerdictFile",
    "CannotKeepThere",
    "CannotWrite",
    "NoSuchCheck",
    "Progress",
    "Refusal",
    "draw_graph",
    "print_verdict",
    "read_evidence",
    "read_json",
    "write_check50",
    "write_classroom",
    "write_gradescope",
    "write_json",
    "write_junit",
    "write_prairielearn",
    "write_vpl",
]

_HOMES = {
    "BadEvidence": "evidence_file",
    "CannotKeepThere": "evidence_folder",
    "read_evidence": "evidence_file",
    "BadVerdictFile": "json_file",
    "CannotWrite": "whole_file",
    "NoSuchCheck": "terminal",
    "Progress": "progress",
    "Refusal": "refusal",
    "draw_graph": "graph_picture",
    "print_verdict": "terminal",
    "read_json": "json_file",
    "write_check50": "check50",
    "write_classroom": "classroom",
    "write_gradescope": "gradescope",
    "write_json": "json_file",
    "write_junit": "junit",
    "write_prairielearn": "prairielearn",
    "write_vpl": "vpl",
}


def __getattr__(name: str) -> Any:
    """Import the module that holds `name` when it is first asked for (PEP 562)."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
