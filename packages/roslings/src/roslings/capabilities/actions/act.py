"""Experiments with actions: wait for them, time their feedback, be a server of them."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Literal

from ros2_on_pip.rates import measure_rate
from roslings.arena import Process
from roslings.capabilities.actions.contract import ActionContract
from roslings.capabilities.actions.goals import GoalTaker, read_actions
from roslings.capabilities.actions.record import ActionsSeen
from roslings.capabilities.services.act import TURNS_WITHIN_S, await_end
from roslings.course import NodeContract, RateContract
from roslings.course.contract import Plain
from roslings.experiment.on_the_wall import CANARY_WITHIN_S, longest_wait_s, singing, trouble
from roslings.experiment.scene import Scene
from roslings.seen.rates import own_rate

SENDS_WITHIN_S = 6.0
SHOWS_WITHIN_S, SHOWS_MORE_WITHIN_S = 3.0, 1.0
"""For a feedback, and for the next ones when one was not shown."""


def await_action(scene: Scene) -> None:
    """Wait until a node performs an action; the fullest sight is kept, as of the graph."""

    def there() -> bool:
        ends = read_actions(scene.probe.node, scene.seen.graph.nodes)
        if len(ends) >= len(scene.seen.part(ActionsSeen).ends):
            scene.seen.recording(ActionsSeen).ends = ends
        return any(end.kind == "server" for end in ends)

    scene.appears(there, "an action")


@contextmanager
def timed_feedback(scene: Scene, action: ActionContract) -> Iterator[None]:
    """A canary runs beside while the block lasts: it tells whether a rate can be believed."""
    limit, seen = action.feedback, scene.seen
    assert limit is not None, f"the card says no rate for {action.action}"
    with singing(limit.hz, scene.arena.domain_id):
        scene.probe.listen_to_canary(limit.hz)
        scene.until(lambda: bool(seen.canary and seen.canary.messages), CANARY_WITHIN_S)
        before = [process.waits_ns() for process in scene.arena.processes]
        with scene.timed():
            yield
        for process, before_ns in zip(scene.arena.processes, before, strict=True):
            if now_ns := process.waits_ns():
                process.seen.cpu_wait_s = longest_wait_s(before_ns, now_ns)
    _note_trouble(scene, limit)


def _note_trouble(scene: Scene, limit: RateContract) -> None:
    """Whatever was seen of the rate, nobody will watch for longer."""
    seen = scene.seen
    for topic in {goal.feedback_topic for goal in seen.part(ActionsSeen).goals}:
        scene.probe.note_longest_watch(topic)
        rate = own_rate(measure_rate(scene.probe.messages(topic)), seen)
        seen.machine_fault = seen.machine_fault or trouble(seen, rate, limit)


# --- the other side ----------------------------------------------------------------------------


@contextmanager
def taking(scene: Scene, action: ActionContract, accepts: bool = True) -> Iterator[GoalTaker]:
    """A server of our own for as long as the block lasts."""
    with GoalTaker(scene.probe, action.action, action.type, accepts) as taker:
        yield taker


def lead(
    scene: Scene,
    process: Process,
    taker: GoalTaker,
    feedback: Sequence[Mapping[str, float]],
    shown: Sequence[str],
    how: Literal["succeed", "abort"],
    result: Mapping[str, Plain],
) -> None:
    """Take the client's goal, send it feedback, each when the one before is shown, and end it."""
    scene.until_own(lambda: _took_goal(scene, taker), SENDS_WITHIN_S)
    if not taker.has_goal:
        return
    within_s = SHOWS_WITHIN_S
    for each, text in zip(feedback, shown, strict=True):
        taker.tell(dict(each))
        if not scene.until_own(functools.partial(scene.is_written, process, text), within_s):
            within_s = SHOWS_MORE_WITHIN_S
    taker.end(how, dict(result))


def _took_goal(scene: Scene, taker: GoalTaker) -> bool:
    """A client that looks elsewhere may soon be gone: note where it looks."""
    _note_clients(scene)
    return taker.has_goal


def await_client(scene: Scene, process: Process, node: NodeContract) -> None:
    """Wait for a client that ends by itself, and note whom it gives goals to."""
    scene.until(lambda: _note_clients(scene), TURNS_WITHIN_S)
    await_end(scene, process, node)


def _note_clients(scene: Scene) -> bool:
    ends = read_actions(scene.probe.node, scene.seen.graph.nodes)
    scene.seen.recording(ActionsSeen).ends = ends or scene.seen.part(ActionsSeen).ends
    return any(end.kind == "client" for end in ends)
