"""An experiment speaks to nodes, and waits for what they make of it."""

from __future__ import annotations

from roslings.arena import Process
from roslings.course import TopicContract
from roslings.evidence import Endpoint
from roslings.experiment.missed import hears
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.sentences import sentence_by
from roslings.experiment.stage import Stage
from roslings.seen.matching import nearest_endpoint

HEARD_WITHIN_S = 10.0
AFTER_THE_TURN_S = 1.0
MOST_MISSED = 2


class Speaking(Stage):
    """Says what nobody can know before."""

    def say_sentences(self, listener: Process, contract: TopicContract, count: int) -> None:
        """Say random sentences on a topic, or on the one nearest to it, and wait for each echo.

        Two that are not repeated are enough: who says nothing is not told all of them.
        """
        subscription, missed = self._subscription_to(contract), 0
        for _ in range(count if subscription else 0):
            assert subscription is not None
            missed += not self._tell(listener, subscription, self.sentence())
            if missed >= MOST_MISSED or not listener.alive:
                return

    def _subscription_to(self, contract: TopicContract) -> Endpoint | None:
        """The subscription to a topic, or to the one nearest to it; None where there is none."""

        def find() -> Endpoint | None:
            return nearest_endpoint(self.seen.graph, "subscription", contract.topic, contract.type)

        self._until_there(lambda: find() is not None, hears(contract))
        return find()

    def _tell(self, process: Process, subscription: Endpoint, text: str) -> bool:
        """Say `text` to a listener and wait until it repeats it, or had its chance to."""
        with self._timed_watching():
            self._probe.say(subscription, {"data": text}, FIRST_MESSAGE_WITHIN_S)

            def repeated() -> bool:
                return not process.alive or self.is_written(process, text)

            if not self._probe.until(repeated, AFTER_THE_TURN_S):
                turned = self._probe.turned(subscription.node, HEARD_WITHIN_S)
                self._probe.until(repeated, AFTER_THE_TURN_S if turned else HEARD_WITHIN_S)
            return self.is_written(process, text)

    def sentence(self) -> str:
        """A sentence that nobody can know before it is said."""
        return sentence_by(self._random)

    def between(self, low: float, high: float) -> float:
        """A number that nobody can know before, to the third digit after the point."""
        return round(self._random.uniform(low, high), 3)
