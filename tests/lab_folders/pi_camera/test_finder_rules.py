"""Pictures that were shown to a node: what is right, what is a fault, what is open."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from graders.pi_camera import faults
from graders.pi_camera.demands import (
    Screen,
    answer_nothing,
    answer_once,
    begin_with_the_hue,
    call_none_bad,
    carry_the_header,
    draw_on_each,
    find_nothing,
    find_the_ball,
    tell_once,
)
from roslings.capabilities.camera.record import CameraSeen, DiscShown, PictureShown, PixelsSeen
from roslings.course import NodeContract, TopicContract
from roslings.evidence import (
    Endpoint,
    GraphSeen,
    HeldUpSeen,
    LogLine,
    MessageSeen,
    ProcessSeen,
    Qos,
    TopicSeen,
)
from roslings.experiment.own_time import PATIENCE_S
from roslings.judge import ExperimentView, Fault, Inconclusive, NothingToJudge
from roslings.judge.faults.writing import LoggedAgain
from seen_with import seen_with
from ways_to_write import WAYS, written

IMAGE, POINT = "sensor_msgs/msg/Image", "geometry_msgs/msg/PointStamped"
SAYS = TopicContract(topic="/ball", type=POINT)
DRAWS = TopicContract(topic="/drawn", type=IMAGE, fields={"encoding": "bgr8"})
FINDER = NodeContract(node="/finder", executable="finder", publishes=(SAYS, DRAWS))
SCREEN = Screen(FINDER, SAYS, DRAWS, within_px=3.0)
MS, STAMP_NS = 1_000_000, 1_700_000_000_000_000_000


def end(node: str, topic: TopicContract) -> Endpoint:
    """A publisher."""
    return Endpoint(
        kind="publisher", node=node, topic=topic.topic, type=topic.type, qos=Qos(), gid=topic.topic
    )


def fault_of(view: Any, *demands: Any) -> type[Fault]:
    """The kind of the fault that is found."""
    with pytest.raises(Fault) as found:
        view.must(*demands)
    words = found.value
    assert words.expected and words.measured and words.why and words.hint
    return type(found.value)


def shown(number: int, **words: Any) -> PictureShown:
    """A picture with a ball, shown at its second, answered."""
    usual = {
        "part": "ball",
        "topic": "/eye",
        "width": 160,
        "height": 120,
        "encoding": "bgr8",
        "step": 480,
        "bytes": 57_600,
        "stamp_ns": STAMP_NS + number,
        "frame_id": f"eye_{number}",
        "ball": DiscShown(x_px=100.0, y_px=40.0, radius_px=12.0, hue=5),
        "sent_ns": number * 1000 * MS,
        "until_ns": (number * 1000 + 900) * MS,
        "tries": 1,
        "answered": True,
        "turned": True,
    }
    return PictureShown(**{**usual, **words})


def place(number: int, x: Any, y: Any, stamp_ns: int | None = None, late: bool = False) -> Any:
    """An answer to the n-th picture; late ones come while the next one is shown."""
    seconds, rest = divmod(STAMP_NS + number if stamp_ns is None else stamp_ns, 10**9)
    header = {"stamp": {"sec": seconds, "nanosec": rest}, "frame_id": f"eye_{number}"}
    at_ns = (number * 1000 + (1200 if late else 300)) * MS
    content = {"header": header, "point": {"x": x, "y": y, "z": 0.0}}
    return MessageSeen(source_ns=None, sequence=None, arrival_ns=at_ns, size=9, content=content)


def looking(pictures: list[PictureShown], places: list[Any], **process: Any) -> ExperimentView:
    """An experiment with a ball finder; it drew each picture that it answered."""
    ends = [end("/finder", SAYS), end("/finder", DRAWS)]
    seen = seen_with(
        name="looking",
        clock="wall",
        graph=GraphSeen(nodes=["/finder"], endpoints=ends),
        topics={"/ball": TopicSeen(name="/ball", type=POINT, messages=places)},
        processes={"finder": ProcessSeen(executable="finder", started_ns=0, **process)},
        shown=pictures,
    )
    return ExperimentView(seen)


FINDS = find_the_ball(SCREEN, "ball")


def test_three_pixels_are_near_and_four_are_not() -> None:
    """In any direction."""
    looking([shown(1)], [place(1, 102.0, 41.9)]).must(FINDS)
    assert fault_of(looking([shown(1)], [place(1, 104.0, 40.0)]), FINDS) is faults.WrongPlace


@pytest.mark.parametrize(
    ("x", "y", "kind"),
    [
        (40.0, 100.0, faults.XAndYSwapped),
        (88.0, 28.0, faults.CornerNotCentre),
        (20.0, -20.0, faults.FromTheMiddle),
        (5e-310, 4.9e-310, faults.NotAFloat),
        (10.0, 100.0, faults.FoundTheDecoy),
        ("NaN", "NaN", faults.WrongPlace),
        (0.0, 0.0, faults.WrongPlace),
    ],
)
def test_a_slip_is_told_by_what_it_looks_like(x: Any, y: Any, kind: type[Fault]) -> None:
    """The usual ones."""
    decoy = DiscShown(x_px=11.0, y_px=99.0, radius_px=8.0, hue=60)
    assert fault_of(looking([shown(1, decoy=decoy)], [place(1, x, y)]), FINDS) is kind


def test_an_answer_belongs_to_its_picture_by_its_stamp() -> None:
    """Also when it comes late, while the next picture is shown; without a stamp by its time."""
    pictures = [shown(1), shown(2, ball=DiscShown(x_px=20.0, y_px=80.0, radius_px=9.0, hue=5))]
    late = [place(1, 100.0, 40.0, late=True), place(2, 20.0, 80.0)]
    looking(pictures, late).must(FINDS)
    no_stamp = [place(1, 100.0, 40.0, stamp_ns=0), place(2, 20.0, 80.0, stamp_ns=0)]
    looking(pictures, no_stamp).must(FINDS)
    header = carry_the_header(SCREEN, ["ball"])
    looking(pictures, late).must(header)
    assert fault_of(looking(pictures, no_stamp), header) is faults.StampNotCarried


def test_silence_after_a_picture() -> None:
    """A small one surely came; a large one may have been lost; an end is an end."""
    silent = {"answered": False, "tries": 6}
    assert fault_of(looking([shown(1, **silent)], []), FINDS) is faults.Unanswered
    with pytest.raises(Inconclusive, match="lost on the way"):
        looking([shown(1, **silent, bytes=921_600)], []).must(FINDS)
    first_is_large = [shown(1, **silent, bytes=921_600), shown(2, answered=False)]
    assert fault_of(looking(first_is_large, []), FINDS) is faults.Unanswered
    with pytest.raises(Inconclusive, match="lost on the way"):
        looking(first_is_large, [place(2, 100.0, 40.0)]).must(FINDS)
    still_busy = shown(1, **silent, turned=False)
    assert fault_of(looking([still_busy], []), FINDS) is faults.TooSlowForPictures
    dead = looking([still_busy], [], ended_by_itself=True)
    assert fault_of(dead, FINDS) is faults.EndedByPicture


def test_a_busy_computer_is_not_held_against_a_silent_node() -> None:
    """It stood still meanwhile."""
    view = looking([shown(1, answered=False)], [])
    view.seen.stall_s = 9.0
    with pytest.raises(Inconclusive):
        view.must(FINDS)


def test_nothing_is_there_and_something_is_found() -> None:
    """In a picture without a ball."""
    nothing = find_nothing(SCREEN, "none")
    looking([shown(1, part="none", ball=None)], []).must(nothing)
    false = looking([shown(1, part="none", ball=None)], [place(1, 3.0, 4.0)])
    assert fault_of(false, nothing) is faults.FoundWhereNothingIs


def test_a_picture_has_one_answer() -> None:
    """One that was shown twice, since it may have been lost, may have two."""
    twice = [place(1, 100.0, 40.0), place(1, 100.0, 40.0)]
    looking([shown(1)], twice[:1]).must(answer_once(SCREEN, ["ball"]))
    looking([shown(1, tries=2)], twice).must(answer_once(SCREEN, ["ball"]))
    view = looking([shown(1)], twice)
    assert fault_of(view, answer_once(SCREEN, ["ball"])) is faults.AnsweredTwice
    with pytest.raises(NothingToJudge):
        looking([shown(1)], []).must(answer_once(SCREEN, ["ball"]))


def test_the_hue_of_the_start() -> None:
    """Whoever looks for the default hue finds the other ball."""
    decoy = DiscShown(x_px=30.0, y_px=90.0, radius_px=12.0, hue=5)
    picture = shown(1, decoy=decoy)
    looking([picture], [place(1, 100.0, 40.0)]).must(begin_with_the_hue(SCREEN, "ball"))
    view = looking([picture], [place(1, 30.0, 90.0)])
    assert fault_of(view, begin_with_the_hue(SCREEN, "ball")) is faults.HueAtStartIgnored


def test_a_place_in_a_picture_has_no_depth() -> None:
    """z is 0."""
    deep = place(1, 100.0, 40.0)
    deep.content["point"]["z"] = 12.0
    assert fault_of(looking([shown(1)], [deep]), FINDS) is faults.HasDepth


def test_a_picture_without_a_ball_comes_back_too() -> None:
    """A small one surely came; of a large one, or on a busy computer, nothing is said."""
    view = looking([shown(1), shown(2, part="none", ball=None, answered=False)], [])
    draws = draw_on_each(SCREEN, ["none", "drawn"])
    with pytest.raises(NothingToJudge, match="no picture came back"):
        view.must(draws)
    marks = DiscShown(x_px=9.0, y_px=9.0, radius_px=3.0, hue=5)
    drawn = drawing(3)
    view.seen.recording(CameraSeen).shown.append(shown(3, part="drawn", ball=marks))
    view.seen.topics["/drawn"] = TopicSeen(name="/drawn", type=IMAGE, messages=[drawn])
    assert fault_of(view, draws) is faults.Unanswered
    view.seen.part(CameraSeen).shown[1].bytes = 921_600
    view.must(draws)


def drawing(number: int) -> MessageSeen:
    """The picture that comes back for the n-th one, with a ring."""
    pixels = PixelsSeen(bytes=57_600, level=1.0, spoiled=0.0, marked=0.02).model_dump()
    sec, nanosec = divmod(STAMP_NS + number, 10**9)
    header = {"stamp": {"sec": sec, "nanosec": nanosec}, "frame_id": f"eye_{number}"}
    content = {
        "header": header,
        "width": 160,
        "height": 120,
        "encoding": "bgr8",
        "step": 480,
        "data": pixels,
    }
    at_ns = (number * 1000 + 300) * MS
    return MessageSeen(source_ns=None, sequence=None, arrival_ns=at_ns, size=9, content=content)


def test_a_bad_picture_is_answered_by_nothing() -> None:
    """No place, no drawing."""
    bad = shown(1, part="short", ball=None)
    quiet = answer_nothing(SCREEN, "short", "a bad picture")
    looking([bad], []).must(quiet)
    assert fault_of(looking([bad], [place(1, 3.0, 4.0)]), quiet) is faults.AnswersBadPicture


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("count", [1, 2])
def test_a_bad_picture_is_told_of_once(count: int, way: str) -> None:
    """As often as it was shown, however the line is written."""
    lines = [LogLine(arrival_ns=1100 * MS, text="Bad picture: 3 bytes", source="terminal")]
    view = looking([shown(1, part="short", ball=None)], [], lines=lines * count)
    node = FINDER.model_copy(update={"log": "Bad picture: {text}"})
    demand = tell_once(replace(SCREEN, node=node), ["short"])
    seen = ExperimentView(written(view.seen, way))
    if count == 1:
        seen.must(demand)
    else:
        assert fault_of(seen, demand) is LoggedAgain


@pytest.mark.parametrize(("at_ms", "is_told"), [(900, False), (1300, True)])
def test_a_good_picture_that_is_called_bad(at_ms: int, is_told: bool) -> None:
    """It is answered when it is shown again; the line while it was shown stays."""
    lines = [LogLine(arrival_ns=at_ms * MS, text="Bad picture: 480 rows", source="terminal")]
    view = looking([shown(1, tries=2)], [place(1, 100.0, 40.0)], lines=lines)
    node = FINDER.model_copy(update={"log": "Bad picture: {text}"})
    demand = call_none_bad(replace(SCREEN, node=node), "ball")
    if is_told:
        assert fault_of(view, demand) is faults.CalledBad
    else:
        view.must(demand)


@pytest.mark.parametrize(("held_s", "is_told"), [(1.0, True), (PATIENCE_S + 1, False)])
def test_a_picture_without_an_answer(held_s: float, is_told: bool) -> None:
    """It was shown, and the node had its time, or this computer took it."""
    view = looking([shown(1, answered=False, turned=False)], [])
    view.seen.held_up["ball"] = HeldUpSeen(cpu_wait_s=held_s, stall_s=0.0)
    with pytest.raises((faults.TooSlowForPictures, Inconclusive)) as raised:
        view.must(FINDS)
    assert isinstance(raised.value, Fault) is is_told
