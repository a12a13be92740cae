"""Which cases of a test file were asked for: what is dear is made for these alone, in one go."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

MADE_FOR_ALL = pytest.mark.timeout(3600)
"""For tests of which the first makes, in one go, what all that were asked for look at.

It may take what all of them may take, and those that wait for it, too. Other tests have the limit
of `pyproject.toml`.
"""


def asked_for(
    request: pytest.FixtureRequest, file: str
) -> Iterator[tuple[pytest.Item, Mapping[str, Any]]]:
    """The parametrised tests of this run that stand in `file`, and their parameters.

    Parameters of one name mean other things in other files.
    """
    for item in request.session.items:
        words = getattr(item, "callspec", None)
        if words and item.path == Path(file):
            yield item, words.params
