"""The one experiment of a drill: run its program, say and ask what the card has, and watch.

It is made of what the experiments of labs are made of.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import ros2_on_pip
from roslings.arena import Process
from roslings.capabilities.parameters.act import list_parameters
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.services.act import Asker, answering, await_end
from roslings.capabilities.services.contract import ServiceWords
from roslings.capabilities.services.graph import read_services
from roslings.capabilities.services.record import ServicesSeen
from roslings.capabilities.topics.act import Teller, nested
from roslings.course import NodeContract, TopicContract
from roslings.evidence import Endpoint, ExperimentSeen, GraphSeen
from roslings.experiment import Scene
from roslings.experiment.missed import hears, publishes
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.start import Start
from roslings.seen.matching import nearest_endpoint
from roslings_learn.drills.card import PROGRAM, DrillCard
from roslings_learn.drills.goals import give_goals, take_goal
from roslings_learn.drills.script_time import LONGEST_S, ScriptTime

TRIES = 2
"""We see that we are joined with a node a little before the node does: what is said in between is
lost."""
SHOWS_WITHIN_S = 0.4
"""After a node's callbacks have run, what they wrote is on its way."""
TURNS_WITHIN_S = 0.8
"""Of its own time: a node that answers nothing for so long runs no callback."""
ASKS_WITHIN_S = 0.8
LOOKS_AT_REST = 3
"""A program that was asleep at so many looks, one after the other, waits for something."""
COMES_UP_WITHIN_S, SHOWN_WITHIN_S = 5.0, 0.6
"""A node is in the graph some tenths of a second after its program has begun to speak."""
PRINTS_WITHIN_S, ENDS_WITHIN_S = 2.5, 8.0
BESIDE = "beside"
ROS2 = Path(ros2_on_pip.__path__[0])
"""The course's own `ros2`: a script may call it."""


class SeenEnough(Exception):
    """Nothing more is asked of the program, and nobody judges how it ends."""


def watch(card: DrillCard, scene: Scene) -> None:
    """Run the program once, and see all that the card asks for."""
    with _companion(card, scene):
        try:
            with running(card, scene) as process:
                _watch_all(card, scene, process)
                if not card.ends_well:
                    raise SeenEnough
        except SeenEnough:
            pass
    _forget(card, scene.seen)


@contextmanager
def running(card: DrillCard, scene: Scene) -> Iterator[Process]:
    """The program, started as the card says; with `ends_well`, Ctrl-C is pressed at the end."""
    start = Start(parameters=card.given)
    remaps = [*card.remaps, *_renaming(card.named)]
    if card.nodes and card.program == "python":
        with scene.run(card.nodes[0], remaps, start) as process:
            yield process
    else:
        shown = [ROS2] if card.program == "bash" else []
        with scene.arena.run(PROGRAM, start.arguments(remaps), shown) as process:
            scene.seen.processes[PROGRAM] = process.seen
            _await_nodes(card, scene, process)
            yield process


def _await_nodes(card: DrillCard, scene: Scene, process: Process) -> None:
    """Of a script that stays: until its nodes are there, or it has long been at work without."""
    wanted = len(card.nodes) + len(card.beside.nodes if card.beside else ())
    if card.exits is None and card.nodes:
        there = functools.partial(_are_there, scene, wanted)
        _until_idle(scene, process, lambda: there() or bool(process.lines()), COMES_UP_WITHIN_S)
        scene.until_own(there, SHOWN_WITHIN_S)


def _until_idle(
    scene: Scene, process: Process, condition: Callable[[], bool], within_s: float
) -> None:
    """As `Scene.until_own`; what the program's own processes work comes on top, to a bound."""
    own = ScriptTime(scene.arena, process)
    scene.until(lambda: condition() or own.is_past(within_s), within_s + LONGEST_S)


def _are_there(scene: Scene, count: int) -> bool:
    return len(scene.seen.graph.nodes) >= count


def _renaming(named: str | None) -> list[str]:
    if named is None:
        return []
    space, _, name = named.rpartition("/")
    return [f"__node:={name}", f"__ns:={space or '/'}"]


