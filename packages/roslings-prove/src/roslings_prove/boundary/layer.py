"""One thing goes wrong between this package's nodes and rclpy.

This file is copied into a package as it stands. It imports nothing of roslings, and of ROS by name
only, since a package must list what its code imports. `install` is told one fault as plain values;
`faults.py` says which there are. A fault that acts writes `MARK` once, so that evidence shows it.
The operator `neutral` goes everywhere that any fault goes, and changes nothing.
"""

from __future__ import annotations

import asyncio
import atexit
import copy
import functools
import importlib
import math
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

MARK = "boundary: the fault acts"
NTH = 5
"""Which message `drop_nth` drops, counted from 1; then each so many."""
GAP, GAP_EACH = range(6, 10), 20
"""The messages that `gap` loses of each twenty, counted from 1."""
STOPS_AFTER = 6
"""So many messages pass before `stops_after`: a check watches a slow topic for a few more."""
ENDS_AFTER = 12
"""So many events pass before `ends_after`."""
LATE_S = 0.3
ENDS_LATE_S = 4.0
EXIT_CODE = 3


class InjectedFault:
    """What goes wrong, and whether it has acted."""

    def __init__(self, words: Mapping[str, str]) -> None:
        self.kind = words["kind"]
        self.operator = words["operator"]
        self.at = words["at"]
        self.field = words["field"]
        self.other = words["other"]
        self.events = 0
        self._told = False

    def is_at(self, kind: str, name: str) -> bool:
        """Whether it goes here; a name may stand in a namespace."""
        if self.kind in ("everywhere", "events"):
            return True
        return self.kind == kind and (name == self.at or name.endswith(self.at))

    def acts(self) -> None:
        """Say so, the first time."""
        if not self._told:
            self._told = True
            print(MARK, file=sys.stderr, flush=True)

    def count(self) -> None:
        """A message or a call has crossed the boundary."""
        self.events += 1
        if self.kind == "events" and self.events > ENDS_AFTER:
            self.acts()
            os._exit(0)


def get(message: Any, path: str) -> Any:
    """The value of a field; a dot leads into it."""
    return functools.reduce(getattr, path.split("."), message)


def put(message: Any, path: str, value: Any) -> None:
    """Set a field; a dot leads into it."""
    *way, last = path.split(".")
    setattr(functools.reduce(getattr, way, message), last, value)


def same(one: Any, other: Any) -> bool:
    """NaN is the same as NaN here, and 0 another one than -0."""
    return repr(one) == repr(other)


Memory = dict[str, Any]


def of_before(value: Any, memory: Memory) -> Any:
    """What the field held last time; the first time as it is."""
    before = memory.get("before", value)
    memory["before"] = copy.deepcopy(value)
    return before


def of_first(value: Any, memory: Memory) -> Any:
    """What the field held the first time."""
    return memory.setdefault("first", copy.deepcopy(value))


def turned_when_repeated(value: Any, memory: Memory) -> Any:
    """The other truth, where it is the same as last time."""
    repeated = memory.get("before") == value
    memory["before"] = value
    return not value if repeated else value


FIELDS: dict[str, Callable[[Any, Memory], Any]] = {
    "neutral": lambda value, memory: value,
    "zero": lambda value, memory: type(value)(),
    "negated": lambda value, memory: not value if isinstance(value, bool) else -value or value,
    "absolute": lambda value, memory: abs(value),
    "doubled": lambda value, memory: 2 * value,
    "nan": lambda value, memory: math.nan,
    "plus_one": lambda value, memory: value + 1,
    "upper": lambda value, memory: value.upper(),
    "longer": lambda value, memory: f"{value}s",
    "shorter": lambda value, memory: value[:-1],
    "of_before": of_before,
    "of_first": of_first,
    "turned_when_repeated": turned_when_repeated,
}


INCOMING = ("heard", "read", "request", "goal")
"""Places where a program gets a message: a field that it does not look at changes nothing there."""


def watch(message: Any, path: str, read: Callable[[], None]) -> None:
    """Let the message call `read` when somebody looks at this field.

    It stays of its type for all who ask: a subclass by the same name.
    """
    *way, last = path.split(".")
    inner = functools.reduce(getattr, way, message)
    kind = type(inner)
    field = getattr(kind, last)

    def look(self: Any) -> Any:
        read()
        return field.fget(self)

    words = {"__slots__": (), "__module__": kind.__module__, last: property(look, field.fset)}
    inner.__class__ = type(kind.__name__, (kind,), words)


