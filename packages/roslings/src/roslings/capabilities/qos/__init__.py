"""Quality of service: deadlines, lifespans, liveliness; what is kept for those who come late."""

from typing import Any

from roslings.capabilities.qos.record import QosSeen
from roslings.capability import Capability


def _only_joins(part: dict[str, Any]) -> dict[str, Any]:
    """From version 1 to 2: what was seen of a button and a guard is a part of its own."""
    return {"joins": part.get("joins", [])}


CAPABILITY = Capability(
    "qos",
    QosSeen,
    upgrade={1: _only_joins},
    words="roslings.capabilities.qos.contract:WORDS",
    sections="roslings.capabilities.qos.report:sections",
)
