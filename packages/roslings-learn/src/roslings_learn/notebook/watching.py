"""Messages below a cell, as they come."""

from __future__ import annotations

import sys
from typing import Any

from roslings_learn.notebook.session import USUALLY_S, any_session


def watch_topic(
    topic: str, kind: Any = None, *, count: int = 5, timeout_s: float = USUALLY_S
) -> None:
    """Print `count` messages of `topic` as they come, as `ros2 topic echo` does.

    Before each stands its number and its time in seconds after the first. Raises NothingHeard.
    """
    first_s: float | None = None
    with any_session() as ros:
        heard = ros.hear(topic, kind, count=count, timeout_s=timeout_s)
        for number, each in enumerate(heard, 1):
            first_s = each.sent_s if first_s is None else first_s
            told = _told(number, each.sent_s - first_s, each.message)
            sys.stdout.write(f"{told}\n")  # in one piece: log lines come between
            sys.stdout.flush()


def _told(number: int, after_s: float, message: Any) -> str:
    from ros2_on_pip.yaml_out import YamlOptions, as_yaml

    lines = as_yaml(message, YamlOptions()).rstrip().splitlines()
    head = f"{number:3}  {after_s:7.3f} s  "
    if len(lines) == 1:
        return head + lines[0]
    return "\n".join([head.rstrip(), *(f"     {line}" for line in lines)])