@contextmanager
def _companion(card: DrillCard, scene: Scene) -> Iterator[None]:
    """The program that runs beside, until it is in the graph."""
    with ExitStack() as stack:
        if card.beside:
            stack.enter_context(scene.arena.run(BESIDE))
            wanted = set(card.beside.nodes)
            scene.until(lambda: wanted <= set(scene.seen.graph.nodes), FIRST_MESSAGE_WITHIN_S)
        yield


def _forget(card: DrillCard, seen: ExperimentSeen) -> None:
    """What ran beside is not the student's."""
    ours = set(card.beside.nodes) if card.beside else set()
    graph = seen.graph
    seen.graph = GraphSeen(
        nodes=[name for name in graph.nodes if name not in ours],
        endpoints=[each for each in graph.endpoints if each.node not in ours],
        services=graph.services,
    )


def _watch_all(card: DrillCard, scene: Scene, process: Process) -> None:
    if len(card.nodes) > 1:
        scene.appears(lambda: len(scene.seen.graph.nodes) >= len(card.nodes), "all nodes")
    _let_spin(card, scene, process)
    if not scene.seen.stuck and not _stays_hidden(card, scene, process):
        _watch_what_comes(card, scene, process)


def _watch_what_comes(card: DrillCard, scene: Scene, process: Process) -> None:
    """Of a node that runs its callbacks, and that can be found."""
    published = [topic for node in card.nodes for topic in node.publishes]
    if any(node.of(ParameterWords).parameters for node in card.nodes):
        list_parameters(scene, card.nodes[0])
    if published and not card.tells:
        _watch_first(published[0], card, scene)
    for node in card.nodes:
        _talk_with(node, card, scene, process)
    _tell_each(card, scene, process)
    if not (published or _is_asked(card)):
        _let_spin(card, scene, process)  # once more: its first timer may have come after that
    give_goals(card, scene, process)
    for take in card.takes:
        take_goal(take, card.nodes[0], scene, process)
    _await_output(card, scene, process)


def _is_asked(card: DrillCard) -> bool:
    """Whether something is said or given to it, which shows that it runs its callbacks."""
    return bool(card.says or card.tells or card.gives or card.takes)


def _stays_hidden(card: DrillCard, scene: Scene, process: Process) -> bool:
    """A script is at work, and none of its nodes can be found."""
    ours = set(card.beside.nodes) if card.beside else set()
    asked = card.program == "bash" and card.exits is None and bool(card.nodes)
    return asked and process.alive and not set(scene.seen.graph.nodes) - ours


def _watch_first(topic: TopicContract, card: DrillCard, scene: Scene) -> None:
    """Watch what it says; where nobody asks for that, only that it is there."""
    if topic.rate or topic.text or topic.fields or card.answer:
        scene.watch(topic)
    else:
        scene.appears(lambda: _publisher(scene, topic) is not None, publishes(topic))


def _publisher(scene: Scene, topic: TopicContract) -> Endpoint | None:
    return nearest_endpoint(scene.seen.graph, "publisher", topic.topic, topic.type)


def _let_spin(card: DrillCard, scene: Scene, process: Process) -> None:
    """Wait until its nodes have run a callback; those that never do are written down.

    A program with one task may do that in main(), and spin only then.
    """
    for name in list(scene.seen.graph.nodes) if card.exits is None else ():
        if process.alive and not scene.turned(name, TURNS_WITHIN_S) and process.alive:
            scene.seen.stuck.append(name)


# --- what is said, asked and answered ----------------------------------------------------------


def _talk_with(node: NodeContract, card: DrillCard, scene: Scene, process: Process) -> None:
    for topic in node.subscribes if not card.tells else ():
        _say_sentences(topic, card.says, scene, process)
    services = node.of(ServiceWords)
    if services.serves:
        asker = Asker(scene, process, node)
        for service in services.serves:
            asker.ask_in_a_row(service, service.answers, len(service.answers), service.service)
    for service in services.calls:
        _await_client(scene, process)
        with answering(scene, service, service.answers[0].response):  # a little late, as real ones
            _await_request(node, card, scene, process)


def _say_sentences(topic: TopicContract, count: int, scene: Scene, process: Process) -> None:
    """The first one is said once before it counts, as `Teller` does with values."""
    subscription = _hears(topic, scene)
    if subscription and count:
        said, first = len(scene.seen.spoken), scene.sentence()
        _tell(subscription, {"data": first}, first, scene, process)
        del scene.seen.spoken[said:]
        scene.say_sentences(process, topic, count)


