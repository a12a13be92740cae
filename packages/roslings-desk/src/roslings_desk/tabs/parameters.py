"""Parameters of a node: sliders where it names a range, switches, fields; and the last step undone.

Nothing is asked again and again: what others set is heard on /parameter_events.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from nicegui import background_tasks

from ros2_on_pip.discovery import NodeVanished
from ros2_on_pip.parameters import (
    BOOL,
    DOUBLE,
    INTEGER,
    SERVICE,
    STRING,
    message_of,
    plain,
    word_of,
)
from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.yaml_in import parsed
from ros2_on_pip.yaml_out import dumped
from roslings_desk.asking import ask
from roslings_desk.controls import (
    CheckField,
    ControlField,
    Notice,
    PageText,
    SelectField,
    Slider,
    TextField,
    button,
    part,
    told,
)
from roslings_desk.shown import topic_of
from roslings_desk.tab import OpenTab

EVENTS = "/parameter_events"


class WrongValueType(CommandProblem):
    """What was typed does not fit the parameter's type."""

    def __init__(self, name: str, kind: str, typed: str) -> None:
        super().__init__(
            f"{name} is a parameter of type {kind}, and '{typed}' is none. Type another."
        )


class ValueRefused(CommandProblem):
    """The node did not take the value."""

    def __init__(self, name: str, reason: str) -> None:
        super().__init__(f"The node did not take {name}: {reason or 'it gives no reason'}")


@dataclass
class ParameterRow:
    """One parameter, and its control."""

    name: str
    kind: int
    """As rcl_interfaces/msg/ParameterType counts."""
    value: Any
    """What the node has."""
    control: ControlField
    shown: PageText
    sending: bool = False

    def take(self, value: Any, but_control: bool = False) -> None:
        """The node has this value now."""
        self.value = value
        self.shown.say(f"now {typed_of(self.kind, value)}")
        if not but_control:
            self.control.put(value if self.kind == BOOL else typed_of(self.kind, value))


