"""What is typed behind a tab's name: that tab shows it at once."""

from __future__ import annotations

from collections.abc import Sequence

TAKE_WORDS = {
    "image": "TOPIC",
    "parameters": "NODE",
    "plot": "TOPIC/FIELD ..., for example /odom/twist/twist/linear/x",
    "topics": "TOPIC",
}
"""The tabs that take words, and what these are."""


def topic_of(shown: Sequence[str]) -> str:
    """The first word as the full name of a topic or a node; empty where there is none."""
    return f"/{shown[0].lstrip('/')}" if shown else ""
