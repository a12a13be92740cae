"""The one experiment of a drill: run its program, say and ask what the card has, and watch."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import ros2_on_pip
from roslings.arena import LONGEST_WAIT_S, Process
from roslings.capabilities.actions.record import ActionsSeen
from roslings.capabilities.parameters.act import list_parameters
from roslings.capabilities.services.act import Asker, answering
from roslings.capabilities.services.graph import read_services
from roslings.capabilities.services.record import ServicesSeen
from roslings.capabilities.topics.act import nested
from roslings.course import NodeContract, TopicContract
from roslings.evidence import Endpoint, ExperimentSeen, GraphSeen
from roslings.experiment import Run, Scene
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.experiment.own_time import OwnTime
from roslings.experiment.scene import hears, publishes
from roslings.experiment.start import Start
from roslings.matching import nearest_endpoint
from roslings_learn.drills.card import PROGRAM, DrillCard, Tell
from roslings_learn.drills.goals import give_goals, take_goal

TRIES = 2
"""We see that we are joined with a node a little before the node does: what is said in between is
lost, and is said once more."""
SHOWS_WITHIN_S = 0.4
"""After a node's callbacks have run, what they wrote is on its way."""
TURNS_WITHIN_S = 0.8
"""Of its own time: a node that answers nothing for so long runs no callback."""
ASKS_WITHIN_S = 0.8
COMES_UP_WITHIN_S, SHOWN_WITHIN_S = 5.0, 0.6
"""A node is in the graph some tenths of a second after its program has begun to speak."""
PRINTS_WITHIN_S, ENDS_WITHIN_S = 2.5, 8.0
LOADS_WITHIN_S = 8.0
"""Of work; who works on for longer is not loading any more."""
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
    node = card.nodes[0] if card.nodes else NodeContract(node="/program", executable=PROGRAM)
    start = Start(parameters=card.given)
    remaps = [*card.remaps, *_renaming(card.named)]
    if card.exits is not None or not card.nodes or card.program == "bash":
        shown = [ROS2] if card.program == "bash" else []
        with scene.arena.run(PROGRAM, start.arguments(remaps), shown) as process:
            scene.seen.processes[PROGRAM] = process.seen
            _await_nodes(card, scene, process)
            yield process
    else:
        with scene.run_all(Run(node, remaps, start)) as (process,):
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
    """As `Scene.until_own`; what the program's own processes work comes on top, to a bound.

    A script of two `ros2` commands loads for a second on a fast computer, for four on a slow one.
    """
    own, before_s = OwnTime(scene.arena), process.worked_s()

    def is_over() -> bool:
        return own.is_past(within_s) and own.is_past(
            within_s + min(process.worked_s() - before_s, LOADS_WITHIN_S)
        )

    most_s = within_s + LOADS_WITHIN_S + LONGEST_WAIT_S
    scene.until(lambda: condition() or is_over(), most_s)


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
    _let_spin(scene, process)
    if not scene.seen.stuck and not _stays_hidden(card, scene, process):
        _watch_what_comes(card, scene, process)


def _watch_what_comes(card: DrillCard, scene: Scene, process: Process) -> None:
    """Of a node that runs its callbacks, and that can be found."""
    published = [topic for node in card.nodes for topic in node.publishes]
    if any(node.parameters for node in card.nodes):
        list_parameters(scene, card.nodes[0])
    if published and not card.tells:
        _watch_first(published[0], card, scene)
    for node in card.nodes:
        _talk_with(node, card, scene, process)
    for tell in card.tells:
        _tell(tell, scene, process)
    if not (published or _is_asked(card)):
        _let_spin(scene, process)  # once more: its first timer may have come after that
    give_goals(card, scene, process)
    for take in card.takes:
        take_goal(take, scene, process)
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
        scene.appears(lambda: _mouth(scene, topic) is not None, publishes(topic))


def _mouth(scene: Scene, topic: TopicContract) -> Endpoint | None:
    return nearest_endpoint(scene.seen.graph, "publisher", topic.topic, topic.type)


def _let_spin(scene: Scene, process: Process) -> None:
    """Wait until its nodes have run a callback; those that never do are written down."""
    for name in list(scene.seen.graph.nodes):
        if process.alive and not scene.turned(name, TURNS_WITHIN_S) and process.alive:
            scene.seen.stuck.append(name)


