"""An experiment as a test wants it seen, the fields of capabilities among its own."""

from __future__ import annotations

from typing import Any

from roslings.capability import capabilities
from roslings.evidence import ExperimentSeen


def seen_with(**fields: Any) -> ExperimentSeen:
    """An experiment; fields of parts have the names that they had in evidence of schema 1.

    >>> seen_with(name="asking", clock="wall", calls=[call]).part(ServicesSeen).calls
    """
    parts = {}
    for each in capabilities():
        found = {new: fields.pop(old) for old, new in each.in_schema_1.items() if old in fields}
        if found and each.seen:
            parts[each.name] = each.seen(**found)
    return ExperimentSeen(**fields, parts=parts)
