"""Quality of service in time: deadlines, lifespans, liveliness; and nodes on two computers."""

from roslings.capabilities.qos.record import QosSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "qos",
    QosSeen,
    words="roslings.capabilities.qos.contract:WORDS",
    sections="roslings.capabilities.qos.report:sections",
)
