"""Topics: what messages say, how often they come, and what a node makes of them."""

from roslings.capability import Capability
from roslings.record import PartSeen

CAPABILITY: Capability[PartSeen] = Capability("topics")
