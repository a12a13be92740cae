"""Walks through a model of a program: drawn by a seed, followed step by step, compared."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from random import Random
from typing import Any, Protocol, TypeVar

Event = TypeVar("Event", bound=Hashable)
Model = TypeVar("Model", bound="WalkModel[Any]")
Shown = TypeVar("Shown")
NEW_STATE_WEIGHT = 3
"""An event that changes what the program must do is drawn so much more often than another."""


class WalkModel(Protocol[Event]):
    """What a program with a state must do, in one of its states. It never changes."""

    def possible(self) -> Sequence[Event]:
        """The events that can happen now, in an order of their own."""

    def after(self: Model, event: Event) -> Model:
        """The state that follows; `event` is a possible one."""


class Impossible(ValueError):
    """A walk has an event that cannot happen where it stands."""


def states_on(model: Model, events: Sequence[Event]) -> Iterator[Model]:
    """The state after each event. Raises Impossible.

    >>> [state.drives for state in states_on(GuardModel(), [Happens.JOIN, Happens.RELEASE])]
    [False, False]
    """
    for number, event in enumerate(events, 1):
        if event not in model.possible():
            raise Impossible(f"event {number}, {event}, is not possible there")
        model = model.after(event)
        yield model


def drawn_walk(model: Model, random: Random, steps: int) -> list[Any]:
    """So many events from this state on. An event that leads to another state is the likelier."""
    events: list[Any] = []
    for _ in range(steps):
        possible = model.possible()
        weights = [NEW_STATE_WEIGHT if model.after(each) != model else 1 for each in possible]
        (event,) = random.choices(possible, weights)
        events.append(event)
        model = model.after(event)
    return events


def first_difference(
    model: Model, other: Model, events: Sequence[Event], shows: Callable[[Any], Shown]
) -> int | None:
    """How many events it takes until the two show different things; None: they never do.

    What the program must do is told by `shows`. `other` may be a model of a mistake: it is not
    asked what is possible.
    """
    for number, (event, state) in enumerate(zip(events, states_on(model, events), strict=True), 1):
        other = other.after(event)
        if shows(state) != shows(other):
            return number
    return None
