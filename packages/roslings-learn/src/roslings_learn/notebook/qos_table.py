"""What matches what, as a table to play with: each choice is tried by a real pair.

A publisher and a subscription with the chosen quality of service are made in this notebook's
domain. What ROS tells the subscription stands below the table.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from importlib.util import find_spec
from typing import Any

from roslings_learn.lessons.qos import RULES, PolicyRule, broken_rules
from roslings_learn.notebook.picture import in_a_notebook
from roslings_learn.notebook.place import on_the_site

LINK = (
    '<p>Here nothing can be tried. <a href="../../reference/qos.html">What matches what</a>'
    " is a page of its own.</p>"
)
TOPIC = "what_matches"
NAMES = {"LIVELINESS": "liveliness or lease duration"}
"""The middleware has one name for both."""


@dataclass(frozen=True)
class Meeting:
    """What ROS told a subscription about a publisher."""

    matched: bool
    failed: str = ""
    """The rule that failed, by ROS's name; of several, one."""


def qos_table() -> None:
    """Show the rules, and let the reader try pairs.

    Without widgets the rules are printed. Raises nothing of its own.
    """
    if on_the_site():
        from IPython.display import HTML, display

        display(HTML(LINK))
    elif in_a_notebook() and find_spec("ipywidgets") is not None:
        from IPython.display import display

        display(_Shown())
    else:
        print(as_text())


def as_text() -> str:
    """The rules, a line each, from weak to strong."""
    rows = [f"{rule.title:16}{' < '.join(each.words for each in rule.choices)}" for rule in RULES]
    return "\n".join([*rows, "The offer must be at least as strong as what is asked."])


# --- what ROS says -----------------------------------------------------------------------------


def meet(offered: Mapping[str, str], asked: Mapping[str, str]) -> Meeting:
    """Join a real publisher and a real subscription; both map a rule's name to a choice's words.

    Raises StillWaiting where neither event comes.
    """
    from rclpy.event_handler import SubscriptionEventCallbacks
    from std_msgs.msg import Empty

    from roslings_learn.notebook.session import session

    told: list[Meeting] = []
    events = SubscriptionEventCallbacks(
        matched=lambda event: told.append(Meeting(matched=True)),
        incompatible_qos=lambda event: told.append(Meeting(False, _failed(event))),
    )
    with session() as ros:
        node = ros.node("asker")
        node.create_subscription(Empty, TOPIC, _ignore, profile(asked), event_callbacks=events)
        ros.node("offerer").create_publisher(
            Empty, TOPIC, profile(offered), event_callbacks=_quiet()
        )
        ros.until(lambda: told, "an event about the pair")
    return told[0]


def _ignore(message: Any) -> None:
    """Nothing is said on this topic."""


def _quiet() -> Any:
    """Without these, rclpy writes a warning of its own below the table."""
    from rclpy.event_handler import PublisherEventCallbacks

    return PublisherEventCallbacks(incompatible_qos=_ignore)


def _failed(event: Any) -> str:
    name = str(event.last_policy_kind.name).removeprefix("RMW_QOS_POLICY_")
    return NAMES.get(name, name.lower())


def profile(choices: Mapping[str, str]) -> Any:
    """The choices as a QoSProfile. Raises KeyError where one is unknown."""
    from rclpy.qos import QoSProfile

    values = {rule.name: _value(rule, choices[rule.name]) for rule in RULES}
    return QoSProfile(depth=1, **{name: value for name, value in values.items() if value})


def _value(rule: PolicyRule, words: str) -> Any:
    from rclpy import qos
    from rclpy.duration import Duration

    value = rule.value(words)
    if isinstance(value, str):
        return getattr(qos, f"{rule.title.title()}Policy")[value]
    return None if value is None else Duration(seconds=value)


# --- as widgets --------------------------------------------------------------------------------


class _Shown:
    """What the notebook shows; where widgets cannot be drawn, the plain text."""

    def __init__(self) -> None:
        self._table = QosTable()

    def _repr_mimebundle_(self, **words: Any) -> Any:
        bundle = self._table.box._repr_mimebundle_(**words)
        return {**bundle, "text/plain": as_text()} if isinstance(bundle, dict) else bundle


class QosTable:
    """Two lists a rule, and a line that says what ROS made of them."""

    def __init__(self) -> None:
        from ipywidgets import HTML, VBox

        self.offered = {rule.name: _choose(rule, "offers") for rule in RULES}
        self.asked = {rule.name: _choose(rule, "asks for") for rule in RULES}
        self.says = HTML()
        rows = [self._row(rule) for rule in RULES]
        self.box = VBox([*rows, self.says])
        for each in (*self.offered.values(), *self.asked.values()):
            each.observe(lambda change: self.look(), names="value")
        self.look()

    def _row(self, rule: PolicyRule) -> Any:
        from ipywidgets import HBox

        return HBox(
            [self.offered[rule.name], self.asked[rule.name]], layout={"flex_flow": "row wrap"}
        )

    def look(self) -> None:
        """Ask ROS about the pair that is chosen now, and write down what it says."""
        offered = {name: each.value for name, each in self.offered.items()}
        asked = {name: each.value for name, each in self.asked.items()}
        self.says.value = _as_html(meet(offered, asked), broken_rules(offered, asked))


def _choose(rule: PolicyRule, does: str) -> Any:
    from ipywidgets import Dropdown

    return Dropdown(
        options=[choice.words for choice in rule.choices],
        description=f"{rule.title}: {'publisher' if does == 'offers' else 'subscription'} {does}",
        style={"description_width": "20em"},
        layout={"width": "32em", "max_width": "100%"},
    )


def _as_html(meeting: Meeting, broken: list[PolicyRule]) -> str:
    if meeting.matched:
        return '<p role="status">ROS says: <b>matched</b>. Messages come.</p>'
    said = f"ROS says: <b>incompatible QoS</b>, {escape(meeting.failed)}. No message comes."
    why = "".join(f"<li><b>{rule.title}</b>: {escape(rule.broken)}</li>" for rule in broken)
    return f'<div role="status"><p>{said}</p><ul>{why}</ul></div>'
