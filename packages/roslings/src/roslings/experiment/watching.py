"""An experiment watches topics, until a rate is sure or a bound is met."""

from __future__ import annotations

import functools

from roslings.course import TopicContract
from roslings.evidence import Endpoint
from roslings.experiment.missed import no_timer_makes, no_timer_says, publishes, says
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S, WallWatch
from roslings.experiment.presence import GRACE_S
from roslings.experiment.simulated import (
    NotBelieved,
    SaysNothing,
    SimulatedWatch,
    followed_clock,
    let_pass,
)
from roslings.experiment.stage import Stage
from roslings.probe.recorder import can_record
from roslings.seen.matching import nearest_endpoint

CONNECTS_WITHIN_S = 3.0
ENDED = "it ended by itself there"
FIRST_PERIODS = 3
"""So many periods of its rate may pass before a complete node speaks for the first time."""
SILENT_PERIODS = 10
"""Who says nothing for so many periods in real time is silent, and not only slow or in groups.

Of whom many periods of robot time went by in silence, QUIET_PERIODS of real time tell the rest. No
timer of it speaks, so only a thread of its own could.
"""
QUIET_PERIODS = 2.5
TIMERS_MAKE_WITHIN_S, THREADS_MAKE_WITHIN_S = 2.0, 0.5
"""For a publisher that a complete node has not got: of robot time, then of real time."""


class Watching(Stage):
    """Watches what nodes say, by simulated time where that is believed."""

    def watch(self, contract: TopicContract) -> None:
        """Watch a topic, or the one nearest to it, until its rate is sure or the bound is met."""
        with self._timed_watching():
            if self._simulated:
                self._watch_simulated(contract)
            else:
                self._watch_on_the_wall(contract)

    def _watch_simulated(self, contract: TopicContract) -> None:
        """In two stretches of simulated time; what speaks against believing it is written down."""
        try:
            topic = self._publisher_in_time(contract).topic
            with (
                self._turns.busy(),
                followed_clock(self._probe, self.seen.graph.nodes) as (clock, barrier),
            ):
                barrier.lives = self._arena.all_alive
                SimulatedWatch(self._probe, clock, barrier, topic, contract.rate).watch()
            if not self._arena.all_alive():
                raise NotBelieved(ENDED)
        except NotBelieved as reason:
            self.seen.not_believed = str(reason) if self._arena.all_alive() else ENDED
            if isinstance(reason, SaysNothing):
                self._presence.note_for_good(no_timer_says(contract))

    def _publisher_in_time(self, contract: TopicContract) -> Endpoint:
        self._until_there(lambda: self._publisher(contract) is not None, publishes(contract))
        publisher = self._publisher(contract)
        if publisher is None:
            self._let_time_go_by(contract)
            raise NotBelieved("it publishes nothing")
        if can_record(publisher):
            self._until_connected(publisher)
        return publisher

    def _until_connected(self, publisher: Endpoint) -> None:
        """What was said before would be missed. Raises NotBelieved."""
        topic = publisher.topic
        if not self._until_alive(lambda: self._probe.connected(topic), CONNECTS_WITHIN_S):
            raise NotBelieved(f"no connection to its publisher on {topic} came up")

    def _let_time_go_by(self, contract: TopicContract) -> None:
        """What no timer has made in some seconds of robot time, only a thread could still make."""
        with (
            self._turns.busy(),
            followed_clock(self._probe, self.seen.graph.nodes) as (clock, barrier),
        ):
            barrier.lives = self._arena.all_alive
            let_pass(clock, barrier, TIMERS_MAKE_WITHIN_S)
            self._probe.look_now()
        if self._publisher(contract) is None:
            self._presence.note_for_good(no_timer_makes(contract))

    def _watch_on_the_wall(self, contract: TopicContract) -> None:
        if contract.rate:
            find = functools.partial(self._publisher, contract)
            quiet = self.is_missed(no_timer_says(contract))
            grace_s = (QUIET_PERIODS if quiet else SILENT_PERIODS) / contract.rate.hz
            WallWatch(
                self._probe,
                self._arena,
                contract.rate,
                find,
                self._until_alive,
                lambda: self._until_heard(contract, grace_s=grace_s),
                self._turns,
            ).watch()
        else:
            self.hear(contract)

    def joined(self, contract: TopicContract) -> None:
        """Wait until a publisher and a subscription of the topic are both in the graph."""

        def both() -> bool:
            kinds = {e.kind for e in self.seen.graph.endpoints if e.topic == contract.topic}
            return len(kinds) == 2

        with self._timed_watching():
            self._until_there(both, f"both sides of {contract.topic}")

    def hear(self, contract: TopicContract, count: int = 1, grace_s: float = GRACE_S) -> bool:
        """Wait for the first messages on a topic, or the one nearest to it, as `appears` does."""
        with self._timed_watching():
            return self._until_heard(contract, count, grace_s)

    def _until_heard(
        self, contract: TopicContract, count: int = 1, grace_s: float = GRACE_S
    ) -> bool:
        """First its publisher, then the connection to it, then what it says."""
        missed = self.is_missed(no_timer_makes(contract))
        self._until_there(
            lambda: self._publisher(contract) is not None,
            publishes(contract),
            THREADS_MAKE_WITHIN_S if missed else GRACE_S,
        )
        publisher = self._publisher(contract)
        if publisher is None:
            self._presence.note(says(contract), came=False)
            return False
        self._until_alive(
            lambda: self._probe.connected(publisher.topic) or not can_record(publisher),
            FIRST_MESSAGE_WITHIN_S,
        )
        limit = contract.rate
        periods_s = FIRST_PERIODS / limit.hz if limit else 0.0
        return self._until_there(
            lambda: self.heard(contract) >= count, says(contract), max(grace_s, periods_s)
        )

    def heard(self, contract: TopicContract) -> int:
        """How many messages came on a topic so far, or on the one nearest to it."""
        publisher = self._publisher(contract)
        return self._probe.count(publisher.topic) if publisher else 0

    def _publisher(self, contract: TopicContract) -> Endpoint | None:
        return nearest_endpoint(self.seen.graph, "publisher", contract.topic, contract.type)
