"""What is held against a button and a guard, and what against the computer that they run on."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from graders.e_stop import demands, faults
from graders.e_stop.contract import HostsContract, StopContract, package_rows, rows
from graders.e_stop.record import DriveSeen, EStopSeen, HostsSeen, MoveSeen, PressSeen, StopSeen
from graders.e_stop.report import sections
from roslings.capabilities.services.contract import ServiceContract
from roslings.capabilities.services.record import CallSeen, ServicesSeen
from roslings.course import NodeContract, TopicContract
from roslings.evidence import (
    Endpoint,
    Evidence,
    ExperimentSeen,
    GraphSeen,
    HeldUpSeen,
    LogLine,
    MachineSeen,
    MessageSeen,
    PackageSeen,
    ProcessSeen,
    Qos,
    TopicSeen,
)
from roslings.judge import ExperimentView, Inconclusive
from roslings.judge.faults import Fault, NothingToJudge
from ways_to_write import WAYS, written

S = 10**9
MOTORS = TopicContract(topic="/motors", type="geometry_msgs/msg/Twist")
DOOR = TopicContract(topic="/door", type="std_msgs/msg/Bool")
BELL = ServiceContract.model_validate(
    {
        "service": "/ring",
        "type": "std_srvs/srv/SetBool",
        "answers": [
            {"when": "ring", "request": {"data": True}, "response": {}, "state": True},
            {"when": "stop", "request": {"data": False}, "response": {}, "state": False},
        ],
    }
)
COMMAND = {"linear.x": 0.5}
STOPS = {"shut": StopContract(when="the door is open", says="the door", within_s=0.3)}
NODE = NodeContract(node="/porter", executable="porter", log="Stopped: {text}", stops=STOPS)


def view(part: EStopSeen | None = None, **fields: Any) -> ExperimentView:
    """An experiment in which this was seen."""
    parts = {"e_stop": part} if part else {}
    parts |= fields.pop("parts", {})
    return ExperimentView(ExperimentSeen(name="x", clock="wall", parts=parts, **fields))


def moves(*stretches: tuple[float, float, dict[str, float]]) -> list[MoveSeen]:
    """Twenty messages a second, from the first second to the second one."""
    return [
        MoveSeen(at_ns=int(from_s * S) + n * S // 20, fields=fields)
        for from_s, to_s, fields in stretches
        for n in range(1, round((to_s - from_s) * 20) + 1)
    ]


def found(demand: Callable[[ExperimentView], None], seen: ExperimentView) -> type[Exception] | None:
    """What a demand raises: which fault, or that it gives no answer."""
    try:
        demand(seen)
    except Fault as problem:
        return type(problem)
    except (Inconclusive, NothingToJudge) as reason:
        return Inconclusive if isinstance(reason, Inconclusive) else NothingToJudge
    return None


# --- a button ----------------------------------------------------------------------------------


def rung(*said: tuple[float, bool]) -> ExperimentView:
    """Two calls, at 1 s and at 2 s, and what the topic said when."""
    presses = [
        PressSeen(asked={"data": True}, began_ns=S, until_ns=S + S // 2),
        PressSeen(asked={"data": False}, began_ns=2 * S, until_ns=2 * S + S // 2),
    ]
    call = {"service": "/ring", "type": BELL.type, "request": {}, "sent_ns": 0}
    calls = [CallSeen(**call), CallSeen(**call)]
    heard = [
        MessageSeen(
            source_ns=0, sequence=n, arrival_ns=int(at_s * S), size=1, content={"data": value}
        )
        for n, (at_s, value) in enumerate(said)
    ]
    publisher = Endpoint(
        kind="publisher", node="/porter", topic="/door", type=DOOR.type, qos=Qos(), gid="1"
    )
    return view(
        EStopSeen(presses=presses),
        parts={"services": ServicesSeen(calls=calls)},
        graph=GraphSeen(nodes=["/porter"], endpoints=[publisher], services={}),
        topics={"/door": TopicSeen(name="/door", type=DOOR.type, messages=heard)},
    )


@pytest.mark.parametrize(
    ("said", "fault"),
    [
        ([(1.1, True), (2.1, False)], None),
        ([(1.1, False), (2.1, False)], faults.OtherThanPressed),
        ([(1.1, True)], faults.OtherThanPressed),
        ([(1.1, True), (1.2, True), (2.1, False)], faults.OtherThanPressed),
        ([(0.1, True), (0.3, True), (1.1, True), (2.1, False)], faults.SaysMore),
    ],
)
def test_each_call_is_told_once(said: Any, fault: type[Exception] | None) -> None:
    """With its value, and nothing is told without a call but the first message."""
    assert found(demands.tell_each_press(BELL, DOOR), rung(*said)) is fault


@pytest.mark.parametrize(
    ("said_s", "fault"),
    [
        ((1.1, 2.1), None),
        ((1.25, 2.25), None),
        ((1.45, 2.1), None),
        ((1.45, 2.42), faults.ToldLate),
    ],
)
def test_a_press_is_told_at_once(said_s: Any, fault: type[Exception] | None) -> None:
    """At 1.1 s and at 2.1 s it is answered; a busy computer may hold up one of two messages."""
    seen = rung(*((at_s, True) for at_s in said_s))
    times = [(S, S + S // 10), (2 * S, 2 * S + S // 10)]
    calls = seen.seen.part(ServicesSeen).calls
    calls[:] = [
        call.model_copy(update={"sent_ns": sent, "answered_ns": answered})
        for call, (sent, answered) in zip(calls, times, strict=True)
    ]
    bell = BELL.model_copy(update={"within_s": 0.2})
    assert found(demands.tell_at_once(bell, DOOR), seen) is fault


# --- a guard -----------------------------------------------------------------------------------


def driven(seen: list[MoveSeen], sent_s: float = 0.05, held_s: float = 0.0) -> ExperimentView:
    """From 1 s to 3 s nothing speaks against driving; commands come every `sent_s`."""
    drive = DriveSeen(part="a", after="at first", command=COMMAND, began_ns=S, until_ns=3 * S)
    sent = [S + int(n * sent_s * S) for n in range(int(2 / sent_s))]
    held = {"a": HeldUpSeen(cpu_wait_s=held_s, stall_s=0.0)}
    return view(EStopSeen(drives=[drive], moves=seen, sent_ns=sent), held_up=held, patience_s=1.0)


DRIVES = demands.drive(MOTORS, "a", deadline_s=0.4)


@pytest.mark.parametrize(
    ("seen", "fault"),
    [
        (moves((1, 1.2, {}), (1.2, 3, COMMAND)), None),
        ([], faults.TellsTheMotorsNothing),
        (moves((1, 3, {})), faults.StandsStill),
        (moves((1, 3, {"linear.x": 0.4})), faults.OtherCommand),
        (moves((1, 3, {**COMMAND, "angular.z": 0.1})), faults.OtherCommand),
        (moves((1, 2, COMMAND), (2, 2.1, {}), (2.1, 3, COMMAND)), faults.Stutters),
    ],
)
def test_a_guard_passes_on_what_the_operator_wants(
    seen: list[MoveSeen], fault: type[Exception] | None
) -> None:
    """All of it, unchanged, and without a stop in between."""
    assert found(DRIVES, driven(seen)) is fault


BEFORE, MIXED = {"linear.x": -0.3, "angular.z": -0.2}, {"linear.x": 0.5, "angular.z": -0.2}
BOTH = {"linear.x": 0.5, "angular.z": 0.1}


@pytest.mark.parametrize(
    ("between", "fault"),
    [
        ([], None),
        ([(1.1, 1.15, BEFORE)], None),
        ([(1.1, 1.15, MIXED)], faults.OtherCommand),
        ([(1.1, 1.15, {"linear.x": 0.5})], faults.OtherCommand),
    ],
)
def test_no_message_is_of_two_commands(between: Any, fault: type[Exception] | None) -> None:
    """The command before may last a moment, but whole: no field of it stays for a message."""
    seen = moves((1, 1.1, BEFORE), *between, (1.2, 3, BOTH))
    experiment = driven(seen)
    drives = experiment.seen.part(EStopSeen).drives
    drives[0] = drives[0].model_copy(update={"command": BOTH})
    assert found(DRIVES, experiment) is fault


def test_across_a_bad_link_a_short_stop_is_no_fault() -> None:
    """A sign of life may be lost; to stand for ever is one all the same."""
    demand = demands.drive(MOTORS, "a", deadline_s=0.4, steadily=False, again=True)
    assert found(demand, driven(moves((1, 2, COMMAND), (2, 2.2, {}), (2.2, 3, COMMAND)))) is None
    still = moves((1, 3, {}))
    assert found(demand, driven(still)) is faults.DoesNotGoOn
    assert found(demand, driven(still, held_s=3.0)) is faults.DoesNotGoOn
    assert found(demand, driven(still, held_s=5.0)) is Inconclusive


@pytest.mark.parametrize("busy", [{"sent_s": 0.35}, {"held_s": 2.0}])
def test_a_busy_computer_is_not_the_guards_fault(busy: dict[str, float]) -> None:
    """Commands of ours that came late, or a guard that got no processor."""
    assert found(DRIVES, driven(moves((1, 3, {})), **busy)) is Inconclusive


def stopped(seen: list[MoveSeen], held_s: float = 0.0, sent_s: float = 0.0) -> ExperimentView:
    """At 2 s there is a reason to stop, until 4 s; commands come every `sent_s`, or none."""
    sent = [2 * S + int(n * sent_s * S) for n in range(int(2 / sent_s))] if sent_s else []
    stop = StopSeen(
        part="shut", reason="shut", cause="the door opens", began_ns=2 * S, until_ns=4 * S
    )
    held = {"shut": HeldUpSeen(cpu_wait_s=held_s, stall_s=0.0)}
    return view(EStopSeen(stops=[stop], moves=seen, sent_ns=sent), held_up=held)


STANDS = demands.stop_for(MOTORS, "shut", 0.3)


@pytest.mark.parametrize(
    ("seen", "fault"),
    [
        (moves((1, 2.2, COMMAND), (2.2, 4, {})), None),
        (moves((1, 3, COMMAND), (3, 4, {})), faults.StopsLate),
        (moves((1, 2.1, COMMAND), (2.1, 3, {}), (3, 4, COMMAND)), faults.DoesNotStop),
        (moves((1, 4, COMMAND)), faults.DoesNotStop),
        (moves((1, 2, COMMAND)), faults.TellsTheMotorsNothing),
        (moves((1, 4, {})), NothingToJudge),
    ],
)
def test_a_guard_stops_in_time_and_stays_so(
    seen: list[MoveSeen], fault: type[Exception] | None
) -> None:
    """Who stood before has shown nothing."""
    assert found(STANDS, stopped(seen)) is fault


def test_a_late_stop_is_inconclusive_where_the_computer_made_it_late() -> None:
    """So much, and no more."""
    late = moves((1, 3, COMMAND), (3, 4, {}))
    assert found(STANDS, stopped(late, held_s=0.8)) is Inconclusive
    assert found(STANDS, stopped(late, held_s=0.2)) is faults.StopsLate


def test_who_falls_silent_with_a_command_has_not_stopped() -> None:
    """However soon that was."""
    assert found(STANDS, stopped(moves((1, 2.2, COMMAND)), held_s=0.1)) is faults.DoesNotStop


@pytest.mark.parametrize(
    ("sent_s", "held_s", "fault"),
    [
        (0.05, 0.0, faults.SilentMeanwhile),
        (0.7, 0.0, None),
        (0.0, 0.0, None),
        (0.05, 0.8, Inconclusive),
    ],
)
def test_a_guard_that_waits_while_it_stops_is_told(
    sent_s: float, held_s: float, fault: type[Exception] | None
) -> None:
    """Not where who watches was held up as long, or where nobody knows; nor where it was itself."""
    seen = moves((1, 2.2, COMMAND), (3, 4, {}))
    assert found(STANDS, stopped(seen, held_s, sent_s)) is fault


def test_who_was_never_released_drives_nowhere() -> None:
    """And tells the motors so."""
    demand = demands.stand(MOTORS, "shut")
    assert found(demand, stopped(moves((2, 4, {})))) is None
    assert found(demand, stopped(moves((2, 4, COMMAND)))) is faults.DrivesUnasked
    assert found(demand, stopped([])) is faults.TellsTheMotorsNothing


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    ("lines", "fault"),
    [
        ([(2.1, "Stopped: the door")], None),
        ([(2.1, "stopped: the door")], faults.ReasonNotTold),
        ([(1.1, "Stopped: the door")], faults.ReasonNotTold),
        ([(2.1, "Stopped: the door"), (2.6, "Stopped: the door")], faults.ReasonToldAgain),
    ],
)
def test_the_reason_is_told_once(
    lines: list[tuple[float, str]], fault: type[Exception] | None, way: str
) -> None:
    """In the log, when the stop begins."""
    printed = [LogLine(arrival_ns=int(at * S), text=text, source="terminal") for at, text in lines]
    seen = stopped(moves((1, 2, COMMAND), (2, 4, {}))).seen
    seen.processes["porter"] = ProcessSeen(executable="porter", started_ns=0, lines=printed)
    porter = ExperimentView(written(seen, way))
    assert found(demands.tell_why(NODE, STOPS, deadline_s=0.4), porter) is fault


# --- two computers -----------------------------------------------------------------------------


def test_where_there_are_no_two_computers_the_points_are_left_out() -> None:
    """With the reason of the system."""
    seen = view(EStopSeen(hosts=HostsSeen(refused="no tun device")))
    with pytest.raises(Inconclusive, match="no tun device"):
        demands.be_reached(BELL, DOOR)(seen)
    with pytest.raises(Inconclusive, match="no tun device"):
        demands.on_two_computers(DRIVES)(seen)


@pytest.mark.parametrize(
    ("hosts", "fault"),
    [
        (HostsSeen(served=True, heard=[True], matched=True), None),
        (HostsSeen(served=True, heard=[]), faults.NotReached),
        (HostsSeen(served=False, heard=[True]), faults.NotReached),
        (None, NothingToJudge),
    ],
)
def test_both_computers_are_reached(hosts: HostsSeen | None, fault: type[Exception] | None) -> None:
    """By address, for there is no multicast."""
    assert found(demands.be_reached(BELL, DOOR), view(EStopSeen(hosts=hosts))) is fault


def test_the_operator_is_heard_on_the_other_computer() -> None:
    """Or the guard stands there for ever."""
    demand = demands.hear_from_afar(MOTORS)
    assert found(demand, view(EStopSeen(hosts=HostsSeen(matched=True)))) is None
    assert found(demand, view(EStopSeen(hosts=HostsSeen()))) is faults.NotReached


# --- words and pages ---------------------------------------------------------------------------


def test_the_task_tells_each_reason_to_stop() -> None:
    """When, how soon, and in which words."""
    told = [" ".join(row) for row in rows(NODE)]
    assert told == ["stops when the door is open; within 0.3 s; the reason is `the door`"]


def test_the_page_shows_stops_and_the_link() -> None:
    """What moved when, and how many packets were lost."""
    part = stopped(moves((1, 2.2, COMMAND), (2.2, 4, {}))).seen.part(EStopSeen)
    part.hosts = HostsSeen(packets={"passed": 90, "lost": 10, "multicast": 5, "cut": 0})
    evidence = Evidence(
        lab="x",
        seed=1,
        machine=MachineSeen(
            roslings="0", ros_distro="jazzy", rmw="", python="3", platform="x", isolation="domain"
        ),
        package=PackageSeen(name="x", folder="x", build_type="ament_python"),
        experiments={"x": view(part).seen},
    )
    page = "".join(map(str, sections(evidence)))
    for words in ("the door opens", "200.0 ms later", "passed 90 packets, lost 10"):
        assert words in page


def test_a_card_without_two_computers_says_nothing_of_them() -> None:
    """And one with them tells what the link does."""
    assert list(package_rows(SimpleNamespace(hosts=None))) == []  # type: ignore[arg-type]
    hosts = HostsContract(delay_ms=20, loss=0.1, stops_within_s=2.0)
    ((_, told),) = package_rows(SimpleNamespace(hosts=hosts))  # type: ignore[arg-type]
    assert "no multicast, delays each packet by 20 ms and loses 10% of them" in told
