"""Launch files: several nodes started by one command."""

from roslings.capability import Capability
from roslings.record import PartSeen

CAPABILITY: Capability[PartSeen] = Capability(
    "launch",
    words="roslings.capabilities.launch.contract:WORDS",
)
