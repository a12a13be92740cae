"""What goes wrong is a RuntimeError, as in the compiled module."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from roslings.rosbag2.errors import BagError, reason_of


@contextmanager
def as_runtime_error() -> Iterator[None]:
    """Turn an error about a bag in the block into a RuntimeError."""
    try:
        yield
    except BagError as error:
        raise RuntimeError(str(error)) from error
    except (OSError, KeyError, TypeError, ValueError) as fault:
        raise RuntimeError(f"the bag's metadata cannot be used: {reason_of(fault)}") from fault
