"""Demands on what a node finds in the pictures that it is shown."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from graders.pi_camera import faults
from graders.pi_camera.reasons import NoPictureShown, PictureLost
from roslings.capabilities.camera.demands import pixels_of, require_set
from roslings.capabilities.camera.record import (
    SURELY_COMES_BYTES,
    CameraSeen,
    DiscShown,
    PictureShown,
    PixelsSeen,
)
from roslings.capabilities.parameters.record import ParametersSeen
from roslings.course import NodeContract, TopicContract
from roslings.course.files import written
from roslings.evidence import LogLine, MessageSeen
from roslings.judge.demands import most_similar, require_its_time, require_steady
from roslings.judge.faults import Fault
from roslings.judge.faults.moments import Awaited
from roslings.judge.faults.writing import LoggedAgain
from roslings.judge.lines import times
from roslings.judge.values import as_number, field_of
from roslings.judge.views import Demand, ExperimentView, ProcessView
from roslings.seen.matching import nearest_endpoint

LEAST_MARKED, MOST_SPOILED = 0.01, 0.02
BALLS_PART = 0.05
"""Of the pixels around a ball, more are the ball's own."""
NS_PER_S = 10**9


@dataclass(frozen=True)
class Screen:
    """The node that looks, and the topics that it answers on."""

    node: NodeContract
    says: TopicContract
    draws: TopicContract
    within_px: float


@dataclass(frozen=True)
class Look:
    """One picture that was shown, and what the node said of it."""

    shown: PictureShown
    places: tuple[MessageSeen, ...]
    drawings: tuple[MessageSeen, ...]

    @property
    def words(self) -> faults.Picture:
        """The picture in words."""
        shown = self.shown
        idle = shown.step - shown.width * (1 if shown.encoding == "mono8" else 3)
        size_px = (shown.width, shown.height)
        return faults.Picture(bool(shown.ball), shown.encoding, size_px, idle)


def looks(experiment: ExperimentView, screen: Screen, part: str) -> list[Look]:
    """The pictures of one part, with their answers. Raises NothingToJudge where none was shown."""
    found = _looks(experiment, screen, [part])
    if not found:
        raise NoPictureShown("not_shown")
    return found


def _looks(experiment: ExperimentView, screen: Screen, parts: Sequence[str]) -> list[Look]:
    """The pictures of some parts, as many as were shown before the node ended."""
    shown = [
        each for each in experiment.seen.part(CameraSeen).shown if each.part in parts and each.tries
    ]
    said = _messages(experiment, screen.says)
    drawn = _messages(experiment, screen.draws)
    stamps = {each.stamp_ns for each in experiment.seen.part(CameraSeen).shown}
    return [
        Look(each, _answers(said, each, stamps), _answers(drawn, each, stamps)) for each in shown
    ]


def _messages(experiment: ExperimentView, topic: TopicContract) -> list[MessageSeen]:
    found = nearest_endpoint(experiment.seen.graph, "publisher", topic.topic, topic.type)
    if found is None or found.type != topic.type or found.topic not in experiment.seen.topics:
        return []
    return [m for m in experiment.seen.topics[found.topic].messages if isinstance(m.content, dict)]


def _answers(
    messages: list[MessageSeen], shown: PictureShown, stamps: set[int]
) -> tuple[MessageSeen, ...]:
    """By the stamp; an answer with a stamp of no picture belongs to the one that was shown then."""

    def belongs(message: MessageSeen) -> bool:
        stamp_ns = _stamp_ns(message)
        if stamp_ns in stamps:
            return stamp_ns == shown.stamp_ns
        return shown.sent_ns < message.arrival_ns <= shown.until_ns

    return tuple(message for message in messages if belongs(message))


def _stamp_ns(message: MessageSeen) -> int:
    parts = (field_of(message.content, f"header.stamp.{part}") for part in ("sec", "nanosec"))
    seconds, rest_ns = (int(as_number(part) or 0) for part in parts)
    return seconds * NS_PER_S + rest_ns


# --- where the ball is -------------------------------------------------------------------------


def find_the_ball(screen: Screen, part: str) -> Demand[ExperimentView]:
    """For each picture of the part, the place is that of the ball."""

    def demand(experiment: ExperimentView) -> None:
        for look in sorted(looks(experiment, screen, part), key=_may_be_lost):
            if look.shown.ball and not look.places:
                raise _missing(experiment, screen, look)
            for message in look.places:
                _require_place(screen, look, message)

    return demand


