"""All frames, and how one reaches from one to another. It knows nothing of ROS's messages.

Target and source are as in tf2. Asked for is what takes numbers of SOURCE to numbers of TARGET.
That is where the frame `source` lies in the frame `target`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from ros2_on_pip.stand_ins._frames.errors import (
    BAD_NAME,
    EMPTY,
    LOOP,
    NO_FRAME,
    NO_SUCH_ID,
    NOT_CONNECTED,
    ON_THE_WAY,
    SLASH,
    UNKNOWN,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TransformException,
)
from ros2_on_pip.stand_ins._frames.history import (
    LATEST,
    History,
    Moving,
    NotKnown,
    ParentTransform,
    Static,
)
from ros2_on_pip.stand_ins._frames.motion import RigidTransform, compose, inverse

HIGHEST = 1000
"""A frame with more ancestors lies in a loop (MAX_GRAPH_DEPTH of geometry2)."""
NO_PARENT = "NO_PARENT"


@dataclass
class FrameTree:
    """Frames by their names; each but the root has a history of where it lay in its parent."""

    keep_ns: int
    histories: dict[str, History] = field(default_factory=dict)
    names: dict[str, None] = field(default_factory=dict)
    """Of all frames, roots too, in the order in which they were told of."""

    def set_static(self, child: str, step: ParentTransform) -> None:
        """The child lies so at all times."""
        self.histories[child] = Static(step)
        self._name(child, step.parent)

    def set_moving(self, child: str, time_ns: int, step: ParentTransform) -> bool:
        """The child lay so at that time; whether that is kept."""
        history = self.histories.get(child)
        if not isinstance(history, Moving):
            history = self.histories[child] = Moving(self.keep_ns)
        self._name(child, step.parent)
        return history.insert(time_ns, step)

    def _name(self, child: str, parent: str) -> None:
        self.names.setdefault(child)
        self.names.setdefault(parent)

    def clear(self) -> None:
        """Forget where frames were; their names, and what never moves, stay."""
        for history in self.histories.values():
            history.clear()

    def require(self, frame: str, argument: str) -> None:
        """Nothing where there is such a frame; `argument` is what the message calls it.

        Raises InvalidArgumentException and LookupException.
        """
        if why := _bad_name(frame):
            raise InvalidArgumentException(BAD_NAME.format(frame=frame, argument=argument, why=why))
        if frame not in self.names:
            raise LookupException(NO_FRAME.format(frame=frame, argument=argument))

    def missing(self, frame: str, argument: str) -> str:
        """Why there is no such frame, in the words of `can_transform`; empty where there is."""
        why = _bad_name(frame) or ("" if frame in self.names else UNKNOWN)
        return why and NO_SUCH_ID.format(frame=frame, argument=argument, why=why)

    def newest_ns(self, frame: str) -> int:
        """Of what is known of one frame; 0 where it never moves."""
        history = self.histories.get(frame)
        return history.newest_ns if history else LATEST

    def look_up(self, target: str, source: str, time_ns: int) -> tuple[RigidTransform, int]:
        """Where `source` lies in `target`, and of when that is.

        Raises ConnectivityException, ExtrapolationException and LookupException.
        """
        if target == source:
            return RigidTransform(), time_ns or self.newest_ns(target)
        if time_ns == LATEST:
            time_ns = self.common_ns(target, source)
        up, top, gap = self._climb(source, (target,), time_ns)
        if top == target:
            return up, time_ns
        down, met, lack = self._climb(target, (top, source), time_ns)
        if met not in (top, source):
            raise _no_path(source, target, lack if lack is not None else gap)
        return (inverse(down) if met == source else compose(inverse(down), up)), time_ns

    def _climb(
        self, frame: str, goals: tuple[str, ...], time_ns: int
    ) -> tuple[RigidTransform, str, str | None]:
        """From `frame` up to a goal, or as far as it goes: where `frame` lies in what was reached.

        Where the time is what stops it, the third is geometry2's text; else None.
        """
        motion = RigidTransform()
        for _ in range(HIGHEST + 1):
            history = self.histories.get(frame)
            if history is None or frame in goals:
                return motion, frame, None
            try:
                step = history.at(time_ns)
            except NotKnown as gap:
                return motion, frame, str(gap)
            motion = compose(step.motion, motion)
            frame = step.parent
        raise self._loop()

    def common_ns(self, target: str, source: str) -> int:
        """The newest time for which all steps between the two are known; 0 where none moves.

        Raises ConnectivityException and LookupException.
        """
        up = self._newest_steps(source, target)
        if up and up[-1][1] == target:
            return _oldest(up)
        parents = [parent for _, parent in up]
        down = self._newest_steps(target, source, until=frozenset(parents))
        met = down[-1][1] if down else None
        if met == source:
            return _oldest(down)
        if met not in parents:
            raise ConnectivityException(NOT_CONNECTED.format(source=source, target=target))
        return _oldest(down + up[: parents.index(met) + 1])

    def _newest_steps(
        self, frame: str, goal: str, until: frozenset[str] = frozenset()
    ) -> list[tuple[int, str]]:
        """Time and parent of the newest steps from `frame` up, to `goal` or one of `until`."""
        found: list[tuple[int, str]] = []
        while frame != goal and (newest := self._newest(frame)):
            frame = newest[1]
            found.append(newest)
            if frame in until:
                break
            if len(found) > HIGHEST:
                raise self._loop()
        return found

    def _newest(self, frame: str) -> tuple[int, str] | None:
        history = self.histories.get(frame)
        step = history.newest if history else None
        return (history.newest_ns, step.parent) if history and step else None

    def chain(self, target: str, source: str, time_ns: int = LATEST) -> list[str]:
        """The frames on the way from `source` to `target`, both included.

        Raises as `look_up`.
        """
        self.look_up(target, source, time_ns)
        up, down = self._ancestors(source), self._ancestors(target)
        met = next(frame for frame in up if frame in down)
        return [*up[: up.index(met) + 1], *reversed(down[: down.index(met)])]

    def _ancestors(self, frame: str) -> list[str]:
        found = [frame]
        while newest := self._newest(found[-1]):
            found.append(newest[1])
        return found

    def parents(self) -> dict[str, str]:
        """Each frame that has a history to its parent; NO_PARENT where that was forgotten."""
        newest = {frame: self._newest(frame) for frame in self.names if frame in self.histories}
        return {frame: step[1] if step else NO_PARENT for frame, step in newest.items()}

    def as_text(self) -> str:
        """One line a frame, as geometry2 writes them."""
        lines = (f"Frame {f} exists with parent {p}.\n" for f, p in self.parents().items())
        return "".join(lines)

    def _loop(self) -> LookupException:
        return LookupException(LOOP.format(frames=self.as_text()))


def _bad_name(frame: str) -> str:
    if not frame:
        return EMPTY
    return SLASH if frame.startswith("/") else ""


def _no_path(source: str, target: str, gap: str | None) -> TransformException:
    """`gap` is what is not known of the time; None where the frames lie in two trees."""
    if gap is None:
        return ConnectivityException(NOT_CONNECTED.format(source=source, target=target))
    return ExtrapolationException(gap + ON_THE_WAY.format(source=source, target=target))


def _oldest(steps: list[tuple[int, str]]) -> int:
    """The smallest time; a frame that never moves has none."""
    return min((time_ns for time_ns, _ in steps if time_ns != LATEST), default=LATEST)
