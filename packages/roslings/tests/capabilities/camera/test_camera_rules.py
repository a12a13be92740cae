"""Pictures that came: what is right, what is a fault, what is open."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from roslings.capabilities.camera.act import MISSING
from roslings.capabilities.camera.demands import (
    begin_so_light,
    come_after,
    follow_brightness,
    hold_whole_rows,
    refuse,
    show_each_once,
    show_what_the_camera_saw,
    tell_of_trouble,
)
from roslings.capabilities.camera.faults import images as camera_faults
from roslings.capabilities.camera.record import PixelsSeen
from roslings.capabilities.parameters.contract import ParameterContract
from roslings.capabilities.parameters.record import ParameterSet
from roslings.course import NodeContract, TopicContract
from roslings.evidence import (
    Endpoint,
    GraphSeen,
    LogLine,
    MessageSeen,
    ProcessSeen,
    Qos,
    StageMark,
    TopicSeen,
)
from roslings.judge import ExperimentView, Fault, Inconclusive, NothingToJudge
from seen_with import seen_with

IMAGE = "sensor_msgs/msg/Image"
FILMED = TopicContract(topic="/eye", type=IMAGE, fields={"step": 1920})
CAMERA = NodeContract(node="/camera", executable="camera", publishes=(FILMED,))
MS = 1_000_000
BRIGHT = ParameterContract(
    name="bright", type="integer", about="", default=50, tried=81, least=0, most=100, live=True
)


def image(at_ms: float, sequence: int, **pixels: Any) -> MessageSeen:
    """One picture; as it should be where nothing else is said."""
    step = pixels.pop("step", 1920)
    whole = {"bytes": 1920 * 480, "level": 100.0, "shows": 0, "off": 0.0}
    content = {
        "step": step,
        "height": 480,
        "width": 640,
        "data": PixelsSeen(**{**whole, **pixels}).model_dump(),
    }
    return MessageSeen(
        source_ns=None, sequence=sequence, arrival_ns=int(at_ms * MS), size=9, content=content
    )


def end(node: str, topic: TopicContract) -> Endpoint:
    """A publisher."""
    return Endpoint(
        kind="publisher", node=node, topic=topic.topic, type=topic.type, qos=Qos(), gid=topic.topic
    )


def filmed(*messages: MessageSeen, sets: tuple[ParameterSet, ...] = ()) -> ExperimentView:
    """An experiment with a camera."""
    seen = seen_with(
        name="filming",
        clock="wall",
        graph=GraphSeen(nodes=["/camera"], endpoints=[end("/camera", FILMED)]),
        topics={"/eye": TopicSeen(name="/eye", type=IMAGE, messages=list(messages))},
        processes={"camera": ProcessSeen(executable="camera", started_ns=0)},
        parameter_sets=list(sets),
    )
    return ExperimentView(seen)


def fault_of(view: Any, *demands: Any) -> type[Fault]:
    """The kind of the fault that is found."""
    with pytest.raises(Fault) as found:
        view.must(*demands)
    words = found.value
    assert words.expected and words.measured and words.why and words.hint
    return type(found.value)


# --- the camera ----------------------------------------------------------------------------------


def test_a_picture_from_after_ctrl_c_is_not_held_against_the_node() -> None:
    """Ctrl-C may come in the middle of a read: what a node that goes on shows is half made."""
    view = filmed(image(0, 1), image(500, 2, off=30.0))
    assert fault_of(view.topic(FILMED), show_what_the_camera_saw) is camera_faults.WrongPicture
    view.seen.processes["camera"].asked_to_end_ns = 400 * MS
    view.topic(FILMED).must(show_what_the_camera_saw)


def test_rows_and_bytes() -> None:
    """A step that is the width, and half of the bytes."""
    filmed(image(0, 1)).topic(FILMED).must(hold_whole_rows)
    for wrong, kind in (
        ({"step": 640}, camera_faults.WrongStep),
        ({"bytes": 1920 * 240}, camera_faults.NotAllBytes),
    ):
        assert fault_of(filmed(image(0, 1, **wrong)).topic(FILMED), hold_whole_rows) is kind


@pytest.mark.parametrize(
    ("pixels", "kind"),
    [
        ({"off": 30.0, "swapped_off": 0.2}, camera_faults.RedAndBlueSwapped),
        ({"off": 30.0, "swapped_off": 28.0}, camera_faults.WrongPicture),
        ({"off": None, "level": None}, camera_faults.WrongPicture),
    ],
)
def test_a_wrong_picture_is_named(pixels: dict[str, Any], kind: type[Fault]) -> None:
    """By what it looks like."""
    view = filmed(image(0, 1), image(60, 2, **pixels)).topic(FILMED)
    assert fault_of(view, show_what_the_camera_saw) is kind


def test_pictures_lost_on_the_way_are_not_the_nodes_fault() -> None:
    """Its own count tells how many there were; the film begins again at its end."""
    sent = [1, 2, 5, 6, 9, 10, 14, 15, 16, 20]
    came = [image(60 * n, n, shows=n % 16) for n in sent]
    filmed(*came).topic(FILMED).must(show_each_once(16))


@pytest.mark.parametrize(
    ("shown", "kind"),
    [
        (lambda n: 3, camera_faults.PictureTwice),
        (lambda n: n // 2 % 16, camera_faults.PictureTwice),
        (lambda n: 2 * n % 16, camera_faults.PicturesLost),
    ],
)
def test_a_film_that_stands_still_or_leaps(shown: Any, kind: type[Fault]) -> None:
    """From message to message."""
    came = [image(60 * n, n, shows=shown(n)) for n in range(1, 13)]
    assert fault_of(filmed(*came).topic(FILMED), show_each_once(16)) is kind


def test_the_light_of_the_start() -> None:
    """Each picture is as much lighter as the value asks for, also the first."""
    demand = begin_so_light("bright", 81, 50, 2.55)
    lit = [image(60 * n, n, lighter=79.0) for n in range(1, 4)]
    filmed(*lit).topic(FILMED).must(demand)
    kind = camera_faults.LightAtStartIgnored
    assert fault_of(filmed(image(0, 0), *lit).topic(FILMED), demand) is kind


def test_too_few_pictures_tell_nothing() -> None:
    """Neither right nor wrong."""
    with pytest.raises(NothingToJudge):
        filmed(image(0, 1), image(60, 2)).topic(FILMED).must(show_each_once(16))


def change(value: Any, asked_ms: int, **answer: Any) -> ParameterSet:
    """A parameter that was set, and taken at once."""
    words = {"answered_ns": (asked_ms + 1) * MS, "accepted": True, **answer}
    return ParameterSet(node="/camera", name="bright", value=value, asked_ns=asked_ms * MS, **words)


def lit(begin_ms: int, **pixels: Any) -> list[MessageSeen]:
    """Ten pictures after a change."""
    return [image(begin_ms + 60 * n, n, **pixels) for n in range(1, 11)]


SETS = (change(51, 0), change(81, 1000))
FOLLOWS = follow_brightness(CAMERA, FILMED, BRIGHT, neutral=50, levels=2.55)


def test_a_brightness_that_acts() -> None:
    """From 51 to 81."""
    pictures = [*lit(0, level=102.0, lighter=2.55), *lit(1000, level=178.0, lighter=79.05)]
    filmed(*pictures, sets=SETS).must(FOLLOWS)


@pytest.mark.parametrize(
    ("after", "kind"),
    [
        ({"level": 102.0, "lighter": 2.55}, camera_faults.BrightnessIgnored),
        ({"level": 140.0, "off": 30.0, "round_off": 0.5}, camera_faults.BrightnessGoesRound),
        ({"level": 125.0, "off": 30.0, "round_off": 31.0}, camera_faults.WrongBrightness),
    ],
)
def test_a_brightness_that_does_not(after: dict[str, Any], kind: type[Fault]) -> None:
    """Ignored, gone round, or only something like it."""
    pictures = [*lit(0, level=102.0, lighter=2.55), *lit(1000, **after)]
    assert fault_of(filmed(*pictures, sets=SETS), FOLLOWS) is kind


def test_a_change_by_one_point_counts() -> None:
    """A node that takes the first change only in words is as light as before it."""
    pictures = [*lit(0, level=100.0), *lit(1000, level=178.0, lighter=79.05)]
    view = filmed(*pictures, sets=SETS)
    with pytest.raises(camera_faults.BrightnessIgnored) as found:
        view.must(FOLLOWS)
    assert (found.value.before, found.value.after, found.value.found) == (50, 51, 0.0)


def test_wrong_values_are_refused() -> None:
    """One that is taken is a fault; so is a node that ends. A node that is silent may be busy."""
    refuses = refuse(CAMERA, BRIGHT)
    refused = change(300, 0, accepted=False, reason="too large")
    filmed(sets=(refused,)).must(refuses)
    assert fault_of(filmed(sets=(change("a", 0),)), refuses) is camera_faults.ParameterAccepted
    ended = filmed(sets=(change("a", 0, accepted=False, answered_ns=None),))
    ended.seen.stall_s = 9.0
    with pytest.raises(Inconclusive):
        ended.must(refuses)
    ended.seen.processes["camera"].ended_by_itself = True
    assert fault_of(ended, refuses) is camera_faults.EndedByParameter


@pytest.mark.parametrize(("after_ms", "kind"), [(2900, None), (3100, camera_faults.TriesSeldom)])
def test_a_camera_is_looked_for_often_enough(after_ms: int, kind: type[Fault] | None) -> None:
    """Two seconds, and one until a picture is here."""
    view = filmed(image(1000 + after_ms, 1))
    view.seen.stages = [StageMark(part="there", at_ns=1000 * MS)]
    demand = come_after("there", "when it is there", FILMED, 2.0)
    if kind:
        assert fault_of(view, demand) is kind
    else:
        view.must(demand)


def test_a_picture_of_before_that_arrives_late_is_none_of_after() -> None:
    """It waited here, on a busy computer; the publisher's wall clock tells when it was sent."""
    hour_ns = 3_600_000 * MS
    soon = replace(image(500, 1), source_ns=hour_ns + 498 * MS)
    late = replace(image(1500, 2), source_ns=hour_ns + 600 * MS)
    view = filmed(soon, late)
    view.seen.stages = [StageMark(part="there", at_ns=1000 * MS)]
    demand = come_after("there", "when it is there", FILMED, 2.0)
    assert fault_of(view, demand) is camera_faults.NoPictureAfter
    filmed_again = filmed(soon, late, replace(image(2000, 3), source_ns=hour_ns + 1990 * MS))
    filmed_again.seen.stages = view.seen.stages
    filmed_again.must(demand)


@pytest.mark.parametrize(
    ("line", "is_enough"),
    [
        ("No camera: [Errno 2] No such file or directory: '/run/x/camera'", True),
        ("No camera: No such file or directory", False),
        ("No camera: /run/x/camera", False),
    ],
)
def test_the_line_names_device_and_reason(line: str, is_enough: bool) -> None:
    """Both."""
    view = filmed()
    view.seen.stages = [StageMark(part="missing", at_ns=0)]
    view.seen.processes["camera"].lines = [LogLine(arrival_ns=5, source="terminal", text=line)]
    node = CAMERA.model_copy(update={"log": "No camera: {text}"})
    demand = tell_of_trouble(node, "missing", "no camera", MISSING)
    if is_enough:
        view.must(demand)
    else:
        assert fault_of(view, demand) is camera_faults.SilentAboutCamera
