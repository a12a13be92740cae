"""`prove --boundary`: which faults there are, what each does to a message, and what is told."""

from __future__ import annotations

import asyncio
import inspect
import math
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from geometry_msgs.msg import Twist, Vector3
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Range
from std_msgs.msg import Bool, Int32, String
from std_srvs.srv import SetBool

from few import few_labs
from roslings.course import Lab, all_labs, lab
from roslings.experiment.run_folder import run_folder
from roslings_class.scheduler import BatchProgress
from roslings_prove.boundary import layer
from roslings_prove.boundary import run as running
from roslings_prove.boundary.choice import WANTED, tried
from roslings_prove.boundary.faults import LAYER, BoundaryFault, faults, neutral
from roslings_prove.boundary.fields import MessageField, fields_of
from roslings_prove.boundary.operators import AIMED, FIELD, FLOW, WORDS
from roslings_prove.boundary.run import prove_boundary
from roslings_prove.prove import Proof

EXAMPLE = lab("example")
EVERY_LAB = [pytest.param(each, id=each.name) for each in [*all_labs(), EXAMPLE]]


def fault(
    operator: str, place: str = "", *, kind: str = "sent", other: str = ""
) -> layer.InjectedFault:
    """One in /cmd_vel."""
    return layer.InjectedFault(
        {"kind": kind, "operator": operator, "at": "/cmd_vel", "field": place, "other": other}
    )


def through(operator: str, *messages: Any, field: str = "") -> list[Any]:
    """What comes out of a place where this goes wrong."""
    stream = layer.Stream(fault(operator, field))
    return [out for message in messages for out in stream(message)]


def twist(x: float, y: float = 0.0) -> Twist:
    """A command."""
    return Twist(linear=Vector3(x=x, y=y))


# --- which faults there are --------------------------------------------------------------------


def test_fields_are_those_of_the_type() -> None:
    """Messages in it are gone into; lists, times and constants are no fields."""
    assert fields_of(EXAMPLE, "geometry_msgs/msg/Twist") == [
        MessageField(f"{part}.{axis}", "float") for part in ("linear", "angular") for axis in "xyz"
    ]
    found = {each.path: each.kind for each in fields_of(EXAMPLE, "sensor_msgs/msg/Range")}
    assert found["header.frame_id"] == "string"
    assert found["radiation_type"] == "unsigned"
    assert "ULTRASOUND" not in found
    assert not any("stamp" in path for path in found)
    assert not fields_of(EXAMPLE, "sensor_msgs/msg/JointState")[1:]


def test_fields_of_a_service_and_of_an_own_action() -> None:
    """Each part has its own."""
    assert fields_of(EXAMPLE, "std_srvs/srv/SetBool") == [MessageField("data", "bool")]
    assert [f.path for f in fields_of(EXAMPLE, "std_srvs/srv/SetBool", 1)] == ["success", "message"]
    action = "rover_interfaces/action/DriveTo"
    parts = [[f.path for f in fields_of(lab("actions"), action, part)] for part in range(3)]
    assert parts == [["x", "y", "tolerance"], ["reached", "elapsed"], ["x", "y", "distance"]]


def test_a_type_that_the_course_brings_need_not_be_built(monkeypatch: pytest.MonkeyPatch) -> None:
    """No wheel has that of /tf, and the environment that asks may be without it."""
    monkeypatch.setattr("roslings_prove.boundary.fields._prefixes", list)
    assert fields_of(lab("frames"), "tf2_msgs/msg/TFMessage") == []


def test_a_qos_that_matches_all_the_same_is_no_fault() -> None:
    """A listener that asks for less hears all; a publisher that keeps its last offers more."""
    found = {(f.kind, f.operator) for f in faults(lab("topics")) if f.kind.endswith(" qos")}
    assert found == {("sent qos", "reliability"), ("heard qos", "durability")}


