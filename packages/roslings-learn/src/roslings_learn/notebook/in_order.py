"""Answers of action servers that come sooner than rclpy is ready for them.

`send_goal_async` sends, and notes after that what it waits for. In a session another thread takes
the answers: one that comes in between is thrown away ("Ignoring unexpected goal response"), and
the future never ends. Seen in rclpy 7.1.6, `rclpy/action/client.py`, on a busy computer.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable
from typing import Any

SENDING = ("send_goal_async", "_cancel_goal_async", "_get_result_async")
MARK = "_roslings_in_order"
_sending = threading.RLock()


def wait_while_sending() -> None:
    """From now on, in this process, an answer waits until its question is noted."""
    from rclpy.action import ActionClient

    if not hasattr(ActionClient, MARK):
        for name in SENDING:
            setattr(ActionClient, name, _as_one_step(getattr(ActionClient, name)))
        ActionClient.execute = _after_sending(ActionClient.execute)
        setattr(ActionClient, MARK, True)


def _as_one_step(send: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(send)
    def sent(*given: Any, **named: Any) -> Any:
        with _sending:
            return send(*given, **named)

    return sent


def _after_sending(execute: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(execute)
    async def executed(*given: Any) -> Any:
        with _sending:
            pass
        return await execute(*given)

    return executed
