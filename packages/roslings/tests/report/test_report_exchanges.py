"""What capabilities saw, on the page: calls, goals, parameters and lines, a section each."""

from __future__ import annotations

import re

import pytest
from written_evidence import evidence
from written_verdicts import too_slow

from roslings.capabilities.actions.record import GoalSeen
from roslings.capabilities.parameters.record import ParameterSet
from roslings.capabilities.serial.record import BoardSeen, CableLine
from roslings.capabilities.services.record import CallSeen
from roslings.evidence import ExperimentSeen, MessageSeen, TopicSeen
from roslings.report.html import html_of
from roslings.report.html.timeline_svg import Bar, TimelineRow, fields_text, timeline
from seen_with import seen_with

MS = 1_000_000
LIGHT, FLY = "std_srvs/srv/SetBool", "test_msgs/action/Fibonacci"


def page(**fields: object) -> str:
    """The page of one experiment that saw this."""
    seen = seen_with(name="it", clock="wall", **fields)
    return html_of(too_slow(), evidence(seen), [])


def call(at_ms: int, took_ms: int | None, part: str = "") -> CallSeen:
    """One call; None: without an answer."""
    answered = None if took_ms is None else (at_ms + took_ms) * MS
    return CallSeen(
        service="/light",
        type=LIGHT,
        request={"data": True},
        part=part,
        response=None if took_ms is None else {"success": True, "message": "<on>"},
        sent_ns=at_ms * MS,
        answered_ns=answered,
    )


def goal(part: str, **words: object) -> GoalSeen:
    """One goal of 100 ms."""
    usual: dict[str, object] = {
        "id": [1] * 16,
        "sent_ns": 0,
        "answered_ns": 5 * MS,
        "accepted": True,
        "ended_ns": 100 * MS,
        "status": "succeeded",
        "result": {"sequence": [0, 1]},
    }
    return GoalSeen(action="/fly", type=FLY, goal={"order": 2}, part=part, **(usual | words))


def row(text: str, begin: str) -> list[str]:
    """The cells of the row that begins so."""
    rows = re.findall(r"<tr>(.*?)</tr>", text)
    cells = [re.findall(r"<td>(.*?)</td>", each) for each in rows]
    return next(each for each in cells if each and each[0].startswith(begin))


def test_calls_and_their_answers() -> None:
    """Few are told one by one; of many, how many there were, and the slowest."""
    text = page(calls=[call(0, 7), call(20, None), *(call(n, n, "row") for n in range(100, 110))])
    assert "Calls of services" in text
    assert row(text, "/light") == [
        "/light",
        "7.000 ms",
        "data: true",
        "success: true, message: &lt;on&gt;",
    ]
    assert "no answer" in text and "12 calls, 1 without an answer." in text
    assert row(text, "/light, row: 10 calls, the slowest")[1] == "109.0 ms"
    assert text.count('class="bar-missing"') == 2  # on wide paper and on narrow
    assert text.count('class="bar-answered"') == 22


def test_goals_their_feedback_and_their_ends() -> None:
    """Answer, work and feedback in the picture; how it ended in words."""
    told = [
        MessageSeen(
            source_ns=None,
            sequence=None,
            arrival_ns=at * MS,
            size=1,
            content={"goal_id": {"uuid": [number] * 16}},
        )
        for at, number in ((20, 1), (40, 1), (60, 2))
    ]
    topic = "/fly/_action/feedback"
    feedback = TopicSeen(name=topic, type=f"{FLY}_FeedbackMessage", messages=told)
    lost = goal("lost", id=[3] * 16, ended_ns=None, status=None, result=None)
    refused = goal("far", accepted=False, ended_ns=None, status=None, result=None)
    order = goal("", id=[4] * 16, ended_ns=None, status=None, result=None)
    text = page(goals=[goal("near"), lost, refused], orders=[order], topics={topic: feedback})
    assert row(text, "near") == [
        "near",
        "succeeded",
        "100.0 ms",
        "2",
        "order: 2",
        "sequence: [0, 1]",
    ]
    assert row(text, "lost")[1:4] == ["without an end", "-", "0"]
    assert row(text, "far")[1] == "refused"
    assert row(text, "/fly")[1] == "accepted by the grader"
    assert "4 goals: 1 succeeded, 1 without an end, 1 refused, 1 accepted by the grader." in text
    assert text.count('class="bar-missing"') == 2
    assert text.count('class="bar-working"') == 2


def test_parameters_and_what_became_of_them() -> None:
    """Taken, refused with the node's reason, or not answered."""
    words = {"node": "/it", "name": "period", "asked_ns": 0}
    sets = [
        ParameterSet(value=0.5, answered_ns=1, accepted=True, **words),
        ParameterSet(value=-1, answered_ns=1, reason="below 0 & wrong", **words),
        ParameterSet(value="x", **words),
    ]
    text = page(parameter_sets=sets)
    outcomes = re.findall(r"<td>period</td><td>(.*?)</td><td>(.*?)</td>", text)
    assert outcomes == [
        ("0.5", "taken"),
        ("-1", "refused: below 0 &amp; wrong"),
        ("x", "no answer"),
    ]


def test_bad_lines_on_the_cable_are_marked() -> None:
    """A checksum that is wrong, and a line that has no beginning; the first ones are shown."""
    good = ["$M,0,0,0*CDE2", "$M,1,0,0*67B3"] * 5
    texts = [*good, "$M,2,0,0*0000", "M,2,0,0*8961", "<b>"]
    heard = [CableLine(board_s=n, sent_ns=n, text=text) for n, text in enumerate(texts)]
    text = page(board=BoardSeen(heard=heard, rejected=3, lost_bytes=70))
    assert re.findall(r"<mark>(.*?)</mark>", text)[-3:] == [
        "$M,2,0,0*0000",
        "M,2,0,0*8961",
        "&lt;b&gt;",
    ]
    assert "13 lines, 3 refused by the board" in text
    assert "70 bytes were read too late" in text
    assert text.count("$M,0,0,0*CDE2") == 3


@pytest.mark.parametrize("heading", ["Calls of services", "Goals of actions", "Lines on the cable"])
def test_what_nobody_saw_has_no_section(heading: str) -> None:
    """A lab about topics shows topics."""
    assert heading not in html_of(too_slow(), evidence(ExperimentSeen(name="x", clock="wall")), [])


def test_a_picture_says_in_words_what_it_shows() -> None:
    """Also where nothing took any time."""
    drawn = timeline(
        [TimelineRow("a name that is longer than the paper", (Bar(0.0, 0.0),))], "1 call."
    )
    assert 'aria-label="1 call."' in drawn
    assert "a name that is longer t…" in drawn and "a name that i…" in drawn
    assert fields_text({"a": {"b": False}, "c": 1 / 3}) == "a: (b: false), c: 0.3333"