class FieldChange:
    """Changes one field of each message."""

    def __init__(self, fault: InjectedFault) -> None:
        self._fault = fault
        self._memory: Memory = {}

    def __call__(self, message: Any) -> Any:
        """A changed copy; the message itself where nothing is another."""
        self._fault.count()
        if self._fault.operator == "swapped":
            return self._swapped(message)
        change = FIELDS.get(self._fault.operator)
        if change is None or not self._fault.field:
            return message
        before = get(message, self._fault.field)
        return self._with(message, {self._fault.field: change(before, self._memory)})

    def _swapped(self, message: Any) -> Any:
        one, other = self._fault.field, self._fault.other
        return self._with(message, {one: get(message, other), other: get(message, one)})

    def _with(self, message: Any, values: Mapping[str, Any]) -> Any:
        if all(same(get(message, field), value) for field, value in values.items()):
            return message
        changed = copy.deepcopy(message)
        for field, value in values.items():
            put(changed, field, value)
        if self._fault.kind not in INCOMING:
            self._fault.acts()
            return changed
        for field in values:
            watch(changed, field, self._fault.acts)
        return changed


def numbers_in(message: Any) -> list[float]:
    """All numbers of a message, with those of the messages in it."""
    fields = getattr(message, "get_fields_and_field_types", None)
    if fields is None:
        plain = isinstance(message, (bool, int, float))
        return [float(message)] if plain else []
    return [number for name in fields() for number in numbers_in(getattr(message, name))]


def is_zero(message: Any) -> bool:
    """It has numbers, and each is 0."""
    numbers = numbers_in(message)
    return bool(numbers) and not any(numbers)


class Stream:
    """Messages on their way through one place: each becomes none, one or two."""

    def __init__(self, fault: InjectedFault) -> None:
        self._fault = fault
        self._field = FieldChange(fault)
        self._count = 0
        self._before: Any = None

    def __call__(self, message: Any) -> list[Any]:
        """What passes in its place."""
        self._count += 1
        before = self._before
        if self._fault.operator == "drop_repeats":
            self._before = copy.deepcopy(message)
        passing = [self._field(message)]
        if self._is_dropped(message, before):
            self._fault.acts()
            return []
        if self._fault.operator == "twice":
            self._fault.acts()
            return passing * 2
        if self._fault.operator == "extra_at_start" and self._count == 1:
            self._fault.acts()
            return [type(message)(), *passing]
        return passing

    def _is_dropped(self, message: Any, before: Any) -> bool:
        operator = self._fault.operator
        return (
            (operator == "drop_first" and self._count == 1)
            or (operator == "drop_second" and self._count == 2)
            or (operator == "gap" and self._count % GAP_EACH in GAP)
            or (operator == "drop_nth" and self._count % NTH == 0)
            or (operator == "stops_after" and self._count > STOPS_AFTER)
            or (operator == "once" and self._count > 1)
            or (operator == "drop_zeros" and is_zero(message))
            or (operator == "drop_negatives" and any(n < 0 for n in numbers_in(message)))
            or (operator == "drop_nan" and any(map(math.isnan, numbers_in(message))))
            or (operator == "drop_repeats" and self._count > 1 and same(message, before))
        )


def passing(stream: Stream, message: Any) -> list[Any]:
    """What a stream lets through; a message in bytes passes as it is."""
    return [message] if isinstance(message, bytes) else stream(message)


def is_coroutine(callback: Any) -> bool:
    """Whether rclpy awaits it."""
    return asyncio.iscoroutinefunction(callback)


def hearing(fault: InjectedFault, callback: Callable[..., Any]) -> Callable[..., Any]:
    """The callback of a subscription, behind a stream; of its form rclpy makes the same."""
    stream = Stream(fault)

    def calls(message: Any, *rest: Any) -> Iterator[Any]:
        return (callback(each, *rest) for each in passing(stream, message))

    @functools.wraps(callback)
    def heard(message: Any, *rest: Any) -> None:
        for _ in calls(message, *rest):
            pass

    @functools.wraps(callback)
    async def awaited(message: Any, *rest: Any) -> None:
        for each in calls(message, *rest):
            await each

    return awaited if is_coroutine(callback) else heard


def sending(fault: InjectedFault, publisher: Any) -> Callable[[Any], None]:
    """`publish`, behind a stream. What nobody hears, now or later, passes it by, uncounted."""
    stream, send = Stream(fault), publisher.publish

    def sent(message: Any) -> None:
        if not is_kept(publisher) and not publisher.get_subscription_count():
            send(message)
            return
        for each in passing(stream, message):
            if fault.operator == "late":
                fault.acts()
                _later(send, copy.deepcopy(each))
            else:
                send(each)

    return sent


