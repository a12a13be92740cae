"""Clients that end with an error, wait for ever, or write another line: what they are told."""

from __future__ import annotations

import pytest

from roslings.capabilities.services import faults
from roslings.capabilities.services.contract import ServiceContract
from roslings.capabilities.services.demands import ask, give_up
from roslings.capabilities.services.record import ServiceEnd
from roslings.course import GiveUpContract, NodeContract
from roslings.evidence import LogLine, ProcessSeen
from roslings.judge import ExperimentView, during, stay_up
from roslings.judge.faults import EndedWithError, NotLogged, StoppedByItself
from roslings.judge.views import ProcessView
from seen_with import seen_with

LIGHT = ServiceContract.model_validate(
    {
        "service": "/light",
        "type": "std_srvs/srv/SetBool",
        "answers": [{"when": "on", "request": {"data": True}, "response": {}}],
    }
)
NODE = NodeContract(
    node="/visitor",
    executable="visitor",
    calls=(LIGHT,),
    gives_up=GiveUpContract(within_s=5.0, log="No server for /light", exit_code=1),
)
CRASH = ("Traceback (most recent call last):", "AttributeError: no attribute 'on'")


def seen(*lines: str, status: int = 1, type_: str | None = None) -> ExperimentView:
    """A client that wrote these lines and ended; with `type_` it had a client of that type."""
    process = ProcessSeen(
        executable="visitor",
        started_ns=0,
        ended_ns=10**9,
        ended_by_itself=True,
        status=status,
        lines=[LogLine(arrival_ns=0, text=line, source="terminal") for line in lines],
    )
    ends = [ServiceEnd(kind="client", node="/visitor", service="/light", type=type_ or LIGHT.type)]
    return ExperimentView(
        seen_with(name="x", clock="wall", processes={"visitor": process}, services=ends)
    )


def test_a_client_that_ends_with_an_error_is_not_told_to_run_on() -> None:
    """What it should have done, and that it ended before."""
    with pytest.raises(EndedWithError) as fault:
        ask(NODE, LIGHT)(seen(*CRASH))
    assert fault.value.expected == "visitor calls /light"
    assert fault.value.measured == "it ended with an error before that (exit code 1)"
    assert fault.value.log == CRASH


def test_a_client_of_another_type_is_told_its_type() -> None:
    """The name is right; a request of another type does not arrive."""
    with pytest.raises(faults.WrongServiceType) as fault:
        ask(NODE, LIGHT)(seen(type_="std_srvs/srv/Trigger"))
    assert "std_srvs/srv/Trigger" in fault.value.measured
    assert "create_client(...)" in fault.value.hint


def test_a_client_that_asks_nothing_is_asked_where_it_stops() -> None:
    """Name and type are right."""
    with pytest.raises(faults.DidNotAsk) as fault:
        ask(NODE, LIGHT)(seen("done", status=0))
    assert "call_async(request)" in fault.value.hint


@pytest.mark.parametrize(
    ("line", "measured", "hint"),
    [
        ("No server for /lihgt", "the nearest line is", "Compare the two lines"),
        ("good bye", "it wrote 'good bye'", "where the wait for the server gave back False"),
    ],
)
def test_a_line_with_a_slip_is_compared_and_a_missing_one_is_placed(
    line: str, measured: str, hint: str
) -> None:
    """Letter by letter, or where to write it."""
    with pytest.raises(NotLogged) as fault:
        give_up(NODE)(seen(line))
    assert fault.value.expected == "without a server, visitor writes 'No server for /light'"
    assert fault.value.measured.startswith(measured)
    assert hint in fault.value.hint


def test_a_fault_tells_in_which_case_the_node_ended() -> None:
    """The same demand, in a case that the grader names."""
    view = seen("oh")
    process = ProcessView(view.seen.processes["visitor"], view.seen)
    with pytest.raises(StoppedByItself) as fault:
        during("in the rain", stay_up)(process)
    assert fault.value.expected == "in the rain, visitor runs until Ctrl-C"
