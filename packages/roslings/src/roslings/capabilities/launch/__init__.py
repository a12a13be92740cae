"""Launch files: several nodes started by one command."""

from roslings.capabilities.launch.record import LaunchSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "launch",
    LaunchSeen,
    words="roslings.capabilities.launch.contract:WORDS",
    sections="roslings.capabilities.launch.report:sections",
)
