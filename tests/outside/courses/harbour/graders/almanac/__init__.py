"""A harbour's wind: it is blown beside the node, which must warn of gales."""

from graders.almanac.record import WindSeen

from roslings.capability import Capability

CAPABILITY = Capability("almanac", WindSeen, words="graders.almanac.contract:WORDS")
