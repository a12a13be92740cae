"""Experiments with values: tell a node something, and let it show what it makes of it."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

from roslings.arena import Process
from roslings.capabilities.topics.record import TOLD
from roslings.course import TopicContract
from roslings.evidence import Endpoint, Spoken, StageMark
from roslings.experiment.missed import hears, publishes
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.scene import Scene
from roslings.seen.matching import nearest_endpoint

TURNS_WITHIN_S = 3.0
SHOWS_WITHIN_S = 1.5
SILENT_TIMES, SILENT_WITHIN_S = 2, 0.3
"""A node whose callbacks ran and that showed nothing so often, will hardly show something now."""

BY_A_TIMER = 3
"""Messages to wait for: the first one may have been under way before the value was heard."""


class Teller:
    """Tells a node values on the topic that it hears, and watches the one that it publishes.

    Where the node uses names that are near to the card's, those are used.
    """

    def __init__(
        self, scene: Scene, process: Process, heard: TopicContract, shown: TopicContract
    ) -> None:
        self._scene, self._process = scene, process
        self._heard, self._shown = heard, shown
        self._is_heard = self._stuck = False
        self._silent = 0
        scene.appears(lambda: self._subscription() is not None, hears(heard))

    def _make_heard(self, fields: Mapping[str, object], way: Callable[..., None]) -> None:
        """Tell the first value once before it counts.

        We see that we are joined with the node a little before the node sees it: what is said in
        between is lost.
        """
        if not self._is_heard:
            self._is_heard = True
            self._scene.seen.stages.append(StageMark(part=TOLD, at_ns=time.monotonic_ns()))
            told = len(self._scene.seen.spoken)
            way(fields)
            del self._scene.seen.spoken[told:]

    def tell(self, fields: Mapping[str, object]) -> None:
        """Say one message, and wait for the one that the node publishes when it hears it.

        Where none comes, wait until the node had its chance: its callbacks ran.
        """
        self._make_heard(fields, self.tell)
        before = self._count()
        spoken = self._say(fields)
        if spoken and not self._shows(before + 1):
            turned = self._turns()
            spoken.settled = self._shows(before + 1) or turned

    def tell_and_await_timer(self, fields: Mapping[str, object]) -> None:
        """Say one message, and wait until a timer of the node has published after it."""
        self._make_heard(fields, self.tell_and_await_timer)
        spoken = self._say(fields)
        if spoken:
            turned = self._turns()
            spoken.settled = self._shows(self._count() + BY_A_TIMER) and turned

    def rest(self, for_s: float) -> None:
        """Say nothing for so long, by the node's own time."""
        self._scene.until_own(lambda: False, for_s)

    def _say(self, fields: Mapping[str, object]) -> Spoken | None:
        """Say it; None where nobody is there to hear it."""
        subscription = self._subscription()
        if subscription is None or not self._process.alive:
            return None
        return self._scene.probe.say(subscription, nested(fields), FIRST_MESSAGE_WITHIN_S)

    def _turns(self) -> bool:
        """Wait until the node's callbacks have run. Whether they did; asked once where not."""
        subscription = self._subscription()
        if subscription is None or not self._process.alive or self._stuck:
            return False
        self._stuck = not self._scene.turned(subscription.node, TURNS_WITHIN_S)
        return not self._stuck

    def _shows(self, count: int) -> bool:
        """Wait for so many messages; a node that never showed any is soon waited for less.

        One that shows some is always told its values in the same pace: that is judged, too.
        """
        within_s = SILENT_WITHIN_S if self._known_as_silent() else SHOWS_WITHIN_S
        shown = self._scene.until_own(lambda: self._count() >= count, within_s)
        self._silent = 0 if shown else self._silent + 1
        return shown

    def _known_as_silent(self) -> bool:
        """It has said nothing where it could, or has no publisher, as an experiment has found."""
        if self._publisher() is None and self._scene.is_missed(publishes(self._shown)):
            return True
        return self._silent >= SILENT_TIMES and not self._count()

    def _subscription(self) -> Endpoint | None:
        return nearest_endpoint(
            self._scene.seen.graph, "subscription", self._heard.topic, self._heard.type
        )

    def _count(self) -> int:
        publisher = self._publisher()
        return self._scene.probe.count(publisher.topic) if publisher else 0

    def _publisher(self) -> Endpoint | None:
        return nearest_endpoint(
            self._scene.seen.graph, "publisher", self._shown.topic, self._shown.type
        )


def nested(fields: Mapping[str, object]) -> dict[str, Any]:
    """Fields with dots in their names as fields in fields.

    >>> nested({"header.frame_id": "sonar", "range": 1.0})
    {'header': {'frame_id': 'sonar'}, 'range': 1.0}
    """
    tree: dict[str, Any] = {}
    for name, value in fields.items():
        *way, last = name.split(".")
        place = tree
        for step in way:
            place = place.setdefault(step, {})
        place[last] = value
    return tree
