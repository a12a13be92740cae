"""Services: one node asks, another answers."""

from roslings.capabilities.services.record import ServicesSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "services",
    ServicesSeen,
    in_schema_1={"services": "ends", "calls": "calls", "served": "served"},
    words="roslings.capabilities.services.contract:WORDS",
    sections="roslings.capabilities.services.report:sections",
)