def is_kept(publisher: Any) -> bool:
    """Whether those who come later hear it too."""
    return str(publisher.qos_profile.durability.name) == "TRANSIENT_LOCAL"


def _later(send: Callable[[Any], Any], message: Any) -> None:
    timer = threading.Timer(LATE_S, _if_it_can, (send, message))
    timer.daemon = True
    timer.start()


def _if_it_can(send: Callable[[Any], Any], message: Any) -> None:
    try:
        send(message)
    except Exception:  # the node has ended meanwhile
        return


def other_qos(fault: InjectedFault, profile: Any) -> Any:
    """The profile with the other word for reliability or durability."""
    qos = importlib.import_module("rclpy.qos")
    changed = qos.QoSProfile(depth=profile) if isinstance(profile, int) else copy.copy(profile)
    words = getattr(qos, f"{fault.operator.capitalize()}Policy")
    now = getattr(changed, fault.operator)
    pairs = {
        "reliability": ("RELIABLE", "BEST_EFFORT"),
        "durability": ("TRANSIENT_LOCAL", "VOLATILE"),
    }[fault.operator]
    setattr(changed, fault.operator, getattr(words, pairs[now == getattr(words, pairs[0])]))
    fault.acts()
    return changed


def over(kind: type[Any], name: str) -> Callable[[Callable[..., Any]], None]:
    """Put a function in place of a method; it is given the old one first."""

    def put_there(new: Callable[..., Any]) -> None:
        old = getattr(kind, name)

        @functools.wraps(old)
        def method(*words: Any, **named: Any) -> Any:
            return new(old, *words, **named)

        setattr(kind, name, method)

    return put_there


def around_topics(fault: InjectedFault) -> None:
    """Publishers and subscriptions."""
    node = importlib.import_module("rclpy.node").Node

    @over(node, "create_publisher")
    def create_publisher(
        old: Any, self: Any, msg_type: Any, topic: str, qos_profile: Any, **rest: Any
    ) -> Any:
        name = self.resolve_topic_name(topic)
        if fault.kind == "sent qos" and fault.is_at("sent qos", name):
            qos_profile = other_qos(fault, qos_profile)
        publisher = old(self, msg_type, topic, qos_profile, **rest)
        if fault.is_at("sent", name):
            publisher.publish = sending(fault, publisher)
        return publisher

    @over(node, "create_subscription")
    def create_subscription(
        old: Any, self: Any, msg_type: Any, topic: str, callback: Any, qos_profile: Any, **rest: Any
    ) -> Any:
        name = self.resolve_topic_name(topic)
        if fault.kind == "heard qos" and fault.is_at("heard qos", name):
            qos_profile = other_qos(fault, qos_profile)
        if fault.is_at("heard", name):
            callback = hearing(fault, callback)
        return old(self, msg_type, topic, callback, qos_profile, **rest)


class Answering:
    """The callback of a service, with a change on its way in or out."""

    def __init__(self, fault: InjectedFault, name: str, callback: Callable[..., Any]) -> None:
        self._fault = fault
        self._callback = callback
        self._asked = FieldChange(fault) if fault.is_at("request", name) else None
        self._said = FieldChange(fault) if fault.is_at("response", name) else None
        self.count = 0
        functools.update_wrapper(self, callback)

    def __call__(self, request: Any, response: Any) -> Any:
        """As rclpy calls it."""
        self.count += 1
        request = self._asked(request) if self._asked else request
        answer = self._callback(request, response)
        return self._said(answer) if self._said else answer

    @property
    def is_silent(self) -> bool:
        """Whether the answer that is ready now is not sent."""
        operator = self._fault.operator
        silent = self._said is not None and (
            (operator == "no_second" and self.count == 2)
            or (operator == "stops_after" and self.count > STOPS_AFTER)
        )
        if silent:
            self._fault.acts()
        return silent


def around_services(fault: InjectedFault) -> None:
    """Those that a node serves."""
    node = importlib.import_module("rclpy.node").Node

    @over(node, "create_service")
    def create_service(
        old: Any, self: Any, srv_type: Any, srv_name: str, callback: Any, **rest: Any
    ) -> Any:
        full = self.resolve_service_name(srv_name)
        here = fault.is_at("request", full) or fault.is_at("response", full)
        if is_coroutine(callback) or not here:
            return old(self, srv_type, srv_name, callback, **rest)
        answering = Answering(fault, full, callback)
        service = old(self, srv_type, srv_name, answering, **rest)
        send = service.send_response

        def send_response(response: Any, header: Any) -> None:
            if not answering.is_silent:
                send(response, header)

        service.send_response = send_response
        return service


