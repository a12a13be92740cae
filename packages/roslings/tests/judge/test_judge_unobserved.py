"""Nobody behaves for the camera: what the listener wrote while nothing of ours was there."""

from __future__ import annotations

from dataclasses import replace

import pytest

from roslings.course import lab
from roslings.evidence import Endpoint, ExperimentSeen, GraphSeen, LogLine, ProcessSeen, Qos, Spoken
from roslings.judge.faults import Fault, Inconclusive
from roslings.judge.faults.unobserved import SpeaksOnlyWhenObserved, WritesWhatWasNotSent
from roslings.judge.unobserved import speak_unobserved
from roslings.judge.views import ExperimentView
from roslings.seen.log_rates import written_hz

CARD = lab("topics").card
TALKER, LISTENER = CARD.node("talker"), CARD.node("listener")
CHATTER, HEARD = TALKER.publishes[0], LISTENER.subscribes[0]
QOS = Qos(reliability="reliable", durability="volatile", depth=10)


def lines(hz: float, count: int) -> list[LogLine]:
    """What a listener writes that hears so many messages."""
    return [
        LogLine(arrival_ns=int(n * 1e9 / hz), text=f"[INFO] I heard: 'it {n}'", source="terminal")
        for n in range(count)
    ]


def alone(kind: str, said: str = "amber 1", reliability: str = "reliable") -> ExperimentView:
    """A node alone, observed; a listener repeats what was said to it."""
    qos = replace(QOS, reliability=reliability)
    name = "talker" if kind == "publisher" else "listener"
    end = Endpoint(
        node=f"/{name}", topic=CHATTER.topic, type=CHATTER.type, kind=kind, qos=qos, gid="1"
    )
    text = LogLine(arrival_ns=1, text="I heard: 'amber 1'", source="terminal")
    spoken = Spoken(
        topic=CHATTER.topic,
        type=CHATTER.type,
        content={"data": said},
        sent_ns=0,
        matched=True,
        offered=QOS,
    )
    seen = ExperimentSeen(
        name=name,
        clock="wall",
        graph=GraphSeen(nodes=[f"/{name}"], endpoints=[end]),
        processes={name: ProcessSeen(executable=name, started_ns=0, lines=[text])},
        spoken=[spoken],
    )
    return ExperimentView(seen)


def unobserved(
    written: list[LogLine], fault: str | None = None, sent: list[LogLine] | None = None
) -> ExperimentView:
    """Both together, and nobody else; `sent` came at the times of messages on the network."""
    shown = {} if sent is None else {CHATTER.topic: [line.arrival_ns for line in sent]}
    process = ProcessSeen(executable="listener", started_ns=0, lines=written)
    seen = ExperimentSeen(
        name="unobserved",
        clock="wall",
        processes={"listener": process},
        machine_fault=fault,
        sent_ns=shown,
    )
    return ExperimentView(seen)


def judged(
    view: ExperimentView,
    talking: ExperimentView | None = None,
    hearing: ExperimentView | None = None,
) -> None:
    """Raises the fault."""
    talking, hearing = talking or alone("publisher"), hearing or alone("subscription")
    view.must(speak_unobserved(talking, hearing, (TALKER, LISTENER), (CHATTER, HEARD)))


@pytest.mark.parametrize("written", [[], lines(2, 4), lines(1, 12)])
def test_a_talker_that_is_slower_unobserved_is_told(written: list[LogLine]) -> None:
    """Silent, nearly so, or half as fast."""
    with pytest.raises(SpeaksOnlyWhenObserved) as told:
        judged(unobserved(written))
    assert all((told.value.expected, told.value.measured, told.value.why, told.value.hint))


@pytest.mark.parametrize("sent", [[], lines(1, 4), lines(1, 10)])
def test_a_listener_that_writes_what_it_never_heard_is_told(sent: list[LogLine]) -> None:
    """Its lines come often enough, and the network carried less."""
    with pytest.raises(WritesWhatWasNotSent) as told:
        judged(unobserved(lines(2, 10), sent=sent))
    assert all((told.value.expected, told.value.measured, told.value.why, told.value.hint))


def test_an_honest_talker_passes() -> None:
    """Also one whose lines come unevenly."""
    judged(unobserved(lines(1.6, 9), sent=lines(2, 12)))
    judged(unobserved(lines(2, 5)))
    judged(unobserved(lines(1.6, 9)))


def test_it_is_not_judged_where_it_was_not_made() -> None:
    """A student's own check."""
    judged(ExperimentView(ExperimentSeen(name="unobserved", clock="wall")))


def test_what_keeps_the_two_apart_costs_its_own_points() -> None:
    """A talker that is best effort, and a listener that repeats nothing."""
    judged(unobserved([]), talking=alone("publisher", reliability="best_effort"))
    judged(unobserved([]), hearing=alone("subscription", said="something else"))


def test_a_busy_machine_is_no_fault() -> None:
    """It cannot be told, and is no zero."""
    with pytest.raises(Inconclusive):
        judged(unobserved(lines(1, 6), fault="your nodes waited 3 s for a free processor"))


def test_the_rate_of_lines_is_of_the_cards_line_alone() -> None:
    """What else is written does not count."""
    noise = [LogLine(arrival_ns=n, text="hello", source="terminal") for n in range(50)]
    assert written_hz([*noise, *lines(2, 9)], LISTENER) == pytest.approx(2)
    assert written_hz(noise, LISTENER) is None
    assert issubclass(SpeaksOnlyWhenObserved, Fault)
