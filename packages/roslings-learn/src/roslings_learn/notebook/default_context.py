"""The context that nodes take when they name none: as long as a session is open, the session's.

A node of a beginner says `super().__init__("talker")`, and rclpy then asks for the process's one
default context. `rclpy` has no public way to set it: its variable is the only one.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


@contextmanager
def as_default(context: Any) -> Iterator[None]:
    """Until the block ends, `context` is rclpy's default one."""
    from rclpy import utilities

    with utilities.g_context_lock:
        before, utilities.g_default_context = utilities.g_default_context, context
    try:
        yield
    finally:
        with utilities.g_context_lock:
            utilities.g_default_context = before
