"""Lifecycle: managed nodes, whose states others change."""

from roslings.capability import Capability
from valve_course.lifecycle.record import LifecycleSeen

CAPABILITY = Capability(
    "lifecycle",
    LifecycleSeen,
    words="valve_course.lifecycle.contract:WORDS",
    sections="valve_course.lifecycle.report:sections",
)
