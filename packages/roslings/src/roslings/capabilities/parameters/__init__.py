"""Parameters: settings of a node, given at its start or while it runs."""

from roslings.capabilities.parameters.record import ParametersSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "parameters",
    ParametersSeen,
    in_schema_1={"parameters": "names", "declared": "declared", "parameter_sets": "sets"},
    words="roslings.capabilities.parameters.contract:WORDS",
    sections="roslings.capabilities.parameters.report:sections",
)
