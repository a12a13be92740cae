"""Actions: which there are, a form for a goal, its feedback, and a button that cancels it."""

from __future__ import annotations

import time
from typing import Any

from ros2_on_pip.interfaces import class_of
from ros2_on_pip.node_parts import by_action
from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.yaml_out import YamlOptions, as_yaml
from roslings_desk.controls import NameTable, Notice, PageText, TextField, button, part, tell, told
from roslings_desk.form import Form
from roslings_desk.hub import Hub
from roslings_desk.sent_goal import NoActionServer, SentGoal
from roslings_desk.tab import OpenTab

MOST_ROWS = 100
COLUMNS = ("Action", "Type")
SHAPE = YamlOptions(longest=64)
LOOK_EVERY_S = 1.0
"""Each look asks for the services of every node."""


class StillRuns(CommandProblem):
    """This page's goal has not ended yet."""

    def __init__(self, action: str) -> None:
        super().__init__(f"Your goal for '{action}' still runs. Wait for its end, or cancel it.")


class NothingRuns(CommandProblem):
    """There is no goal to cancel."""

    def __init__(self) -> None:
        super().__init__("No goal of this page runs, so there is nothing to cancel.")


class ActionsTab:
    """All actions in a table, and a form for a goal of the one that was chosen."""

    title, every_s = "Actions", 0.1

    def __init__(self) -> None:
        self._chosen = ""
        self._there: dict[str, list[str]] = {}
        self._looked_s = 0.0
        self._sent: SentGoal | None = None
        self._drawn: int | None = None
        """So much of the feedback is shown; None where the goal is not accepted yet."""

    def show(self, open_tab: OpenTab) -> None:
        """The table; beside it nothing is chosen yet."""
        self._hub = open_tab.hub
        open_tab.ends.callback(self._let_go)
        with part("div", "sides"):
            with part("div", "column"):
                self._wanted = TextField("Find an action", type="search")
                self._count = PageText("p", "", "count")
                self._names = NameTable("All actions", COLUMNS, self._choose)
            self._side = part("section", "column", aria_label="The chosen action")
        with self._side:
            PageText("p", "Choose an action. Nothing is sent before you press Send goal.", "hint")

    def _let_go(self) -> None:
        if self._sent:
            self._sent.let_go()

    def refresh(self) -> None:
        """The rows anew, and the feedback that came."""
        if time.monotonic() - self._looked_s >= LOOK_EVERY_S:
            self._there = served(self._hub)
            self._looked_s = time.monotonic()
        wanted = {n: t for n, t in self._there.items() if self._wanted.value.lower() in n.lower()}
        self._count.say(f"{len(wanted)} of {len(self._there)} actions")
        rows = [(name, ", ".join(types)) for name, types in wanted.items()]
        self._names.show(rows[:MOST_ROWS], self._chosen)
        self._show_feedback()

    def _show_feedback(self) -> None:
        """What came since the last time: at first, that the server has accepted the goal."""
        sent = self._sent
        if sent is None or not sent.is_accepted:
            return
        if self._drawn is None:
            self._drawn = 0
            self._state.say("The server has accepted the goal. It runs.")
        if sent.feedback_count != self._drawn:
            self._drawn = sent.feedback_count
            self._told.say(f"Feedback: {self._drawn} so far, this is the newest.")
            self._feedback.say(as_yaml(sent.feedback, SHAPE))

    # --- the chosen action -----------------------------------------------------------------

    def _choose(self, action: str) -> None:
        if self._sent and not self._sent.is_over and action != self._sent.action:
            self._state.say(f"Your goal for '{self._sent.action}' still runs. Cancel it first.")
            return
        self._chosen = action
        self._side.clear()
        with self._side:
            PageText("h3", action)
            problem = Notice()
            tell(problem, lambda: self._show_form(action))

    def _show_form(self, action: str) -> None:
        """Raises UnknownInterface."""
        type_name = self._there[action][0]
        PageText("p", type_name, "hint")
        cls = class_of(type_name, "action")
        form = Form(cls.Goal)
        trouble = Notice()
        with part("div", "row"):
            button("Send goal", told(trouble, lambda: self._send(action, cls, form)))
            button("Cancel goal", told(trouble, self._cancel))
        PageText("p", "A goal that still runs is cancelled when you close this page.", "hint")
        self._state = PageText("p", "", "hint", role="status")
        self._told = PageText("p", "", "hint")
        self._feedback = _region("The feedback")
        self._result = _region("The result")

    async def _send(self, action: str, cls: Any, form: Form) -> None:
        """Raises BadField, StillRuns, NoActionServer, ServiceSilent, CallFailed, Rejected."""
        if self._sent and not self._sent.is_over:
            raise StillRuns(self._sent.action)
        goal, stamps = form.filled()
        if action not in (there := served(self._hub)):
            raise NoActionServer(action, there)
        for stamp in stamps:
            stamp(self._hub.desk_node.node.get_clock().now().to_msg())
        self._sent, self._drawn = SentGoal(self._hub, action, cls), None
        state, result = self._state, self._result
        for each in (self._told, self._feedback, result):
            each.say("")
        state.say("The goal was sent ...")
        began_s = time.monotonic()
        try:
            end, found = await self._sent.follow(goal)
        except CommandProblem:
            state.say("")
            raise
        self._show_feedback()
        state.say(f"After {time.monotonic() - began_s:.1f} s {end}.")
        result.say(as_yaml(found, SHAPE) or "(it has no fields)")

    async def _cancel(self) -> None:
        """Raises NothingRuns, ServiceSilent, CallFailed, NotCanceled."""
        sent = self._sent
        if sent is None or sent.is_over or not sent.is_accepted:
            raise NothingRuns
        self._state.say("Asking the server to cancel it ...")
        await sent.cancel()


def served(hub: Hub) -> dict[str, list[str]]:
    """The actions that a node serves, with their types. Clients do not count: ours is one."""
    return {
        name: list(dict.fromkeys(kind for _, kinds in servers for kind in kinds))
        for name, servers in by_action(hub.desk_node, "service")
    }


def _region(name: str) -> PageText:
    PageText("h4", name)
    return PageText("pre", "", tabindex=0, role="region", aria_label=name)
