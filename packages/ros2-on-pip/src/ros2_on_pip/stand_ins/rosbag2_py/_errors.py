"""What goes wrong is a RuntimeError, as in the compiled module."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2_on_pip.rosbag2.errors import BagError, NoPath, reason_of


@contextmanager
def as_runtime_error() -> Iterator[None]:
    """Turn an error about a bag in the block into a RuntimeError."""
    try:
        yield
    except BagError as error:
        raise RuntimeError(str(error)) from error
    except (OSError, KeyError, TypeError, ValueError) as fault:
        raise RuntimeError(f"the bag's metadata cannot be used: {reason_of(fault)}") from fault


def path_of(uri: str) -> Path:
    """Where a bag lies. Raises NoPath for an empty text, which Path takes for the folder here."""
    if not uri:
        raise NoPath
    return Path(uri)


def require_text(value: object, what: str) -> None:
    """The compiled module takes no Path and no None for a text. Raises TypeError."""
    if not isinstance(value, str):
        raise TypeError(f"{what} must be str, and is {type(value).__name__}")
