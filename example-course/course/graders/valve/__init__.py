"""Lifecycle: managed nodes, whose states others change."""

from graders.valve.record import LifecycleSeen

from roslings.capability import Capability

CAPABILITY = Capability(
    "lifecycle",
    LifecycleSeen,
    words="graders.valve.contract:WORDS",
    sections="graders.valve.report:sections",
)