class ParametersTab:
    """A node is chosen, and its parameters are shown, each with a control that fits its type."""

    title, every_s = "Parameters", 0.2

    def __init__(self) -> None:
        self._node = ""
        self._rows: dict[str, ParameterRow] = {}
        self._before: list[tuple[str, Any]] = []
        self._heard_to = 0

    def show(self, open_tab: OpenTab) -> None:
        """The list of nodes; nothing is chosen yet."""
        self._hub = open_tab.hub
        self._events = open_tab.hear(EVENTS, "rcl_interfaces/msg/ParameterEvent")
        self._trouble = Notice()
        with part("div", "row"):
            self._choice = SelectField("Node")
            button("Undo the last change", told(self._trouble, self._undo))
        self._said = PageText("p", "Choose a node.", "hint", role="status")
        self._list = part("div", "parameters")
        self._wanted = topic_of(open_tab.shown)
        self._choice.on_change(told(self._trouble, self._choose))

    def refresh(self) -> None:
        """Nodes that can be asked, and what others have set. Raises NodeVanished."""
        services = self._hub.desk_node.services(hidden=False)
        nodes = [name.rpartition("/")[0] for name in services if name.endswith(f"/{SERVICE}")]
        self._choice.offer(nodes)
        if self._wanted:
            self._open_wanted(nodes)
        self._hear()
        if self._node and self._node not in nodes:
            raise NodeVanished(self._node)

    def _hear(self) -> None:
        for message in self._events.after(self._heard_to):
            self._heard_to = message.number
            event = self._events.read(message)
            for changed in event.changed_parameters if event.node == self._node else ():
                row = self._rows.get(changed.name)
                if row and not row.sending and plain(changed.value) != row.value:
                    row.take(plain(changed.value))

    # --- the chosen node -------------------------------------------------------------------

    def _open_wanted(self, nodes: Sequence[str]) -> None:
        """What was typed behind the tab's name, as soon as it is there; unless one is chosen."""
        if self._choice.value:
            self._wanted = ""
        elif self._wanted in nodes:
            self._choice.choose(self._wanted)
            background_tasks.create(told(self._trouble, self._choose)(), name=self._wanted)
        else:
            self._said.say(f"No node is called {self._wanted} yet.")

    async def _choose(self) -> None:
        """Raises ServiceSilent, CallFailed."""
        self._node, self._rows, self._before = "", {}, []
        self._list.clear()
        if node := self._choice.value:
            self._said.say(f"Asking {node} ...")
            await self._read(node)

    async def _read(self, node: str) -> None:
        from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters

        listed = await ask(
            self._hub, f"{node}/list_parameters", ListParameters, ListParameters.Request()
        )
        names = sorted(listed.result.names)
        values = await ask(
            self._hub, f"{node}/get_parameters", GetParameters, GetParameters.Request(names=names)
        )
        told_of = await ask(
            self._hub,
            f"{node}/describe_parameters",
            DescribeParameters,
            DescribeParameters.Request(names=names),
        )
        if node == self._choice.value:  # nobody has chosen another one meanwhile
            self._node = node
            self._said.say(f"{node} has {len(names)} parameters.")
            self._show(names, values.values, told_of.descriptors)

    def _show(
        self, names: Sequence[str], values: Sequence[Any], descriptors: Sequence[Any]
    ) -> None:
        with self._list:
            for name, value, descriptor in zip(names, values, descriptors, strict=True):
                with part("div", "parameter"):
                    self._rows[name] = self._made(name, value, descriptor)

    def _made(self, name: str, value: Any, descriptor: Any) -> ParameterRow:
        found = plain(value)
        control = _control(f"{name} ({word_of(value.type)})", value.type, found, descriptor)
        shown = PageText("p", f"now {typed_of(value.type, found)}", "value")
        row = ParameterRow(name, value.type, found, control, shown)
        if descriptor.description:
            PageText("p", descriptor.description, "hint")
        if descriptor.read_only:
            control.disable()
            PageText("p", "It cannot be changed.", "hint")
        else:
            self._connect(row)
        return row

    def _connect(self, row: ParameterRow) -> None:
        """A slider and a switch act at once; what is typed is set by its button."""
        act = told(self._trouble, lambda: self._set(row))
        if isinstance(row.control, TextField):
            button(f"Set {row.name}", act)
        else:
            row.control.on_change(act)

    async def _set(self, row: ParameterRow) -> None:
        """What the control says; while a slider moves on, the newest.

        Raises ValueRefused, ServiceSilent.
        """
        if row.sending:
            return
        self._before.append((row.name, row.value))
        row.sending = True
        try:
            wanted = value_of(row)
            while wanted != row.value:
                await self._send(row, wanted)
                wanted = value_of(row)
        except CommandProblem:
            row.take(row.value, but_control=isinstance(row.control, TextField))
            self._before.pop()
            raise
        finally:
            row.sending = False

    async def _send(self, row: ParameterRow, wanted: Any) -> None:
        from rcl_interfaces.msg import Parameter
        from rcl_interfaces.srv import SetParameters

        asked = SetParameters.Request(
            parameters=[Parameter(name=row.name, value=message_of(wanted))]
        )
        answer = await ask(self._hub, f"{self._node}/set_parameters", SetParameters, asked)
        (result,) = answer.results
        if not result.successful:
            raise ValueRefused(row.name, result.reason)
        row.take(wanted, but_control=True)

    async def _undo(self) -> None:
        """Raises ValueRefused, ServiceSilent."""
        if not self._before:
            self._said.say("There is nothing to undo.")
            return
        name, value = self._before.pop()
        row = self._rows[name]
        await self._send(row, value)
        row.take(value)
        self._said.say(f"{name} is {typed_of(row.kind, value)} again.")


def _control(label: str, kind: int, value: Any, descriptor: Any) -> ControlField:
    ranges = [*descriptor.floating_point_range, *descriptor.integer_range]
    if kind == BOOL:
        return CheckField(label, value)
    if ranges and kind in (INTEGER, DOUBLE):
        span = ranges[0]
        step = span.step or (1 if kind == INTEGER else 0)
        return Slider(label, value, span.from_value, span.to_value, step)
    return TextField(label, typed_of(kind, value))


def typed_of(kind: int, value: Any) -> str:
    """A value as it is typed; a text stands as it is, a list as YAML."""
    if kind == BOOL:
        return str(value).lower()
    if kind in (INTEGER, DOUBLE, STRING):
        return str(value)
    return "not set" if value is None else dumped(value, flow=True).strip()


def value_of(row: ParameterRow) -> Any:
    """What the control says, in the parameter's type. Raises WrongValueType."""
    typed = row.control.value
    if row.kind in (BOOL, STRING):
        return typed
    value = parsed(typed)
    if row.kind == DOUBLE and isinstance(value, int) and not isinstance(value, bool):
        value = float(value)
    if message_of(value).type != row.kind:
        raise WrongValueType(row.name, word_of(row.kind), typed)
    return value
