"""Which faults there are at a lab's boundary, from its card and the fields of its types."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from roslings.capabilities.actions.contract import ActionWords
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.rooms.contract import RoomWords
from roslings.capabilities.services.contract import ServiceWords
from roslings.course import Lab, NodeContract, TopicContract
from roslings_prove.boundary import layer
from roslings_prove.boundary.fields import MessageField, fields_of
from roslings_prove.boundary.operators import AIMED, WORDS, of_field, of_flow
from roslings_prove.generated.explained import BOUNDARY

LAYER = "boundary_layer"
ODOMETRY = "nav_msgs/msg/Odometry"
EACH_TOPIC = ""
"""The end of any name."""


@dataclass(frozen=True)
class BoundaryFault:
    """One thing that goes wrong between a program and ROS."""

    lab: Lab
    executable: str
    """The program that it is for; empty: each."""
    kind: str
    """Where: a message that is sent or heard, a request, a goal, a parameter, and so on."""
    operator: str
    at: str = ""
    """The topic, service, action or parameter."""
    field: str = ""
    other: str = ""
    """The field beside it; of a bag the name of the type."""

    @property
    def changed(self) -> str:
        """What goes wrong, for people."""
        where = " ".join(filter(None, (self.executable, self.kind, self.at, self.field)))
        return f"{where}: {WORDS.get(self.operator, self.operator)}"

    diff = changed

    @cached_property
    def name(self) -> str:
        """Short, and the same as long as the fault is."""
        words = (self.kind, self.at.strip("/"), self.field, self.operator)
        place = "-".join(filter(None, words)).replace("/", ".").replace(" ", "-")
        short = hashlib.sha256(f"{self.executable} {self.changed} {self.other}".encode())
        return f"{self.lab.name}-{BOUNDARY}-{place}-{short.hexdigest()[:6]}"

    @property
    def place(self) -> tuple[str, str, str, str]:
        """Places are to be met evenly."""
        return self.executable, self.kind, self.at, self.field

    @property
    def is_aimed(self) -> bool:
        """Of a kind that has found holes."""
        return self.operator in AIMED

    def put_into(self, package: Path) -> None:
        """Let it go wrong in this package, whatever its code is."""
        module = package / package.name
        shutil.copyfile(layer.__file__, module / f"{LAYER}.py")
        words = {
            "executable": self.executable,
            "kind": self.kind,
            "operator": self.operator,
            "at": self.at,
            "field": self.field,
            "other": self.other,
        }
        init = module / "__init__.py"
        own = init.read_text("utf-8") if init.is_file() else ""
        init.write_text(f"{own}\nfrom .{LAYER} import install\n\ninstall({words!r})\n", "utf-8")


def neutral(lab: Lab) -> BoundaryFault:
    """The layer in each place, with nothing that goes wrong."""
    return BoundaryFault(lab, "", "everywhere", "neutral")


def faults(lab: Lab) -> list[BoundaryFault]:
    """All of a lab. Raises UnknownInterface where a type of its card is nowhere defined."""
    found = [fault for node in lab.card.nodes for fault in _of_node(lab, node)]
    return [*found, *_of_the_graph(lab), *_of_bags(lab)]


def _of_node(lab: Lab, node: NodeContract) -> Iterator[BoundaryFault]:
    program = node.executable
    for kind, topics in (("sent", node.publishes), ("heard", node.subscribes)):
        for topic in topics:
            found = _of_values(lab, program, kind, topic.topic, fields_of(lab, topic.type))
            yield from (each for each in found if not _nobody_can_tell(each, node, topic))
            for operator in sorted(_of_qos(kind, topic)):
                yield BoundaryFault(lab, program, f"{kind} qos", operator, topic.topic)
    yield from _of_services(lab, node)
    yield from _of_actions(lab, node)
    yield from _of_parameters(lab, node)
    yield from _of_life(lab, node)


def _of_services(lab: Lab, node: NodeContract) -> Iterator[BoundaryFault]:
    for service in node.of(ServiceWords).serves:
        for part, kind in enumerate(("request", "response")):
            found = fields_of(lab, service.type, part)
            yield from _of_values(lab, node.executable, kind, service.service, found)
    for service in node.of(ServiceWords).calls:
        found = fields_of(lab, service.type)
        yield from _of_values(lab, node.executable, "asked", service.service, found)


def _of_actions(lab: Lab, node: NodeContract) -> Iterator[BoundaryFault]:
    for action in node.of(ActionWords).performs:
        for part, kind in enumerate(("goal", "result", "feedback")):
            found = fields_of(lab, action.type, part)
            yield from _of_values(lab, node.executable, kind, action.action, found)
        yield BoundaryFault(lab, node.executable, "cancel", "second_cancel_refused", action.action)
    for action in node.of(ActionWords).orders:
        found = fields_of(lab, action.type)
        yield from _of_values(lab, node.executable, "ordered", action.action, found)


def _of_parameters(lab: Lab, node: NodeContract) -> Iterator[BoundaryFault]:
    for parameter in node.of(ParameterWords).parameters:
        bounded = parameter.least is not None or parameter.most is not None
        refuses = bounded or parameter.read_only or parameter.not_above
        floating = bounded and parameter.type == "double"
        may = {
            "other_default": True,
            "bound_ignored": refuses,
            "nan_let_in": floating,
            "infinity_let_in": floating,
            "second_change_only": parameter.live,
            "not_described": bounded,
        }
        for operator in filter(may.get, may):
            yield BoundaryFault(lab, node.executable, "parameter", operator, parameter.name)


STRONGER = {"reliability": "reliable", "durability": "transient_local"}
"""What a publisher offers to each subscription; who asks for it hears from no other one."""


def _of_qos(kind: str, topic: TopicContract) -> Iterator[str]:
    """What the card says of it, where the other word does not match any more.

    Who offers more than is asked for, or asks for less, is as good, unless the card is exact.
    """
    if "qos" not in topic.model_fields_set:
        return
    for word in topic.qos.model_fields_set & STRONGER.keys():
        is_stronger = getattr(topic.qos, word) == STRONGER[word]
        if topic.qos.exact or is_stronger == (kind == "sent"):
            yield word


SEEN_IN_NO_DRIVE = frozenset(
    {
        "drop_first",
        "drop_second",
        "drop_nth",
        "gap",
        "twice",
        "extra_at_start",
        "late",
        "doubled",
        "of_before",
    }
)
"""A message more, less, later or stronger: who drives by what it sees mends it by the next one."""


def _nobody_can_tell(fault: BoundaryFault, node: NodeContract, topic: TopicContract) -> bool:
    """A message that may be lost all the same, or of which nobody knows when it was due.

    A node that drives in rooms is judged by where its rover goes, and by no single message.

    Whoever joins a topic may miss the first message, unless it is kept for those who come later. Of
    messages that come again and again, one that is missing is within what a rate may be off, unless
    their text counts.
    """
    if node.of(RoomWords).rooms:
        return fault.operator in SEEN_IN_NO_DRIVE
    if topic.qos.durability == "transient_local":
        return False
    if fault.kind == "heard" or not topic.rate:
        return fault.operator == "drop_first"
    unseen = {"drop_first", "late"} if topic.text else {"drop_first", "late", "drop_second"}
    return fault.operator in unseen


def _of_the_graph(lab: Lab) -> Iterator[BoundaryFault]:
    """Of one program: whether such ends are free, the card says of all its nodes at once."""
    for node in lab.card.nodes[:1]:
        yield BoundaryFault(lab, node.executable, "node", "extra_ends")


def _of_life(lab: Lab, node: NodeContract) -> Iterator[BoundaryFault]:
    yield BoundaryFault(lab, node.executable, "node", "ends_late")
    yield BoundaryFault(lab, node.executable, "node", "exit_code")
    yield BoundaryFault(lab, node.executable, "events", "ends_after")


def _of_bags(lab: Lab) -> Iterator[BoundaryFault]:
    reads = getattr(lab.card, "reads_bags", None)
    if reads is None:
        return
    name = ODOMETRY.rpartition("/")[2]
    for topic in (reads.odometry, EACH_TOPIC):
        for operator in of_flow("read", []):
            yield BoundaryFault(lab, reads.executable, "read", operator, topic)
    for fault in _of_fields(lab, reads.executable, "read", "", fields_of(lab, ODOMETRY)):
        if fault.operator != "swapped":
            yield BoundaryFault(
                lab, fault.executable, "read", fault.operator, "", fault.field, name
            )
    yield BoundaryFault(lab, reads.executable, "node", "exit_code")


def _of_values(
    lab: Lab, program: str, kind: str, at: str, fields: list[MessageField]
) -> Iterator[BoundaryFault]:
    for operator in of_flow(kind, fields):
        yield BoundaryFault(lab, program, kind, operator, at)
    yield from _of_fields(lab, program, kind, at, fields)


def _of_fields(
    lab: Lab, program: str, kind: str, at: str, fields: Iterable[MessageField]
) -> Iterator[BoundaryFault]:
    listed = list(fields)
    for number, field in enumerate(listed):
        beside = _beside(field, listed[number + 1 :])
        for operator in of_field(kind, field):
            if operator != "swapped":
                yield BoundaryFault(lab, program, kind, operator, at, field.path)
            elif beside:
                yield BoundaryFault(lab, program, kind, operator, at, field.path, beside.path)


def _beside(field: MessageField, later: Iterable[MessageField]) -> MessageField | None:
    """The next one of its kind in the same message."""
    like = (field.around, field.kind)
    return next((each for each in later if (each.around, each.kind) == like), None)
