"""Which topics are meant: by name, by type, by a regular expression, and all but some."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from ros2_on_pip.rosbag2.errors import BagError


class BadExpression(BagError):
    """A regular expression that is none."""

    def __init__(self, text: str, why: str) -> None:
        super().__init__(
            f"'{text}' is no regular expression: {why}."
            " Put it in quotes, and write .* for any letters: -e '/camera/.*'"
        )


@dataclass(frozen=True)
class TopicFilter:
    """What is asked for, and what is left out of it. With nothing asked for, all are meant."""

    names: Sequence[str] = ()
    types: Sequence[str] = ()
    regex: str = ""
    without: Sequence[str] = ()
    without_types: Sequence[str] = ()
    without_regex: str = ""
    whole_names: bool = False
    """Whether an expression must match a whole name, as when a bag is read, and not a part of it,
    as when one is recorded."""

    def __post_init__(self) -> None:
        """Raises BadExpression."""
        for text in (self.regex, self.without_regex):
            try:
                re.compile(text)
            except re.error as fault:
                raise BadExpression(text, str(fault)) from fault

    def takes(self, name: str, type_name: str) -> bool:
        """Whether a topic is meant."""
        return self._asked(name, type_name) and not self._left_out(name, type_name)

    def _asked(self, name: str, type_name: str) -> bool:
        if not (self.names or self.types or self.regex):
            return True
        found = self._matches(self.regex, name)
        return found or name in self.names or type_name in self.types

    def _left_out(self, name: str, type_name: str) -> bool:
        found = self._matches(self.without_regex, name)
        return found or name in self.without or type_name in self.without_types

    def _matches(self, regex: str, name: str) -> bool:
        find = re.fullmatch if self.whole_names else re.search
        return bool(regex and find(regex, name))