def around_clients(fault: InjectedFault) -> None:
    """Those that ask."""
    node = importlib.import_module("rclpy.node").Node

    @over(node, "create_client")
    def create_client(old: Any, self: Any, srv_type: Any, srv_name: str, **rest: Any) -> Any:
        client = old(self, srv_type, srv_name, **rest)
        if fault.is_at("asked", self.resolve_service_name(srv_name)):
            change, ask = FieldChange(fault), client.call_async

            def call_async(request: Any) -> Any:
                if fault.operator == "twice":
                    fault.acts()
                    ask(request)
                return ask(change(request))

            client.call_async = call_async
        return client


class Performing:
    """The callbacks of an action server, with one change in what they get or give."""

    def __init__(self, fault: InjectedFault, name: str) -> None:
        self._fault = fault
        self._name = name
        self._goal = FieldChange(fault)
        self._result = FieldChange(fault)
        self._feedback = Stream(fault)
        self._cancels = 0

    def execute(self, callback: Callable[[Any], Any]) -> Callable[[Any], Any]:
        """What carries out a goal."""

        @functools.wraps(callback)
        def called(handle: Any) -> Any:
            self._prepare(handle)
            return self._of(callback(handle))

        @functools.wraps(callback)
        async def awaited(handle: Any) -> Any:
            self._prepare(handle)
            return self._of(await callback(handle))

        return awaited if is_coroutine(callback) else called

    def cancel(self, callback: Callable[[Any], Any]) -> Callable[[Any], Any]:
        """What answers a request to cancel."""

        @functools.wraps(callback)
        def called(handle: Any) -> Any:
            self._cancels += 1
            answer = callback(handle)
            if self._fault.operator == "second_cancel_refused" and self._cancels > 1:
                self._fault.acts()
                return type(answer).REJECT
            return answer

        return callback if is_coroutine(callback) else called

    def _prepare(self, handle: Any) -> None:
        if self._fault.is_at("goal", self._name):
            handle._goal_request = self._goal(handle.request)
        if self._fault.is_at("feedback", self._name):
            self._watch(handle)

    def _watch(self, handle: Any) -> None:
        tell = handle.publish_feedback

        def publish_feedback(message: Any) -> None:
            for each in self._feedback(message):
                tell(each)

        handle.publish_feedback = publish_feedback

    def _of(self, result: Any) -> Any:
        return self._result(result) if self._fault.is_at("result", self._name) else result


def around_actions(fault: InjectedFault) -> None:
    """Action servers and their clients."""
    actions = importlib.import_module("rclpy.action")

    @over(actions.ActionServer, "__init__")
    def server(
        old: Any,
        self: Any,
        node: Any,
        action_type: Any,
        action_name: str,
        execute_callback: Any,
        **rest: Any,
    ) -> None:
        full = node.resolve_service_name(action_name)
        performing = Performing(fault, full)
        if "cancel_callback" in rest and fault.is_at("cancel", full):
            rest["cancel_callback"] = performing.cancel(rest["cancel_callback"])
        execute = performing.execute(execute_callback)
        old(self, node, action_type, action_name, execute, **rest)

    @over(actions.ActionClient, "send_goal_async")
    def send_goal_async(old: Any, self: Any, goal: Any, *rest: Any, **named: Any) -> Any:
        if not fault.is_at("ordered", f"/{self._action_name.lstrip('/')}"):
            return old(self, goal, *rest, **named)
        return old(self, FieldChange(fault)(goal), *rest, **named)