def _may_be_lost(look: Look) -> bool:
    """Whether its silence tells nothing; pictures that surely came are judged before such a one."""
    return not (look.places or look.drawings) and look.shown.bytes > SURELY_COMES_BYTES


def _missing(experiment: ExperimentView, screen: Screen, look: Look) -> Fault:
    """No place for a picture with a ball. Raises Inconclusive where it may not have arrived."""
    process, shown = experiment.process(screen.node), look.shown
    words = (screen.says.topic, look.words)
    if process.seen.ended_by_itself and not shown.turned:
        kind = faults.RowsNotCut if _has_idle_bytes(shown) else faults.EndedByPicture
        return kind(*words, log=process.last_lines())
    if look.drawings:
        return faults.NotFound(*words)
    require_steady(experiment.seen.stall_s)
    require_its_time(experiment.seen, shown.part, None, Awaited("picture_answer"))
    if not shown.turned:
        return faults.TooSlowForPictures(*words)
    if _may_be_lost(look):
        raise PictureLost(shown.tries)
    return faults.Unanswered(*words)


def _has_idle_bytes(shown: PictureShown) -> bool:
    return shown.step > shown.width * (1 if shown.encoding == "mono8" else 3)


def _require_place(screen: Screen, look: Look, message: MessageSeen) -> None:
    ball = look.shown.ball
    if ball is None:
        return
    x, y = (as_number(field_of(message.content, f"point.{axis}")) for axis in "xy")
    found = (math.nan if x is None else x, math.nan if y is None else y)
    if _near(found, (ball.x_px, ball.y_px), screen.within_px):
        _require_flat(screen, look, message)
        return
    kind = _kind_of_slip(look.shown, ball, found)
    raise kind(screen.says.topic, look.words, (ball.x_px, ball.y_px), found, screen.within_px)


def _require_flat(screen: Screen, look: Look, message: MessageSeen) -> None:
    """A picture has no depth."""
    z = as_number(field_of(message.content, "point.z"))
    if z != 0:
        raise faults.HasDepth(screen.says.topic, look.words, math.nan if z is None else z)


def _near(found: tuple[float, float], wanted: tuple[float, float], within_px: float) -> bool:
    return math.dist(found, wanted) <= within_px


def _kind_of_slip(
    shown: PictureShown, ball: DiscShown, found: tuple[float, float]
) -> type[faults.WrongPlace]:
    """What the wrong place looks like."""
    if any(0 < abs(value) < 1e-200 for value in found):
        return faults.NotAFloat
    x, y, radius = ball.x_px, ball.y_px, ball.radius_px
    slips: list[tuple[tuple[float, float], type[faults.WrongPlace]]] = [
        ((y, x), faults.XAndYSwapped),
        ((x - radius, y - radius), faults.CornerNotCentre),
        ((x - shown.width / 2, y - shown.height / 2), faults.FromTheMiddle),
    ]
    for place, kind in slips:
        if _near(found, place, 5.0):
            return kind
    if shown.decoy and _near(found, (shown.decoy.x_px, shown.decoy.y_px), shown.decoy.radius_px):
        return faults.RedAndBlueExchanged if shown.encoding == "rgb8" else faults.FoundTheDecoy
    return faults.WrongPlace


def cut_its_rows(screen: Screen, part: str) -> Demand[ExperimentView]:
    """Pictures whose rows have idle bytes are read right."""
    find = find_the_ball(screen, part)

    def demand(experiment: ExperimentView) -> None:
        try:
            find(experiment)
        except (faults.WrongPlace, faults.NotFound, faults.EndedByPicture) as fault:
            raise faults.RowsNotCut(
                screen.says.topic, _first_idle(experiment, screen, part), log=fault.log
            ) from fault

    return demand


def _first_idle(experiment: ExperimentView, screen: Screen, part: str) -> faults.Picture:
    found = list(looks(experiment, screen, part))
    return next((look.words for look in found if _has_idle_bytes(look.shown)), found[0].words)


def find_nothing(screen: Screen, part: str) -> Demand[ExperimentView]:
    """For each picture of the part, nothing is found, and the node lives."""

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(screen.node)
        for look in looks(experiment, screen, part):
            if process.seen.ended_by_itself and not look.shown.turned:
                words = (screen.draws.topic, look.words)
                raise faults.EndedByPicture(*words, log=process.last_lines())
            for message in look.places:
                x, y = (as_number(field_of(message.content, f"point.{a}")) for a in "xy")
                found = (math.nan if x is None else x, math.nan if y is None else y)
                raise faults.FoundWhereNothingIs(screen.says.topic, look.words, found)

    return demand


