"""YAML that a student has written: what it means never grows far beyond what stands there.

An alias (`*a`) is one more name of the same thing, and takes nothing. A merge (`<<`) copies: a few
lines that merge each other twice make more keys than any memory holds.
"""

from __future__ import annotations

from typing import Any

import yaml

MERGE = "<<"


class PlainLoader(yaml.SafeLoader):
    """Reads what YAML's own safe loader reads, but for merges."""

    def flatten_mapping(self, node: yaml.MappingNode) -> None:
        """Called before a mapping is made. Raises ConstructorError."""
        for key, _ in node.value:
            if key.tag == "tag:yaml.org,2002:merge":
                problem = f"the key {MERGE} copies another mapping; write its lines here"
                raise yaml.constructor.ConstructorError(None, None, problem, key.start_mark)


def load(text: str | bytes) -> Any:
    """What the text says. Raises yaml.YAMLError, ValueError, RecursionError."""
    try:
        return yaml.load(text, Loader=PlainLoader)
    except (AttributeError, LookupError, TypeError) as error:  # `!!bool x`, `!!int ''`
        problem = "a value is not of the kind that its tag says"
        raise yaml.constructor.ConstructorError(None, None, problem) from error
