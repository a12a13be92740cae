"""Which values a node must take and refuse, and what it must do then."""

from __future__ import annotations

import math
from typing import Any

import pytest

from roslings.capabilities.parameters import faults
from roslings.capabilities.parameters.contract import ParameterContract
from roslings.capabilities.parameters.obeying import (
    FIRST,
    act_by_its_values,
    beat_by_its_value,
    take_what_its_card_allows,
)
from roslings.capabilities.parameters.record import ParametersSeen, ParameterTrial
from roslings.capabilities.topics.relay import RelayedValue
from roslings.course import NodeContract, TopicContract
from roslings.evidence import (
    Endpoint,
    ExperimentSeen,
    GraphSeen,
    HeldUpSeen,
    MessageSeen,
    ProcessSeen,
    Qos,
    Spoken,
    TopicSeen,
)
from roslings.judge import ExperimentView, Inconclusive, NothingToJudge

HEARD = TopicContract(topic="/in", type="std_msgs/msg/Float64")
SAID = TopicContract(topic="/out", type="std_msgs/msg/Float64")


def contract(name: str, type_: str, default: Any, **more: Any) -> ParameterContract:
    """A parameter with what matters here."""
    return ParameterContract(
        name=name, type=type_, about="", default=default, tried=default, **more
    )


NODE = NodeContract(
    node="/it",
    executable="it",
    subscribes=(HEARD,),
    publishes=(SAID,),
    parameters=(
        contract("high", "double", 5.0, least=1.0, most=9.0),
        contract("low", "double", 2.0, not_above="high"),
        contract("name", "string", "it", read_only=True),
        contract("beat", "integer", 10, least=1, most=50),
    ),
)
BEFORE = {"high": 5.0, "low": 2.0, "name": "it", "beat": 10}


def trial(accepted: bool, asked: dict[str, Any], at_ns: int = 10, **more: Any) -> ParameterTrial:
    """A request, after which the node says what a right one would say."""
    fields = {
        "part": "p",
        "node": "/it",
        "together": len(asked) > 1,
        "asked_ns": at_ns,
        "answered_ns": at_ns + 1,
        "before": BEFORE,
        "after": {**BEFORE, **asked} if accepted else BEFORE,
    }
    return ParameterTrial(asked=asked, accepted=accepted, **{**fields, **more})


def view(*trials: ParameterTrial, ended: bool = False, **more: Any) -> ExperimentView:
    """An experiment that tried these."""
    seen = ExperimentSeen(
        name="x",
        clock="wall",
        processes={"it": ProcessSeen(executable="it", started_ns=0, ended_by_itself=ended)},
        parts={"parameters": ParametersSeen(trials=list(trials))},
        **more,
    )
    return ExperimentView(seen)


@pytest.mark.parametrize(
    ("accepted", "asked"),
    [
        (True, {"high": 9.0}),
        (False, {"high": 9.01}),
        (False, {"high": 7}),
        (False, {"high": True}),
        (True, {"low": 5.0}),
        (False, {"low": 5.1}),
        (False, {"high": 1.5}),
        (False, {"high": math.nan}),
        (False, {"high": math.inf}),
        (False, {"high": -math.inf}),
        (True, {"high": 1.5, "low": 1.0}),
        (False, {"low": 3.0, "high": 20.0}),
        (False, {"name": "other"}),
    ],
)
def test_the_card_says_what_is_taken(accepted: bool, asked: dict[str, Any]) -> None:
    """What a right node does is right, and the opposite is a fault."""
    demand = take_what_its_card_allows(NODE, "p")
    view(trial(accepted, asked)).must(demand)
    with pytest.raises((faults.SetRefused, faults.WrongValueTaken)):
        view(trial(not accepted, asked)).must(demand)


@pytest.mark.parametrize(
    ("asked", "kind"),
    [
        ({"high": 9.01}, faults.WrongValueTaken),
        ({"high": math.inf}, faults.WrongValueTaken),
        ({"high": math.nan}, faults.NoNumberTaken),
        ({"high": "much"}, faults.WrongTypeTaken),
        ({"low": 6.0}, faults.RuleBroken),
        ({"name": "other"}, faults.ReadOnlyChanged),
    ],
)
def test_each_rule_has_its_own_words(
    asked: dict[str, Any], kind: type[faults.WrongValueTaken]
) -> None:
    """A range, a type, two together, and what is chosen at the start."""
    with pytest.raises(faults.WrongValueTaken) as caught:
        view(trial(True, asked)).must(take_what_its_card_allows(NODE, "p"))
    assert type(caught.value) is kind


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_evidence_that_was_kept_is_judged_alike(value: float) -> None:
    """JSON has no such numbers, so they are texts there; they are no values of another type."""
    taken = trial(True, {"high": value})
    kept = ParametersSeen.model_validate_json(ParametersSeen(trials=[taken]).model_dump_json())
    with pytest.raises(faults.WrongValueTaken) as now:
        view(taken).must(take_what_its_card_allows(NODE, "p"))
    with pytest.raises(faults.WrongValueTaken) as later:
        view(*kept.trials).must(take_what_its_card_allows(NODE, "p"))
    assert (type(later.value), str(later.value)) == (type(now.value), str(now.value))


