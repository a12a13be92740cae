"""Actions: goals that take a while, with feedback, and can be cancelled."""

from roslings.capabilities.actions.record import ActionsSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "actions",
    ActionsSeen,
    in_schema_1={"actions": "ends", "goals": "goals", "orders": "orders"},
    words="roslings.capabilities.actions.contract:WORDS",
    sections="roslings.capabilities.actions.report:sections",
)
