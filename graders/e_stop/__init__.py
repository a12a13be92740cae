"""A latched button, and a guard that stands between an operator and the motors."""

from graders.e_stop.record import EStopSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "e_stop",
    EStopSeen,
    formerly={("qos", 1): ("drives", "stops", "presses", "moves", "sent_ns", "hosts")},
    words="graders.e_stop.contract:WORDS",
    sections="graders.e_stop.report:sections",
)
