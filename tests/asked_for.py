"""Which cases of a test file were asked for: what is dear is made for these alone, in one go."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest


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
