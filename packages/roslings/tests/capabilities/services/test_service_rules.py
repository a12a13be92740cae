"""Late answers, wrong answers and no answers: what is held against whom."""

from __future__ import annotations

from typing import Any

import pytest

from roslings.capabilities.services import faults
from roslings.capabilities.services.contract import ServiceContract
from roslings.capabilities.services.demands import (
    answer_each,
    answer_in_time,
    ask,
    say_at_first,
    serve,
)
from roslings.capabilities.services.record import CallSeen, ServiceEnd, ServicesSeen
from roslings.course import NodeContract, TopicContract
from roslings.evidence import (
    MessageSeen,
    ProcessSeen,
    TopicSeen,
)
from roslings.judge import ExperimentView, Inconclusive
from roslings.judge.views import TopicView
from seen_with import seen_with

LAMP = ServiceContract.model_validate(
    {
        "service": "/light",
        "type": "std_srvs/srv/SetBool",
        "within_s": 0.1,
        "answers": [
            {"when": "on", "request": {"data": True}, "response": {"success": True}},
            {"when": "off", "request": {"data": False}, "response": {"success": True}},
        ],
    }
)
NODE = NodeContract(node="/lamp", executable="lamp", serves=(LAMP,))


def call(took_s: float | None, part: str = "row", success: bool = True) -> CallSeen:
    """One call of the lamp's service."""
    answered_ns = None if took_s is None else int(took_s * 1e9)
    return CallSeen(
        service="/light",
        type=LAMP.type,
        request={"data": True},
        response=None if took_s is None else {"success": success},
        sent_ns=0,
        answered_ns=answered_ns,
        part=part,
    )


def seen(*calls: CallSeen, stall_s: float = 0.0, ended: bool = False) -> ExperimentView:
    """An experiment with these calls."""
    process = ProcessSeen(executable="lamp", started_ns=0, ended_by_itself=ended)
    return ExperimentView(
        seen_with(
            name="x", clock="wall", calls=list(calls), stall_s=stall_s, processes={"lamp": process}
        )
    )


def row(*took_s: float, stall_s: float = 0.0) -> ExperimentView:
    """A row of answers, and how long this computer stood still meanwhile."""
    return seen(*(call(each) for each in took_s), stall_s=stall_s)


in_time = answer_in_time(NODE, LAMP, "row", "in a row", 100)


def test_one_late_answer_in_twenty_is_nobodys_fault() -> None:
    """A computer does other things, too."""
    in_time(row(*[0.002] * 95, *[0.3] * 5))


def test_answers_that_are_all_late_are_the_servers_fault() -> None:
    """Half of them late: a pause of the computer, below half a second, explains that not."""
    with pytest.raises(faults.LateAnswers) as fault:
        in_time(row(*[0.35] * 6, stall_s=0.3))
    assert "6 of 6" in fault.value.measured


def test_a_few_late_answers_on_a_computer_that_stood_still_say_nothing() -> None:
    """No verdict, and the reason."""
    with pytest.raises(Inconclusive, match="stood still"):
        in_time(row(*[0.002] * 94, *[0.25] * 6, stall_s=0.3))


def test_a_few_very_late_answers_are_the_servers_fault() -> None:
    """Late by more than the computer ever stood still."""
    with pytest.raises(faults.LateAnswers):
        in_time(row(*[0.002] * 94, *[0.9] * 6, stall_s=0.1))


def test_a_long_standstill_explains_everything() -> None:
    """Longer than half a second: nothing is held against the server."""
    with pytest.raises(Inconclusive):
        in_time(row(*[0.35] * 6, stall_s=0.8))


each = answer_each(NODE, LAMP)


def test_a_wrong_answer_names_field_and_value() -> None:
    """What was asked, what was wanted, what came."""
    with pytest.raises(faults.WrongAnswer) as fault:
        each(seen(call(0.01, part="/light", success=False)))
    assert fault.value.expected == "/light (data: true) answers success: true"
    assert fault.value.measured == "success: false"


def unanswered(**more: Any) -> ExperimentView:
    """A server that did not answer, and what else was seen of it."""
    ended, clients = bool(more.pop("ended", False)), more.pop("clients", [])
    view = seen(call(None, part="/light"), ended=ended)
    view.seen.part(ServicesSeen).ends.extend(clients)
    return ExperimentView(view.seen.model_copy(update=more))


CLIENT = ServiceEnd(kind="client", node="/lamp", service="/dimmer", type=LAMP.type)


@pytest.mark.parametrize(
    ("view", "kind"),
    [
        (unanswered(), faults.NoAnswer),
        (unanswered(ended=True), faults.EndedInsteadOfAnswering),
        (unanswered(stuck=["/lamp"]), faults.StuckInCallback),
        (unanswered(stuck=["/lamp"], clients=[CLIENT]), faults.Deadlock),
        (unanswered(clients=[CLIENT]), faults.NoAnswer),
    ],
    ids=["turns", "ended", "stuck", "stuck, and a client itself", "turns, and a client itself"],
)
def test_no_answer_has_five_faces(view: ExperimentView, kind: type[faults.NoAnswer]) -> None:
    """Stuck and itself a client is the beginner's deadlock."""
    with pytest.raises(faults.NoAnswer) as fault:
        each(view)
    assert type(fault.value) is kind
    if kind is faults.Deadlock:
        assert "/dimmer" in fault.value.measured


def test_another_service_is_no_slip_of_the_pen() -> None:
    """`/light` is not misspelt `/park`, and a client is no server."""
    other = ServiceEnd(kind="server", node="/lamp", service="/park", type="std_srvs/srv/Trigger")
    asks = ServiceEnd(kind="client", node="/lamp", service="/light", type=LAMP.type)
    view = seen()
    view.seen.recording(ServicesSeen).ends = [other, asks]
    with pytest.raises(faults.NoService) as fault:
        serve(LAMP)(view)
    assert "has a client of /light" in fault.value.measured


@pytest.mark.parametrize(("times", "right"), [(1, True), (2, False)])
def test_a_client_asks_once(times: int, right: bool) -> None:
    """Each request does something."""
    view = seen()
    view.seen.recording(ServicesSeen).served = [call(0.0)] * times
    if right:
        ask(NODE, LAMP)(view)
        return
    with pytest.raises(faults.AskedAgain, match=f"{times} times"):
        ask(NODE, LAMP)(view)


@pytest.mark.parametrize(("first", "right"), [(1.0, True), (0.3, False)])
def test_the_state_of_the_start(first: float, right: bool) -> None:
    """Each message from before the first call."""
    topic = TopicContract(topic="/power", type="std_msgs/msg/Float64")
    messages = [
        MessageSeen(source_ns=None, sequence=None, arrival_ns=n, size=8, content={"data": value})
        for n, value in enumerate((first, 1.0))
    ]
    heard = TopicSeen(name="/power", type=topic.type, messages=messages)
    view = TopicView(topic, "/power", topic.type, heard, seen().seen)
    if right:
        say_at_first(1.0)(view)
        return
    with pytest.raises(faults.WrongState, match="before any call"):
        say_at_first(1.0)(view)