def test_what_nobody_can_tell_is_no_fault() -> None:
    """The first of many, and one that is missing where nothing counts them."""
    state = {f.operator for f in faults(lab("services")) if f.kind == "sent"}
    assert not state & {"drop_first", "drop_second", "late"}
    assert "drop_second" in {f.operator for f in faults(lab("topics")) if f.kind == "sent"}
    commands = {f.operator for f in faults(lab("actions")) if f.kind == "sent"}
    assert "drop_first" not in commands
    assert "late" in commands
    driven = {f.operator for f in faults(lab("wander")) if f.kind in ("sent", "heard")}
    assert not driven & {"twice", "late", "gap", "of_before"}
    assert driven >= {"negated", "nan", "drop_zeros", "stops_after"}
    kept = {f.operator for f in faults(lab("e-stop")) if (f.kind, f.at) == ("sent", "/e_stop")}
    assert "drop_first" in kept


@pytest.mark.parametrize("one", EVERY_LAB)
def test_what_is_tried_is_spread(one: Lab) -> None:
    """All where there are few; half are aimed; each place, field and operator that fits is met."""
    every, chosen = faults(one), tried(one)
    assert len(chosen) == min(WANTED, len(every))
    assert len({each.name for each in chosen}) == len(chosen)
    assert {each.operator for each in every} == {each.operator for each in chosen}
    assert {each.place for each in every} == {each.place for each in chosen}
    if len(every) > WANTED:
        assert sum(each.is_aimed for each in chosen) >= WANTED // 2
    assert tried(one) == chosen


def test_each_operator_has_words_and_is_done() -> None:
    """A word of the tables that the layer does not know would change nothing, unseen."""
    used = {each.operator for one in [*all_labs(), EXAMPLE] for each in faults(one)}
    in_tables = {o for row in FLOW.values() for o in row}
    in_tables |= {o for kinds in FIELD.values() for row in kinds.values() for o in row}
    source = inspect.getsource(layer)
    assert used <= WORDS.keys()
    assert in_tables <= WORDS.keys()
    assert WORDS.keys() >= AIMED
    unknown = {word for word in WORDS if f'"{word}"' not in source}
    assert unknown <= {"reliability", "durability", "ends_after"}  # done by the kind of place


# --- what they do ------------------------------------------------------------------------------

CHANGED: list[tuple[str, list[Any], list[float]]] = [
    ("zero", [0.5], [0.0]),
    ("negated", [0.5, -0.2, 0.0], [-0.5, 0.2, 0.0]),
    ("absolute", [0.5, -0.2], [0.5, 0.2]),
    ("doubled", [0.5], [1.0]),
    ("plus_one", [0.5], [1.5]),
    ("of_before", [0.5, 0.2, 0.1], [0.5, 0.5, 0.2]),
    ("of_first", [0.5, 0.2, 0.1], [0.5, 0.5, 0.5]),
]


@pytest.mark.parametrize(("operator", "sent", "seen"), CHANGED, ids=[c[0] for c in CHANGED])
def test_a_field_changes(operator: str, sent: list[float], seen: list[float]) -> None:
    """And only this field; what was sent is left as it is."""
    messages = [twist(x, 7.0) for x in sent]
    out = through(operator, *messages, field="linear.x")
    assert [each.linear.x for each in out] == seen
    assert {each.linear.y for each in out} == {7.0}
    assert [each.linear.x for each in messages] == sent


def test_a_field_that_is_not_a_number() -> None:
    """Texts and truths have their own changes."""
    assert math.isnan(through("nan", twist(1.0), field="linear.x")[0].linear.x)
    assert through("negated", Bool(data=True), field="data") == [Bool(data=False)]
    assert through("zero", String(data="red"), field="data") == [String()]
    texts = [
        through(o, String(data="red"), field="data")[0].data for o in ("upper", "longer", "shorter")
    ]
    assert texts == ["RED", "reds", "re"]
    repeated = [Bool(data=True), Bool(data=True), Bool(data=False)]
    out = through("turned_when_repeated", *repeated, field="data")
    assert [each.data for each in out] == [True, False, False]