def follow_the_hue(screen: Screen, part: str, across: str) -> Demand[ExperimentView]:
    """After ball_hue was set, balls of that colour are found; in `across`, beyond the wheel's end.

    Each picture of `part` has a ball of the old colour, too.
    """

    def demand(experiment: ExperimentView) -> None:
        for each in experiment.seen.part(ParametersSeen).sets:
            if each.asked_ns < max(
                shown.sent_ns for shown in experiment.seen.part(CameraSeen).shown
            ):
                require_set(each)
        try:
            find_the_ball(screen, part)(experiment)
        except faults.FoundTheDecoy as slip:
            raise faults.HueIgnored(
                slip.topic, slip.picture, slip.wanted, slip.found, slip.within
            ) from slip
        try:
            find_the_ball(screen, across)(experiment)
        except faults.NotFound as slip:
            raise faults.NotFoundAcrossTheEnd(slip.topic, slip.picture) from slip

    return demand


def begin_with_the_hue(screen: Screen, part: str) -> Demand[ExperimentView]:
    """Started with another ball_hue, balls of that colour are found; one of the default is there.

    Whoever looks for the default finds that one.
    """
    find = find_the_ball(screen, part)

    def demand(experiment: ExperimentView) -> None:
        try:
            find(experiment)
        except faults.FoundTheDecoy as slip:
            raise faults.HueAtStartIgnored(
                slip.topic, slip.picture, slip.wanted, slip.found, slip.within
            ) from slip

    return demand


# --- what comes back ---------------------------------------------------------------------------


def carry_the_header(screen: Screen, parts: Sequence[str]) -> Demand[ExperimentView]:
    """Each answer has stamp and frame_id of its picture."""

    def demand(experiment: ExperimentView) -> None:
        answers = [
            (topic.topic, look.shown, message)
            for look in _looks(experiment, screen, parts)
            for topic, messages in ((screen.says, look.places), (screen.draws, look.drawings))
            for message in messages
        ]
        if not answers:
            raise NoPictureShown("no_answer")
        for answer in answers:
            _require_header(*answer)

    return demand


def _require_header(topic: str, shown: PictureShown, message: MessageSeen) -> None:
    if (stamp_ns := _stamp_ns(message)) != shown.stamp_ns:
        found_s, wanted_s = stamp_ns / NS_PER_S, shown.stamp_ns / NS_PER_S
        later_s = (stamp_ns - shown.stamp_ns) / NS_PER_S
        other = faults.OtherStamp(found_s, later_s)
        raise faults.StampNotCarried(topic, "header.stamp", f"{wanted_s:.3f} s", other)
    found = field_of(message.content, "header.frame_id")
    if found != shown.frame_id:
        words = f"{found!r}" if found else faults.Empty()
        raise faults.StampNotCarried(topic, "header.frame_id", repr(shown.frame_id), words)


def answer_once(screen: Screen, parts: Sequence[str]) -> Demand[ExperimentView]:
    """No picture has two answers on one topic.

    A picture that was shown again, as it may have been lost, is not counted.
    """

    def demand(experiment: ExperimentView) -> None:
        found = _looks(experiment, screen, parts)
        if not any(look.places or look.drawings for look in found):
            raise NoPictureShown("no_answer")
        for look in found:
            _require_one_each(screen, look)

    return demand


def _require_one_each(screen: Screen, look: Look) -> None:
    for topic, answers in ((screen.says, look.places), (screen.draws, look.drawings)):
        if look.shown.tries == 1 and len(answers) > 1:
            raise faults.AnsweredTwice(topic.topic, look.words, len(answers))


def draw_on_each(screen: Screen, parts: Sequence[str]) -> Demand[ExperimentView]:
    """Each picture comes back, in the card's encoding, with a ring around the ball."""

    def demand(experiment: ExperimentView) -> None:
        found = _looks(experiment, screen, parts)
        if not any(look.drawings for look in found):
            raise NoPictureShown("not_back")
        for look in found:
            for message in look.drawings:
                _require_drawing(screen, look, message)
            if not look.drawings and (look.shown.answered or _surely_came(experiment, look)):
                raise faults.Unanswered(screen.draws.topic, look.words)

    return demand


