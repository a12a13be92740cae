"""Demands on a node that publishes what a camera sees."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from roslings.capabilities.camera.faults import images as faults
from roslings.capabilities.camera.reasons import NoPictures
from roslings.capabilities.camera.record import CAMERA, PixelsSeen
from roslings.capabilities.parameters.contract import ParameterContract
from roslings.capabilities.parameters.record import ParameterSet, ParametersSeen
from roslings.course import NodeContract, TopicContract
from roslings.course.files import written
from roslings.evidence import MessageSeen, StageMark
from roslings.judge.demands import most_similar, require_its_time, require_steady
from roslings.judge.faults import Fault
from roslings.judge.faults.moments import Awaited
from roslings.judge.views import Demand, ExperimentView, TopicView

SAME_LEVELS = 2.5
"""A picture of the film, as far as rounding tells; any other is off by twice as much."""

MOST_STRAY = 0.05
FEWEST = 5
FIRST_PICTURE_S = 1.0
"""From a try that succeeds to the picture that comes here."""

AFTER_A_CHANGE = 4
"""Pictures to leave aside after a parameter was set: they may have been under way."""


ONE_POINT = 1.0
"""The smallest change of a brightness. Of the lights that were expected, a picture has the one that
it comes nearest to. So half a point beside it is another one."""


# --- what each message says of itself ----------------------------------------------------------


def hold_whole_rows(topic: TopicView) -> None:
    """`step` is the length of a row, and the bytes are those of all rows."""
    wanted = int(topic.contract.fields["step"])
    for message in _images(topic):
        content = message.content
        if content["step"] != wanted:
            raise faults.WrongStep(topic.name, wanted, content["step"])
        needed = content["step"] * content["height"]
        if pixels_of(message).bytes != needed:
            raise faults.NotAllBytes(topic.name, needed, pixels_of(message).bytes)


def show_what_the_camera_saw(topic: TopicView) -> None:
    """Each message shows a picture of the film."""
    seen = [pixels_of(message) for message in _images(topic)]
    wrong = [each for each in seen if not _fits(each)]
    if not wrong:
        return
    swapped = wrong[0].swapped_off is not None and wrong[0].swapped_off <= SAME_LEVELS
    kind = faults.RedAndBlueSwapped if swapped else faults.WrongPicture
    raise kind(topic.name, wrong[0].off)


def show_each_once(length: int) -> Demand[TopicView]:
    """From message to message, by the publisher's own count, the film goes on as far.

    `length` is that of the film, which begins again. Messages that were lost on the way do not
    count: their numbers tell how many they were.
    """

    def demand(topic: TopicView) -> None:
        steps = list(_steps(topic, length))
        if len(steps) < FEWEST:
            raise NoPictures("few")
        repeats = sum(moved < sent for sent, moved in steps) / len(steps)
        left_out = sum(moved > sent for sent, moved in steps) / len(steps)
        if repeats > max(MOST_STRAY, left_out):
            again = sum(max(0, sent - moved) for sent, moved in steps)
            raise faults.PictureTwice(topic.name, again / sum(sent for sent, _ in steps))
        if left_out > MOST_STRAY:
            lost = sum(moved - sent for sent, moved in steps) / sum(moved for _, moved in steps)
            raise faults.PicturesLost(topic.name, lost)

    return demand


def _steps(topic: TopicView, length: int) -> list[tuple[int, int]]:
    """For each two messages: how far the publisher's count and the film went on."""
    found = []
    for before, after in pairwise(m for m in _images(topic) if _fits(pixels_of(m))):
        shown = pixels_of(before).shows, pixels_of(after).shows
        if None in (*shown, before.sequence, after.sequence):
            continue
        sent = (after.sequence or 0) - (before.sequence or 0)
        moved = ((shown[1] or 0) - (shown[0] or 0)) % length
        if 0 < sent < length // 2:
            found.append((sent, moved))
    return found


def _images(topic: TopicView) -> list[MessageSeen]:
    found = [m for m in topic.before_ctrl_c if isinstance(m.content, dict) and "step" in m.content]
    if not found:
        raise NoPictures("none", topic.name)
    return found


def pixels_of(message: MessageSeen) -> PixelsSeen:
    """What the bytes of a picture held. Raises NothingToJudge where they were not looked at."""
    if not isinstance(message.content["data"], dict):
        raise NoPictures("not_looked_at")
    return PixelsSeen.model_validate(message.content["data"])