def _talk_with(node: NodeContract, card: DrillCard, scene: Scene, process: Process) -> None:
    for topic in node.subscribes if not card.tells else ():
        ear = _ear(scene, topic)
        for _ in range(card.says if ear else 0):
            assert ear
            _say(scene, process, ear, scene.sentence())
    if node.serves:
        asker = Asker(scene, process, node)
        for service in node.serves:
            asker.ask_in_a_row(service, service.answers, len(service.answers), service.service)
    for service in node.calls:
        scene.until(lambda: _has_clients(scene), FIRST_MESSAGE_WITHIN_S)
        with answering(scene, service, service.answers[0].response):  # a little late, as real ones
            _await_request(node, scene, process)


def _has_clients(scene: Scene) -> bool:
    """Whether the program is a client of something; a slip in a name is told."""
    ends = read_services(scene.probe.eye, scene.seen.graph.nodes)
    scene.seen.recording(ServicesSeen).ends = ends or scene.seen.part(ServicesSeen).ends
    return any(end.kind == "client" for end in ends)


def _await_request(node: NodeContract, scene: Scene, process: Process) -> None:
    """Wait for a request, and then for the line about its answer."""

    if not scene.until_own(lambda: len(scene.seen.part(ServicesSeen).served) > 0, ASKS_WITHIN_S):
        return
    line = (node.log or "").format(
        text=scene.seen.part(ServicesSeen).served[0].response.get("message", "")
    )
    if not scene.is_written(process, line):
        _let_spin(scene, process)
    if not scene.seen.stuck:
        scene.until_own(lambda: scene.is_written(process, line), SHOWS_WITHIN_S)


def _ear(scene: Scene, topic: TopicContract) -> Endpoint | None:
    def find() -> Endpoint | None:
        return nearest_endpoint(scene.seen.graph, "subscription", topic.topic, topic.type)

    scene.appears(lambda: find() is not None, hears(topic))
    return find()


def _say(scene: Scene, process: Process, ear: Endpoint, text: str) -> None:
    """Say a sentence, once more where nothing came of it, and wait for the line about it."""
    if ear.type != "std_msgs/msg/String":
        return
    said = len(scene.seen.spoken)
    for _ in range(TRIES):
        del scene.seen.spoken[said:]  # one sentence, however often it had to be said
        scene.probe.say(ear, {"data": text}, FIRST_MESSAGE_WITHIN_S)
        if _comes(scene, process, ear, lambda: scene.is_written(process, text)):
            return


def _comes(scene: Scene, process: Process, ear: Endpoint, shown: Callable[[], bool]) -> bool:
    """Wait for what must come of a message, and no longer than until the callbacks have run."""
    if scene.until_own(shown, SHOWS_WITHIN_S) or not process.alive:
        return True
    scene.turned(ear.node, TURNS_WITHIN_S)
    return scene.until_own(shown, SHOWS_WITHIN_S)


def _tell(tell: Tell, scene: Scene, process: Process) -> None:
    topic = TopicContract(topic=tell.topic, type=tell.type)
    ear = _ear(scene, topic)
    if ear is None:
        return
    said = len(scene.seen.spoken)
    for _ in range(TRIES):
        del scene.seen.spoken[said:]
        before = _heard(scene, tell)
        scene.probe.say(ear, nested(tell.message), FIRST_MESSAGE_WITHIN_S)

        def shown(before: int = before) -> bool:
            written = tell.log is None or scene.is_written(process, tell.log)
            return written and (tell.publishes is None or _heard(scene, tell) > before)

        if _comes(scene, process, ear, shown):
            return


def _heard(scene: Scene, tell: Tell) -> int:
    if tell.publishes is None:
        return 0
    there = _mouth(scene, TopicContract(topic=tell.publishes.topic, type=tell.publishes.type))
    return scene.probe.count(there.topic) if there else 0


def _await_output(card: DrillCard, scene: Scene, process: Process) -> None:
    """Wait for what must be printed, and for the end of a program that ends by itself."""
    answered = scene.seen.part(ServicesSeen).served or scene.seen.part(ActionsSeen).orders
    if card.exits is not None and (answered or not card.waits_for_answers):
        scene.until_own(lambda: not process.alive, ENDS_WITHIN_S)
        process.wait_ended(0.0 if process.alive else ENDS_WITHIN_S)
    elif card.prints:
        texts = [line for line in card.prints]
        _until_idle(
            scene, process,
            lambda: all(any(t in line.text for line in process.lines()) for t in texts),
            PRINTS_WITHIN_S,
        )  # fmt: skip