def test_who_does_not_have_a_parameter_refuses_nothing() -> None:
    """ROS refuses a name that nobody declared: that is no merit of the node."""
    lists = {"/it": ["high", "low", "beat", "nane"]}
    seen = view(trial(False, {"name": "other"}), graph=GraphSeen(nodes=["/it"], endpoints=[]))
    seen.seen.part(ParametersSeen).names.update(lists)
    with pytest.raises(faults.NoParameter, match="nane"):
        seen.must(take_what_its_card_allows(NODE, "p"))


def test_two_that_fit_are_refused() -> None:
    """The hint speaks of the list."""
    with pytest.raises(faults.RefusedTogether, match="refuses: no"):
        tried = trial(False, {"high": 1.5, "low": 1.0}, reason="no")
        view(tried).must(take_what_its_card_allows(NODE, "p"))


def test_what_is_refused_must_not_change_anything() -> None:
    """And what is taken must be there."""
    demand = take_what_its_card_allows(NODE, "p")
    with pytest.raises(faults.RefusedAndChanged):
        view(trial(False, {"high": 20.0}, after={**BEFORE, "low": 1.0})).must(demand)
    with pytest.raises(faults.SetHasNoEffect):
        view(trial(True, {"high": 6.0}, after=BEFORE)).must(demand)


def test_no_answer_is_a_fault_of_its_own() -> None:
    """Whether the node lives on or not; nothing was tried: nothing to judge."""
    demand = take_what_its_card_allows(NODE, "p")
    silent = trial(False, {"high": 20.0}, answered_ns=None)
    with pytest.raises(faults.EndedBySet):
        view(silent, ended=True).must(demand)
    with pytest.raises(faults.SetUnanswered) as caught:
        view(silent).must(demand)
    assert type(caught.value) is faults.SetUnanswered
    with pytest.raises(NothingToJudge):
        view().must(demand)


def spoken(at_ns: int) -> Spoken:
    """A seven, said to the node."""
    return Spoken(
        topic="/in",
        type=HEARD.type,
        content={"data": 7.0},
        sent_ns=at_ns,
        matched=True,
        offered=Qos(),
    )


def message(at_ns: int, data: float = 0.0) -> MessageSeen:
    """What the node published."""
    content = {"data": data}
    return MessageSeen(source_ns=at_ns, sequence=None, arrival_ns=at_ns, size=8, content=content)


def told(*values: float) -> dict[str, Any]:
    """A seven before any request, and one after each; what was published then."""
    end = Endpoint(kind="publisher", node="/it", topic="/out", type=SAID.type, qos=Qos(), gid="")
    messages = [message(20 * n + 7, value) for n, value in enumerate(values)]
    return {
        "graph": GraphSeen(nodes=["/it"], endpoints=[end]),
        "spoken": [spoken(20 * n + 5) for n in range(len(values))],
        "topics": {"/out": TopicSeen(name="/out", type=SAID.type, messages=messages)},
    }


def cut(values: Any, said: Any) -> float:
    """What a right node publishes."""
    return float(min(said["data"], values["high"]))


def test_it_does_what_its_parameters_say() -> None:
    """Before the first request, after one that was taken, and after one that was refused."""
    place = RelayedValue(NODE, "data", SAID, "data")
    taken, refused = trial(True, {"high": 6.0}, 20), trial(False, {"high": 20.0}, 40, part="q")
    refused.before = refused.after = taken.after
    both = (taken, refused)
    for part in (FIRST, "p", "q"):
        view(*both, **told(5.0, 6.0, 6.0)).must(act_by_its_values(place, part, cut))
    with pytest.raises(faults.ActsOtherwise, match="with the defaults"):
        view(*both, **told(7.0, 6.0, 6.0)).must(act_by_its_values(place, FIRST, cut))
    with pytest.raises(faults.ActsOtherwise, match=r"high = 6.0 was set"):
        view(*both, **told(5.0, 5.0, 6.0)).must(act_by_its_values(place, "p", cut))
    with pytest.raises(faults.ActsOnRefused, match=r"high = 20.0 was refused"):
        view(*both, **told(5.0, 6.0, 7.0)).must(act_by_its_values(place, "q", cut))


@pytest.mark.parametrize(("hz", "right"), [(20.0, True), (25.0, False), (10.0, False)])
def test_messages_come_as_often_as_the_parameter_says(hz: float, right: bool) -> None:
    """Not at the old rate, and not at both at once."""
    period_ns = int(1e9 / hz)
    seen = told()
    seen["topics"]["/out"].messages = [message(100 + n * period_ns) for n in range(12)]
    tried = trial(True, {"beat": 20})
    demand = beat_by_its_value(SAID, "beat", "p")
    calm = view(tried, **seen, held_up={"p": HeldUpSeen(cpu_wait_s=0.0, stall_s=0.0)})
    if right:
        calm.must(demand)
        return
    with pytest.raises(faults.ActsOtherwise, match="20 messages a second"):
        calm.must(demand)
    with pytest.raises(Inconclusive):
        view(tried, **seen, held_up={"p": HeldUpSeen(cpu_wait_s=2.0, stall_s=0.0)}).must(demand)