def _surely_came(experiment: ExperimentView, look: Look) -> bool:
    """No answer is the node's doing: the picture was not lost, and the node had its time.

    Raises Inconclusive where this computer was too busy.
    """
    if not look.shown.turned or look.shown.bytes > SURELY_COMES_BYTES:
        return False
    require_steady(experiment.seen.stall_s)
    require_its_time(experiment.seen, look.shown.part, None, Awaited("picture_answer"))
    return True


def _require_drawing(screen: Screen, look: Look, message: MessageSeen) -> None:
    pixels, content = pixels_of(message), message.content
    wanted = (look.shown.width, look.shown.height, str(screen.draws.fields["encoding"]))
    found = (content["width"], content["height"], content["encoding"])

    def wrong(kind: faults.DrawingKind) -> faults.WrongDrawing:
        what = faults.Drawing(kind, *found, pixels.bytes, content["step"])
        return faults.WrongDrawing(screen.draws.topic, look.words, what)

    if found != wanted:
        raise wrong("size")
    if content["step"] != 3 * content["width"] or pixels.bytes != content["step"] * wanted[1]:
        raise wrong("bytes")
    if pixels.spoiled is None or pixels.spoiled > MOST_SPOILED:
        raise wrong(_how_spoiled(pixels.swapped_off))
    if _is_swapped(pixels):
        raise wrong("swapped")
    if look.shown.ball and look.places and (pixels.marked or 0.0) < LEAST_MARKED:
        raise wrong("no_ring")


def _is_swapped(pixels: PixelsSeen) -> bool:
    """The ball has changed its colour, and has its own where red and blue are exchanged back.

    What lies around it is grey, and tells nothing where it has little noise.
    """
    marked, back = pixels.marked, pixels.swapped_marked
    return marked is not None and back is not None and marked > BALLS_PART and back < marked / 2


def _how_spoiled(swapped: float | None) -> faults.DrawingKind:
    return "swapped" if swapped is not None and swapped <= MOST_SPOILED else "another"


# --- pictures that are none --------------------------------------------------------------------


def survive(screen: Screen, part: str, words: str, must_say: bool) -> Demand[ExperimentView]:
    """After this bad picture the node lives; with `must_say`, it wrote the card's line."""
    line = written(screen.node.log, screen.node.node).partition("{text}")[0]

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(screen.node)
        shown = [
            each
            for each in experiment.seen.part(CameraSeen).shown
            if each.part == part and each.tries
        ]
        if not shown:
            raise NoPictureShown("not_shown")
        if process.seen.ended_by_itself and not shown[-1].turned:
            raise faults.EndedByPicture(screen.says.topic, words, log=process.last_lines())
        if must_say and not shown[-1].answered:
            require_steady(experiment.seen.stall_s)
            raise faults.SilentAboutPicture(words, line, most_similar(line, process.texts))

    return demand


def tell_once(screen: Screen, parts: Sequence[str]) -> Demand[ExperimentView]:
    """The card's line about a bad picture comes at most as often as the picture was shown."""
    line = written(screen.node.log, screen.node.node).partition("{text}")[0]

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(screen.node)
        for shown in experiment.seen.part(CameraSeen).shown:
            if shown.part in parts:
                lines = _lines_meanwhile(process, shown, line)
                if (found := times(lines)) > shown.tries:
                    raise LoggedAgain(process.seen.executable, lines[0].plain, found)

    return demand


def call_none_bad(screen: Screen, *parts: str) -> Demand[ExperimentView]:
    """No line calls a picture of these parts bad: they are as they should be."""
    line = written(screen.node.log, screen.node.node).partition("{text}")[0]

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(screen.node)
        for look in _looks(experiment, screen, parts):
            if lines := _lines_meanwhile(process, look.shown, line):
                raise faults.CalledBad(look.words, lines[0].plain)

    return demand


def _lines_meanwhile(process: ProcessView, shown: PictureShown, begin: str) -> list[LogLine]:
    """The lines that begin so and came while a picture was shown."""
    return [
        each
        for each in process.lines
        if each.plain.startswith(begin) and shown.sent_ns <= each.arrival_ns <= shown.until_ns
    ]


def answer_nothing(screen: Screen, part: str, words: str) -> Demand[ExperimentView]:
    """Nothing is published after a bad picture."""

    def demand(experiment: ExperimentView) -> None:
        for look in _looks(experiment, screen, [part]):
            for topic, answers in ((screen.says, look.places), (screen.draws, look.drawings)):
                if answers:
                    raise faults.AnswersBadPicture(words, topic.topic)

    return demand