def other_default(value: Any) -> Any:
    """Of the same type, and another one."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, float):
        return value * 10 or 1.0
    if isinstance(value, int):
        return value * 10 or 1
    return f"{value}_other" if isinstance(value, str) else value


def around_parameters(fault: InjectedFault) -> None:
    """How parameters are declared, described and set."""
    if fault.kind not in ("parameter", "everywhere"):
        return
    node = importlib.import_module("rclpy.node").Node

    @over(node, "declare_parameters")
    def declare_parameters(
        old: Any, self: Any, namespace: str, parameters: Any, *rest: Any, **named: Any
    ) -> Any:
        declared = [_declared(fault, each) for each in parameters]
        return old(self, namespace, declared, *rest, **named)

    @over(node, "describe_parameters")
    def describe_parameters(old: Any, self: Any, names: Any) -> Any:
        return [_described(fault, each) for each in old(self, names)]

    changes = [0]

    @over(node, "set_parameters_atomically")
    def set_parameters_atomically(old: Any, self: Any, parameter_list: Any) -> Any:
        ours = [each for each in parameter_list if each.name == fault.at]
        changes[0] += bool(ours)
        if ours and fault.operator == "second_change_only" and changes[0] == 1:
            return _success(fault)
        result = old(self, parameter_list)
        if ours and not result.successful and _is_let_in(fault, ours[0].value):
            self._parameters[fault.at] = ours[0]
            return _success(fault)
        return result


def _declared(fault: InjectedFault, words: Any) -> Any:
    name, *rest = words
    if name != fault.at or fault.operator != "other_default" or not rest:
        return words
    fault.acts()
    return (name, other_default(rest[0]), *rest[1:])


def _described(fault: InjectedFault, descriptor: Any) -> Any:
    if descriptor.name != fault.at or fault.operator != "not_described":
        return descriptor
    changed = copy.deepcopy(descriptor)
    changed.floating_point_range, changed.integer_range = [], []
    if changed != descriptor:
        fault.acts()
    return changed


def _is_let_in(fault: InjectedFault, value: Any) -> bool:
    number = value if isinstance(value, float) else 0.0
    return (
        fault.operator == "bound_ignored"
        or (fault.operator == "nan_let_in" and math.isnan(number))
        or (fault.operator == "infinity_let_in" and math.isinf(number))
    )


def _success(fault: InjectedFault) -> Any:
    fault.acts()
    messages = importlib.import_module("rcl_interfaces.msg")
    return messages.SetParametersResult(successful=True)


def around_nodes(fault: InjectedFault) -> None:
    """What a node is beside what it says: endpoints that nobody asked for, and its end."""
    node = importlib.import_module("rclpy.node").Node
    if fault.operator == "extra_ends":

        @over(node, "__init__")
        def init(old: Any, self: Any, *words: Any, **named: Any) -> None:
            old(self, *words, **named)
            _add_ends(fault, self)

    if fault.operator == "exit_code":
        atexit.register(_exit_with_code, fault)
    if fault.operator == "ends_late":
        atexit.register(_wait_at_the_end, fault)


def _add_ends(fault: InjectedFault, node: Any) -> None:
    kind = importlib.import_module("std_msgs.msg").String
    node.create_publisher(kind, "boundary_said", 10)
    node.create_subscription(kind, "boundary_heard", lambda message: None, 10)
    fault.acts()


def _exit_with_code(fault: InjectedFault) -> None:
    fault.acts()
    sys.stdout.flush()
    os._exit(EXIT_CODE)


def _wait_at_the_end(fault: InjectedFault) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    fault.acts()
    time.sleep(ENDS_LATE_S)


def around_bags(fault: InjectedFault) -> None:
    """A program that reads a bag: messages on their way out of the file."""
    if fault.kind not in ("read", "everywhere"):
        return
    try:
        reader = importlib.import_module("rosbag2_py").SequentialReader
    except ImportError:  # it reads no bags
        return
    dropping: dict[str, Stream] = {}

    @over(reader, "read_next")
    def read_next(old: Any, self: Any) -> Any:
        while True:
            topic, content, stamp = old(self)
            stream = dropping.setdefault(topic, Stream(fault))
            passes = fault.field or not fault.is_at("read", topic) or stream(content)
            if passes or not self.has_next():
                return topic, content, stamp

    serialization: Any = importlib.import_module("rclpy.serialization")
    change = FieldChange(fault)
    old_deserialize = serialization.deserialize_message

    @functools.wraps(old_deserialize)
    def deserialize_message(content: Any, kind: Any) -> Any:
        message = old_deserialize(content, kind)
        return change(message) if kind.__name__ == fault.other else message

    if fault.field:
        serialization.deserialize_message = deserialize_message


def install(words: Mapping[str, str]) -> None:
    """Let a fault go wrong from now on, in the program that it is for."""
    program = Path(sys.argv[0]).name
    if words["executable"] not in ("", program):
        return
    fault = InjectedFault(words)
    if fault.operator == "neutral":
        fault.acts()
    for around in (
        around_topics,
        around_services,
        around_actions,
        around_parameters,
        around_nodes,
        around_bags,
    ):
        around(fault)