def test_what_a_program_does_not_look_at_changes_nothing(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Of a message that comes in, the fault acts when the field is read; it can be passed on."""
    change = layer.FieldChange(fault("doubled", "linear.x", kind="heard"))
    heard = change(twist(1.0, 2.0))
    assert isinstance(heard, Twist)
    assert heard.linear.y == 2.0
    assert capsys.readouterr().err == ""
    assert heard.linear.x == 2.0
    assert capsys.readouterr().err == f"{layer.MARK}\n"
    heard.linear.x = 3.0
    assert serialize_message(heard) == serialize_message(twist(3.0, 2.0))


def test_two_fields_are_exchanged() -> None:
    """With the one beside it."""
    change = layer.FieldChange(fault("swapped", "linear.x", other="linear.y"))
    assert change(twist(1.0, 2.0)) == twist(2.0, 1.0)


PASSING: list[tuple[str, list[int], list[int]]] = [
    ("neutral", [1, 2], [1, 2]),
    ("drop_first", [1, 2, 3], [2, 3]),
    ("drop_second", [1, 2, 3], [1, 3]),
    ("drop_nth", [*range(1, 12)], [1, 2, 3, 4, 6, 7, 8, 9, 11]),
    ("gap", [*range(1, 28)], [*range(1, 6), *range(10, 26)]),
    ("drop_zeros", [1, 0, 2], [1, 2]),
    ("drop_negatives", [1, -1, 2], [1, 2]),
    ("drop_repeats", [1, 1, 2, 2, 1], [1, 2, 1]),
    ("stops_after", [*range(20)], [*range(layer.STOPS_AFTER)]),
    ("once", [1, 2, 3], [1]),
    ("twice", [1, 2], [1, 1, 2, 2]),
    ("extra_at_start", [1, 2], [0, 1, 2]),
]


@pytest.mark.parametrize(("operator", "sent", "seen"), PASSING, ids=[p[0] for p in PASSING])
def test_messages_pass_or_do_not(operator: str, sent: list[int], seen: list[int]) -> None:
    """Whole messages are lost, or come once more."""
    out = through(operator, *(Int32(data=number) for number in sent))
    assert [each.data for each in out] == seen


@dataclass
class HeardFrom:
    """A publisher whose first subscription comes after some messages."""

    durability: DurabilityPolicy
    silent: int
    sent: list[int] = field(default_factory=list)

    @property
    def qos_profile(self) -> QoSProfile:
        """As rclpy's publisher shows it."""
        return QoSProfile(depth=1, durability=self.durability)

    def get_subscription_count(self) -> int:
        """None at first."""
        return int(len(self.sent) >= self.silent)

    def publish(self, message: Int32) -> None:
        """Keep what comes."""
        self.sent.append(message.data)


@pytest.mark.parametrize(
    ("durability", "sent"),
    [(DurabilityPolicy.VOLATILE, [1, 2, 3, 5]), (DurabilityPolicy.TRANSIENT_LOCAL, [1, 3, 4, 5])],
)
def test_what_nobody_hears_is_no_fault(durability: DurabilityPolicy, sent: list[int]) -> None:
    """The second message that is heard is lost; a topic that keeps its last is heard at once."""
    publisher = HeardFrom(durability, silent=2)
    send = layer.sending(fault("drop_second"), publisher)
    for number in range(1, 6):
        send(Int32(data=number))
    assert publisher.sent == sent


def test_nan_is_lost() -> None:
    """In any field of the message."""
    out = through("drop_nan", Range(range=1.0), Range(range=math.nan), Range(range=math.inf))
    assert [each.range for each in out] == [1.0, math.inf]


def test_a_fault_that_changes_nothing_says_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    """A field that is 0 already cannot become 0: such a package is not wrong."""
    assert through("zero", twist(0.0), field="linear.x") == [twist(0.0)]
    assert capsys.readouterr().err == ""
    through("zero", twist(0.1), twist(0.2), field="linear.x")
    assert capsys.readouterr().err == f"{layer.MARK}\n"


def test_callbacks_keep_their_form() -> None:
    """rclpy looks at a callback's parameters, and awaits what is a coroutine."""
    heard: list[Any] = []

    async def later(message: Any) -> None:
        heard.append(message)

    both = layer.hearing(fault("neutral"), lambda message, info: heard.append((message, info)))
    assert [*inspect.signature(both).parameters] == ["message", "info"]
    both(Int32(data=1), {})
    asyncio.run(layer.hearing(fault("twice"), later)(Int32(data=2)))
    assert heard == [(Int32(data=1), {}), Int32(data=2), Int32(data=2)]


ANSWERS: list[tuple[str, str, str, list[bool]]] = [
    ("response", "negated", "success", [False, False]),
    ("response", "of_first", "message", [True, True]),
    ("request", "zero", "data", [False, False]),
]


@pytest.mark.parametrize(("kind", "operator", "field", "successes"), ANSWERS)
def test_a_service_answers_otherwise(
    kind: str, operator: str, field: str, successes: list[bool]
) -> None:
    """On the way in or out."""

    def answer(request: Any, response: Any) -> Any:
        response.success, response.message = request.data, f"told {request.data}"
        return response

    wrong = fault(operator, field, kind=kind)
    answering = layer.Answering(wrong, "/cmd_vel", answer)
    found = [answering(SetBool.Request(data=True), SetBool.Response()) for _ in range(2)]
    assert [each.success for each in found] == successes
    assert found[1].message == ("told False" if kind == "request" else "told True")


def test_the_second_request_gets_no_answer() -> None:
    """Only this one."""
    answering = layer.Answering(
        fault("no_second", kind="response"), "/cmd_vel", lambda request, response: response
    )
    silent = []
    for _ in range(3):
        answering(SetBool.Request(), SetBool.Response())
        silent.append(answering.is_silent)
    assert silent == [False, True, False]


# --- in a package ------------------------------------------------------------------------------


def test_it_is_put_into_a_package(tmp_path: Path) -> None:
    """The code stays as it is; the layer imports nothing of roslings."""
    package = tmp_path / EXAMPLE.card.package
    shutil.copytree(EXAMPLE.solution, package)
    before = {file: file.read_bytes() for file in package.rglob("*.py")}
    neutral(EXAMPLE).put_into(package)
    new = {file.name for file in package.rglob("*.py") if before.get(file) != file.read_bytes()}
    assert new == {"__init__.py", f"{LAYER}.py"}
    done = subprocess.run(
        [sys.executable, "-c", f"import {EXAMPLE.card.package}.{LAYER} as l; print(l.__file__)"],
        cwd=package,
        env={"PATH": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "No module named 'roslings" not in done.stderr


def only(operator: str) -> Callable[[Lab], list[BoundaryFault]]:
    """The faults of one operator."""
    return lambda one: [each for each in faults(one) if each.operator == operator]


def unseen(standing: BatchProgress) -> None:
    """Nobody looks how far it is."""


def nothing_is_explained(*_: object, **__: object) -> dict[str, Any]:
    """What a lab says of faults that are not tried here would be of none."""
    return {}


def proven(one: Lab, operator: str, monkeypatch: pytest.MonkeyPatch) -> tuple[list[str], list[Any]]:
    """The lines of `prove --boundary` with these faults alone, and its proofs."""
    monkeypatch.setattr(running, "tried", only(operator))
    monkeypatch.setattr(running, "explained", nothing_is_explained)
    with run_folder() as folder:
        told = [*prove_boundary([one], unseen, None, folder / "kept", so_far=False)]
    proofs = [each for each in told if isinstance(each, Proof)]
    return [each.line for each in told if not isinstance(each, Proof)], proofs


@pytest.mark.slow
@pytest.mark.parametrize("operator", ["shorter", "twice"])
def test_what_goes_wrong_is_caught(operator: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """And the layer alone is not."""
    lines, proofs = proven(EXAMPLE, operator, monkeypatch)
    assert [each.line for each in proofs if not each.holds] == [], "\n".join(lines)
    assert any(line.startswith("example: 0 faults never acted") for line in lines), lines


@pytest.mark.slow
@few_labs("one", twice=True)
def test_the_layer_without_a_fault_has_100(one: Lab, monkeypatch: pytest.MonkeyPatch) -> None:
    """It wraps all that any fault wraps, and writes its line, too."""
    lines, proofs = proven(one, "there is none of this name", monkeypatch)
    assert proofs[0].holds, f"{proofs[0].line}\n{lines}"
