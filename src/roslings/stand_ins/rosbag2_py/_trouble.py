"""What goes wrong is a RuntimeError, as in the compiled module."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from roslings.rosbag2.trouble import BagTrouble, reason_of


@contextmanager
def as_runtime_error() -> Iterator[None]:
    """Turn a trouble with a bag in the block into a RuntimeError."""
    try:
        yield
    except BagTrouble as trouble:
        raise RuntimeError(str(trouble)) from trouble
    except (OSError, KeyError, TypeError, ValueError) as fault:
        raise RuntimeError(f"the bag's metadata cannot be used: {reason_of(fault)}") from fault
