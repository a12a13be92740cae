"""Services: which there are, and a form to call one of them."""

from __future__ import annotations

import time
from typing import Any

from ros2_on_pip.interfaces import class_of
from ros2_on_pip.problem import CommandProblem, ServiceNotThere
from ros2_on_pip.yaml_out import YamlOptions, as_yaml
from roslings_desk.asking import ask
from roslings_desk.controls import (
    CheckField,
    NameTable,
    Notice,
    PageText,
    TextField,
    button,
    part,
    tell,
    told,
)
from roslings_desk.form import Form
from roslings_desk.tab import OpenTab

MOST_ROWS = 100
COLUMNS = ("Service", "Type")
SHAPE = YamlOptions(longest=64)
OF_EVERY_NODE = (
    "/describe_parameters",
    "/get_parameter_types",
    "/get_parameters",
    "/get_type_description",
    "/list_parameters",
    "/set_parameters",
    "/set_parameters_atomically",
)
"""Each node offers these by itself."""


class ServicesTab:
    """All services in a table, and a form for the one that was chosen."""

    title, every_s = "Services", 0.5

    def __init__(self) -> None:
        self._chosen = ""
        self._there: dict[str, list[str]] = {}

    def show(self, open_tab: OpenTab) -> None:
        """The table; beside it nothing is chosen yet."""
        self._hub = open_tab.hub
        with part("div", "sides"):
            with part("div", "column"):
                with part("div", "row"):
                    self._wanted = TextField("Find a service", type="search")
                    self._every = CheckField("Also those that each node has")
                self._count = PageText("p", "", "count")
                self._names = NameTable("All services", COLUMNS, self._choose)
            self._side = part("section", "column", aria_label="The chosen service")
        with self._side:
            PageText("p", "Choose a service. Nothing is called before you press Call.", "hint")

    def refresh(self) -> None:
        """The rows anew."""
        found, own = self._hub.desk_node.services(hidden=False), f"/{self._hub.name}/"
        self._there = {name: types for name, types in found.items() if own not in name}
        wanted = {name: types for name, types in self._there.items() if self._is_wanted(name)}
        self._count.say(f"{len(wanted)} of {len(self._there)} services")
        rows = [(name, ", ".join(types)) for name, types in wanted.items()]
        self._names.show(rows[:MOST_ROWS], self._chosen)

    def _is_wanted(self, name: str) -> bool:
        usual = name.endswith(OF_EVERY_NODE) and not self._every.value
        return self._wanted.value.lower() in name.lower() and not usual

    # --- the chosen service ----------------------------------------------------------------

    def _choose(self, service: str) -> None:
        self._chosen = service
        self._side.clear()
        with self._side:
            PageText("h3", service)
            problem = Notice()
            tell(problem, lambda: self._show_form(service))

    def _show_form(self, service: str) -> None:
        """Raises UnknownInterface."""
        type_name = self._there[service][0]
        PageText("p", type_name, "hint")
        cls = class_of(type_name, "srv")
        form = Form(cls.Request)
        trouble = Notice()
        button("Call", told(trouble, lambda: self._ask(service, cls, form)))
        self._state = PageText("p", "", "hint", role="status")
        self._answer = PageText("pre", "", tabindex=0, role="region", aria_label="The answer")

    async def _ask(self, service: str, cls: Any, form: Form) -> None:
        """Raises BadField, ServiceNotThere, ServiceSilent, CallFailed."""
        request, stamps = form.filled()
        if service not in (there := self._hub.desk_node.services()):
            raise ServiceNotThere(service, there)
        for stamp in stamps:
            stamp(self._hub.desk_node.node.get_clock().now().to_msg())
        state, answer = self._state, self._answer
        answer.say("")
        state.say("Waiting for the answer ...")
        began_s = time.monotonic()
        try:
            found = await ask(self._hub, service, cls, request)
        except CommandProblem:
            state.say("")
            raise
        state.say(f"The answer came after {time.monotonic() - began_s:.2f} s.")
        answer.say(as_yaml(found, SHAPE) or "(it has no fields)")
