"""Goals given and taken, on a domain of their own: both sides are the probe's."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings.capabilities.actions.goals import GoalGiver, GoalTaker, read_actions
from roslings.capabilities.actions.record import ActionsSeen
from roslings.evidence import ExperimentSeen
from roslings.probe import Probe
from roslings.probe.content import UnknownType, message_class
from skips import imported

imported("test_msgs.action")  # the only action type that has wheels
FIBONACCI = "test_msgs/action/Fibonacci"
WITHIN_S = 20.0


@pytest.fixture
def probe(monkeypatch: pytest.MonkeyPatch) -> Iterator[Probe]:
    """A probe on a domain where nothing runs."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    seen = ExperimentSeen(name="actions", clock="wall")
    with leased_domain() as domain, Probe(domain, seen, record=False) as running:
        yield running


@pytest.fixture
def giver(probe: Probe) -> Iterator[GoalGiver]:
    """A client of `/count`."""
    with GoalGiver(probe, "/count", FIBONACCI) as each:
        yield each


def test_a_goal_is_followed_to_its_end(probe: Probe, giver: GoalGiver) -> None:
    """Accepted, with a result, and the state in words."""
    with GoalTaker(probe, "/count", FIBONACCI) as taker:
        assert probe.until(lambda: giver.ready, WITHIN_S)
        goal = giver.give({"order": 3}, "first")
        assert goal.await_answer(WITHIN_S, lambda: True)
        assert probe.until(lambda: taker.has_goal, WITHIN_S)
        assert not goal.ended
        taker.end("succeed", {"sequence": [0, 1, 1]})
        assert probe.until(lambda: goal.ended, WITHIN_S)
    seen = probe.seen.part(ActionsSeen).goals[0]
    assert (seen.part, seen.accepted, seen.status) == ("first", True, "succeeded")
    assert seen.result == {"sequence": [0, 1, 1]}
    assert seen.sent_ns <= (seen.answered_ns or 0) <= (seen.ended_ns or 0)
    assert probe.seen.part(ActionsSeen).orders[0].goal == {"order": 3}


def test_an_aborted_goal_is_told_from_a_reached_one(probe: Probe, giver: GoalGiver) -> None:
    """By its state."""
    with GoalTaker(probe, "/count", FIBONACCI) as taker:
        assert probe.until(lambda: giver.ready, WITHIN_S)
        goal = giver.give({"order": 3}, "first")
        goal.await_answer(WITHIN_S, lambda: True)
        probe.until(lambda: taker.has_goal, WITHIN_S)
        taker.end("abort", {})
        assert probe.until(lambda: goal.ended, WITHIN_S)
    assert goal.seen.status == "aborted"


def test_a_refused_goal_has_no_end(probe: Probe, giver: GoalGiver) -> None:
    """And a server without a cancel function refuses that, too."""
    with GoalTaker(probe, "/count", FIBONACCI, accepts=False):
        assert probe.until(lambda: giver.ready, WITHIN_S)
        goal = giver.give({"order": 3}, "first")
        assert not goal.await_answer(WITHIN_S, lambda: True)
        goal.cancel()
        assert probe.until(lambda: goal.ended or goal.seen.cancel_answered_ns, WITHIN_S)
    assert (goal.seen.accepted, goal.seen.cancel_accepted, goal.seen.ended_ns) == (
        False,
        False,
        None,
    )


def test_both_sides_are_found_in_the_graph(probe: Probe, giver: GoalGiver) -> None:
    """With the type of the action, not of its hidden parts."""
    with GoalTaker(probe, "/count", FIBONACCI):
        name = probe.node.get_fully_qualified_name()
        assert probe.until(lambda: bool(read_actions(probe.node, [name])), WITHIN_S)
        ends = read_actions(probe.node, [name, "/nobody"])
    assert {(end.kind, end.action, end.type) for end in ends} == {("server", "/count", FIBONACCI)}


def test_the_parts_of_an_action_have_classes() -> None:
    """Their names in the graph are not those of the modules."""
    assert message_class(f"{FIBONACCI}_FeedbackMessage").get_fields_and_field_types()["goal_id"]
    with pytest.raises(UnknownType):
        message_class("test_msgs/action/Nothing_SendGoal")


def test_a_misspelt_field_is_an_error(giver: GoalGiver) -> None:
    """Not a goal without it."""
    with pytest.raises(AttributeError):
        giver.give({"ordre": 3}, "first")


@pytest.mark.filterwarnings("error::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_server_that_goes_leaves_the_probe_running(probe: Probe) -> None:
    """Again and again, while its executor waits for it."""
    for _ in range(30):
        with GoalTaker(probe, "/count", FIBONACCI):
            pass
    ran: list[str] = []
    probe.between_waits(lambda: ran.append("here"))
    assert ran == ["here"]