def _fits(seen: PixelsSeen) -> bool:
    return seen.off is not None and seen.off <= SAME_LEVELS


# --- parameters that act while the node runs ---------------------------------------------------


@dataclass(frozen=True)
class Lit:
    """The pictures that came while a parameter had a value."""

    value: int
    pixels: tuple[PixelsSeen, ...]

    @property
    def level(self) -> float:
        """The mean of all values."""
        return sum(each.level or 0.0 for each in self.pixels) / len(self.pixels)

    @property
    def lighter(self) -> float:
        """By how much the pictures are lighter than in the film, on average."""
        return sum(each.lighter for each in self.pixels) / len(self.pixels)


def follow_brightness(
    node: NodeContract,
    topic: TopicContract,
    parameter: ParameterContract,
    neutral: float,
    levels: float,
) -> Demand[ExperimentView]:
    """With each value that was set, the pictures are as much lighter as the card says."""

    def demand(experiment: ExperimentView) -> None:
        sets = [
            each
            for each in experiment.seen.part(ParametersSeen).sets
            if each.name == parameter.name
        ]
        good = [each for each in sets if _within_limits(each, parameter)]
        for each in good:
            require_set(each)
        lit = [_lit(experiment, topic, each, sets) for each in good]
        for before, after in pairwise(lit):
            if not all(_is_lit(each, neutral, levels) for each in (before, after)):
                raise _brightness_fault(parameter.name, before, after, neutral, levels)
        for seen in lit:
            _require_each_point(parameter.name, seen, neutral, levels)

    return demand


def begin_so_light(name: str, value: int, neutral: float, levels: float) -> Demand[TopicView]:
    """Every picture is as much lighter as the value asks for that the node was started with."""

    def demand(topic: TopicView) -> None:
        pixels = tuple(pixels_of(message) for message in _images(topic))
        if not _is_lit(Lit(value, pixels), neutral, levels):
            wanted = (value - neutral) * levels
            found = [each.lighter for each in pixels if _fits(each)]
            lighter = min(found, default=0.0)
            raise faults.LightAtStartIgnored(name, int(neutral), value, wanted, lighter)

    return demand


def require_set(said: ParameterSet) -> None:
    """The node took the value. Raises ParameterNotSet."""
    if not said.accepted:
        raise faults.ParameterNotSet(said.node, said.name, f"{said.value}", said.reason)


def _within_limits(said: ParameterSet, parameter: ParameterContract) -> bool:
    if isinstance(said.value, str) or parameter.least is None or parameter.most is None:
        return False
    return parameter.least <= said.value <= parameter.most


def _lit(
    experiment: ExperimentView, topic: TopicContract, said: ParameterSet, all_: list[ParameterSet]
) -> Lit:
    begin_ns = said.answered_ns or said.asked_ns
    end_ns = min((each.asked_ns for each in all_ if each.asked_ns > begin_ns), default=None)
    during = [
        pixels_of(message)
        for message in _images(experiment.topic(topic))
        if message.arrival_ns > begin_ns and (end_ns is None or message.arrival_ns < end_ns)
    ]
    settled = tuple(during[AFTER_A_CHANGE:])
    if not settled or any(each.level is None for each in settled):
        raise NoPictures("none_after")
    return Lit(int(said.value), settled)


def _is_lit(lit: Lit, neutral: float, levels: float, within_points: float = 2.0) -> bool:
    wanted, within = (lit.value - neutral) * levels, within_points * levels
    return all(_fits(each) and abs(each.lighter - wanted) < within for each in lit.pixels)


def _require_each_point(name: str, lit: Lit, neutral: float, levels: float) -> None:
    """Also a change by one point acts. Raises BrightnessIgnored."""
    if not _is_lit(lit, neutral, levels, within_points=ONE_POINT / 2):
        wanted = (lit.value - neutral) * levels
        raise faults.BrightnessIgnored(name, int(neutral), lit.value, wanted, lit.lighter)


def _went_round(seen: PixelsSeen) -> bool:
    return not _fits(seen) and seen.round_off is not None and seen.round_off <= SAME_LEVELS


def _brightness_fault(
    name: str, before: Lit, after: Lit, neutral: float, levels: float
) -> faults.WrongBrightness:
    wanted = (after.value - before.value) * levels
    found = after.level - before.level
    kind = faults.WrongBrightness
    if abs(found) < 0.1 * abs(wanted):
        kind = faults.BrightnessIgnored
    elif any(_went_round(each) for lit in (before, after) for each in lit.pixels):
        kind = faults.BrightnessGoesRound
    return kind(name, before.value, after.value, wanted, found)