def _hears(topic: TopicContract, scene: Scene) -> Endpoint | None:
    """The subscription to a topic, or to the one nearest to it; None for one of another type."""

    def find() -> Endpoint | None:
        return nearest_endpoint(scene.seen.graph, "subscription", topic.topic, topic.type)

    scene.appears(lambda: find() is not None, hears(topic))
    subscription = find()
    return subscription if subscription and subscription.type == topic.type else None


def _tell_each(card: DrillCard, scene: Scene, process: Process) -> None:
    """Each value, and wait for what must come of it."""
    tellers: dict[tuple[str, str], Teller] = {}
    for tell in card.tells:
        subscription = _hears(tell.heard, scene)
        if subscription and tell.publishes:
            way = tell.topic, tell.publishes.topic
            if way not in tellers:
                tellers[way] = Teller(scene, process, tell.heard, tell.publishes)
            tellers[way].tell(tell.message)
        elif subscription and tell.log:
            _tell(subscription, tell.message, tell.log, scene, process)


def _tell(
    subscription: Endpoint, fields: Mapping[str, Any], line: str, scene: Scene, process: Process
) -> None:
    """Say one message, and wait for its line; once more where the node may not have heard it.

    Where no line comes, wait no longer than until the callbacks have run.
    """
    said = len(scene.seen.spoken)
    written = functools.partial(scene.is_written, process, line)
    for _ in range(TRIES):
        del scene.seen.spoken[said:]
        scene.probe.say(subscription, nested(fields), FIRST_MESSAGE_WITHIN_S)
        if not scene.until_own(written, SHOWS_WITHIN_S) and process.alive:
            scene.turned(subscription.node, TURNS_WITHIN_S)
            scene.until_own(written, SHOWS_WITHIN_S)
        if written() or not process.alive:
            return


def _await_client(scene: Scene, process: Process) -> None:
    """Until its client is in the graph, and it waits: who asks at once has asked nobody then.

    On a busy computer a server that comes up any sooner may be there before a hasty request.
    """
    looks = 0

    def has_asked_nobody() -> bool:
        nonlocal looks
        looks = looks + 1 if process.asleep() else 0
        return looks >= LOOKS_AT_REST and _has_client(scene)

    scene.until_own(has_asked_nobody, ASKS_WITHIN_S)


def _has_client(scene: Scene) -> bool:
    ends = read_services(scene.probe.node, scene.seen.graph.nodes)
    return any(end.kind == "client" for end in ends)


def _await_request(node: NodeContract, card: DrillCard, scene: Scene, process: Process) -> None:
    """Wait for a request, and then for what must come of the answer: the end, or a line."""
    if not scene.until_own(lambda: _has_asked(scene), ASKS_WITHIN_S):
        return
    if card.exits is not None:
        await_end(scene, process, node)
        return
    text = scene.seen.part(ServicesSeen).served[0].response.get("message", "")
    written = functools.partial(scene.is_written, process, (node.log or "").format(text=text))
    if not written():
        _let_spin(card, scene, process)
    if not scene.seen.stuck:
        scene.until_own(written, SHOWS_WITHIN_S)


def _has_asked(scene: Scene) -> bool:
    """Whether a request came. Whom the program may call is noted: it may soon be gone."""
    ends = read_services(scene.probe.node, scene.seen.graph.nodes)
    seen = scene.seen.recording(ServicesSeen)
    seen.ends = ends or seen.ends
    return bool(seen.served)


def _await_output(card: DrillCard, scene: Scene, process: Process) -> None:
    """Wait for what must be printed, and for the end of a program that ends by itself."""
    if card.exits is not None:
        if not card.waits_for_answers:
            scene.until_own(lambda: not process.alive, ENDS_WITHIN_S)
        process.wait_ended(0.0 if process.alive else ENDS_WITHIN_S)
    elif card.prints:
        _until_idle(
            scene,
            process,
            lambda: all(any(t in line.text for line in process.lines()) for t in card.prints),
            PRINTS_WITHIN_S,
        )
