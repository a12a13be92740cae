"""Quality of service in time: deadlines, lifespans, liveliness, and two computers."""

from roslings.capability import Capability

CAPABILITY = Capability("qos", words="roslings.capabilities.qos.contract:WORDS")