def refuse(node: NodeContract, parameter: ParameterContract) -> Demand[ExperimentView]:
    """The node refuses what is no value of the parameter, and lives on."""

    def demand(experiment: ExperimentView) -> None:
        span = (parameter.type, float(parameter.least or 0), float(parameter.most or 0))
        wrong = [
            each
            for each in experiment.seen.part(ParametersSeen).sets
            if each.name == parameter.name and not _within_limits(each, parameter)
        ]
        if not wrong:
            raise NoPictures("not_tried")
        for each in wrong:
            asked = (each.node, each.name, repr(each.value))
            if each.accepted:
                raise faults.ParameterAccepted(*asked, *span)
            if each.answered_ns is None:
                raise _unanswered(experiment, node, asked, span)

    return demand


def _unanswered(
    experiment: ExperimentView,
    node: NodeContract,
    asked: tuple[str, str, str],
    span: tuple[str, float, float],
) -> Fault:
    process = experiment.process(node)
    if process.seen.ended_by_itself:
        return faults.EndedByParameter(*asked, *span, log=process.last_lines())
    require_steady(experiment.seen.stall_s)
    return faults.ParameterNotSet(*asked, "")


# --- a camera that is not there ----------------------------------------------------------------


def tell_of_trouble(
    node: NodeContract, part: str, when: str, numbers: Sequence[int]
) -> Demand[ExperimentView]:
    """In this part, the node wrote the card's line: the device, the system's words for an error."""
    reasons = [os.strerror(number) for number in numbers]
    before, after = written(node.log, node.node).split("{text}")

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        lines = _lines_in(experiment, node, part)
        for line in lines:
            told = before in line and after in line and f"/{CAMERA}" in line
            if told and any(reason in line for reason in reasons):
                return
        words = (when, f"{before}...{after}", reasons[0])
        if process.seen.ended_by_itself:
            raise faults.EndedWithoutCamera(*words, None, log=process.last_lines())
        require_steady(experiment.seen.stall_s)
        require_its_time(experiment.seen, part, None, Awaited("camera_line"))
        raise faults.SilentAboutCamera(*words, most_similar(before + reasons[0], lines))

    return demand


def come_after(
    part: str, when: str, topic: TopicContract, retries_within_s: float
) -> Demand[ExperimentView]:
    """In this part, pictures came, as soon as who tries again so often has them."""
    within_s = retries_within_s + FIRST_PICTURE_S

    def demand(experiment: ExperimentView) -> None:
        begin_ns, end_ns = _span_of(experiment, part)
        sent = _sent_ns(experiment.topic(topic).messages)
        first_ns = min((at for at in sent if begin_ns < at < end_ns), default=None)
        if first_ns is None:
            require_steady(experiment.seen.stall_s)
            require_its_time(experiment.seen, part, None, Awaited("picture"))
            raise faults.NoPictureAfter(when, topic.topic)
        if (took_s := (first_ns - begin_ns) / 1e9) > within_s:
            require_steady(experiment.seen.stall_s)
            require_its_time(experiment.seen, part, took_s - within_s, Awaited("picture"))
            raise faults.TriesSeldom(when, topic.topic, retries_within_s, took_s)

    return demand


def _sent_ns(messages: Sequence[MessageSeen]) -> list[int]:
    """When each was sent, by our clock: the quickest one tells how far the two clocks are apart.

    Pictures of before may wait on a busy computer, and arrive when the next part has begun.
    """
    apart_ns = min((m.arrival_ns - m.source_ns for m in messages if m.source_ns), default=0)
    return [m.source_ns + apart_ns if m.source_ns else m.arrival_ns for m in messages]


def _lines_in(experiment: ExperimentView, node: NodeContract, part: str) -> list[str]:
    begin_ns, end_ns = _span_of(experiment, part)
    lines = experiment.process(node).lines
    return [line.text for line in lines if begin_ns <= line.arrival_ns < end_ns]


def _span_of(experiment: ExperimentView, part: str) -> tuple[float, float]:
    """When a part began, and when the next one did."""
    stages: list[StageMark] = experiment.seen.stages
    begin = next((stage.at_ns for stage in stages if stage.part == part), None)
    if begin is None:
        raise NoPictures("not_so_far")
    return begin, min((s.at_ns for s in stages if s.at_ns > begin), default=float("inf"))
