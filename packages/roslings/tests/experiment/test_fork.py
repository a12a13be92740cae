"""The measuring process as a fork: its errors are told, and it ends with whoever waits for it."""

from __future__ import annotations

from multiprocessing import active_children
from pathlib import Path

import pytest

from roslings.course import lab
from roslings.experiment import MeasuringFailed, MeasuringOptions, measure
from roslings.experiment.preload import load_beforehand
from roslings.workspace.inspect import inspect_package

TOPICS = lab("topics")
SEEN = inspect_package(TOPICS.solution, TOPICS.card)
CHOICES = MeasuringOptions(seed=1)


class EnoughError(Exception):
    """Whoever waits has seen enough."""


def test_its_last_words_are_told() -> None:
    """An error of ours in there is no evidence, and is not lost."""
    with pytest.raises(MeasuringFailed, match="There is no lab 'tropics'"):
        measure("tropics", TOPICS.solution, SEEN, CHOICES, lambda step: None)
    assert not active_children()


def test_it_ends_with_whoever_waits() -> None:
    """In the middle of a build too."""
    steps: list[str] = []

    def stop(step: str) -> None:
        steps.append(step)
        raise EnoughError

    with pytest.raises(EnoughError):
        measure("topics", TOPICS.solution, SEEN, CHOICES, stop)
    assert steps == ["Building chatter with colcon"]
    assert not active_children()


def test_what_cannot_be_loaded_beforehand_is_left_to_the_grading() -> None:
    """The process that all are forked from must live."""
    load_beforehand("tropics")
    load_beforehand("topics", Path("no such file"))
