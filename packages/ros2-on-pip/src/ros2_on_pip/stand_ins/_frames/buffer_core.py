"""`BufferCore`: the tree of frames, told and asked in ROS's messages and times."""

from __future__ import annotations

import math
from threading import RLock
from typing import Any

from geometry_msgs.msg import TransformStamped
from rclpy.logging import get_logger
from rclpy.time import Time

from ros2_on_pip.stand_ins._frames import errors
from ros2_on_pip.stand_ins._frames.errors import NANOSECONDS, TransformException, seconds
from ros2_on_pip.stand_ins._frames.history import ParentTransform
from ros2_on_pip.stand_ins._frames.motion import RigidTransform, compose
from ros2_on_pip.stand_ins._frames.tree import NO_PARENT, FrameTree

KEPT_S = 10.0
"""For how long steps are kept, as in geometry2."""
LENGTH_WITHIN = 0.01
"""A quaternion's squared length may be wrong by so much, as in geometry2."""
SHORTEST_NS = 100_000
"""What was said within less has no rate to speak of."""


class BufferCore:
    """Frames that are told of, and where each lies in each other."""

    def __init__(self, cache_time: Any = None) -> None:
        """Steps older than `cache_time`, a duration, are forgotten; 10 s by default."""
        keep_ns = int(KEPT_S * NANOSECONDS) if cache_time is None else duration_ns(cache_time)
        self._tree = FrameTree(keep_ns)
        self._authorities: dict[str, str] = {}
        self._lock = RLock()

    # --- told ---

    def set_transform(self, transform: Any, authority: str) -> None:
        """One step at its own time; what makes no sense is logged, and left aside."""
        self._set(transform, authority, static=False)

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """One step that never moves."""
        self._set(transform, authority, static=True)

    def _set(self, told: Any, authority: str, static: bool) -> None:
        child = told.child_frame_id.removeprefix("/")
        step = ParentTransform(told.header.frame_id.removeprefix("/"), motion_of(told.transform))
        faults = _faults(child, step, authority)
        for fault in faults:
            get_logger("tf2").error(fault)
        if not faults:
            self._keep(child, time_ns_of(told.header.stamp), step, authority, static)

    def _keep(
        self, child: str, time_ns: int, step: ParentTransform, authority: str, static: bool
    ) -> None:
        with self._lock:
            if static:
                self._tree.set_static(child, step)
            elif not self._tree.set_moving(child, time_ns, step):
                text = errors.OLD.format(child=child, time=seconds(time_ns), authority=authority)
                get_logger("tf2").warning(text)
                return
            self._authorities[child] = authority

    def clear(self) -> None:
        """Forget all that moves."""
        with self._lock:
            self._tree.clear()

    # --- asked ---

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """A TransformStamped: where the source lies in the target, at that time or newest.

        Raises a TransformException, and TypeError where `time` is none.
        """
        time_ns = time_ns_of(time)
        with self._lock:
            if target_frame != source_frame:
                self._require(target_frame=target_frame, source_frame=source_frame)
            motion, at_ns = self._tree.look_up(target_frame, source_frame, time_ns)
        return stamped(motion, target_frame, source_frame, at_ns)

    def lookup_transform_full_core(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> Any:
        """Where the source lay at its time, in the target at its own: the fixed frame joins them.

        Raises a TransformException, and TypeError where a time is none.
        """
        then_ns, now_ns = time_ns_of(source_time), time_ns_of(target_time)
        with self._lock:
            self._require(
                target_frame=target_frame, source_frame=source_frame, fixed_frame=fixed_frame
            )
            then, _ = self._tree.look_up(fixed_frame, source_frame, then_ns)
            now, at_ns = self._tree.look_up(target_frame, fixed_frame, now_ns)
        return stamped(compose(now, then), target_frame, source_frame, at_ns)

    def can_transform_core(
        self, target_frame: str, source_frame: str, time: Any
    ) -> tuple[bool, str]:
        """Whether it can be looked up, and why not."""
        time_ns = time_ns_of(time)
        if target_frame == source_frame:
            return True, ""
        with self._lock:
            lack = self._missing(target_frame=target_frame, source_frame=source_frame)
            lack = lack or self._no_way(target_frame, source_frame, time_ns)
        return not lack, lack

    def can_transform_full_core(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> tuple[bool, str]:
        """Whether it can be looked up, and why not."""
        then_ns, now_ns = time_ns_of(source_time), time_ns_of(target_time)
        with self._lock:
            lack = (
                self._missing(
                    target_frame=target_frame, source_frame=source_frame, fixed_frame=fixed_frame
                )
                or self._no_way(target_frame, fixed_frame, now_ns)
                or self._no_way(fixed_frame, source_frame, then_ns)
            )
        return not lack, lack

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """The newest time that all steps between the two have; 0 where none moves.

        Raises a TransformException.
        """
        with self._lock:
            for frame in (target_frame, source_frame):
                self._tree.require(frame, "get_latest_common_time")
            if target_frame == source_frame:
                return Time(nanoseconds=self._tree.newest_ns(target_frame))
            return Time(nanoseconds=self._tree.common_ns(target_frame, source_frame))

    def _require(self, **frames: str) -> None:
        for argument, frame in frames.items():
            self._tree.require(frame, f"lookupTransform argument {argument}")

    def _missing(self, **frames: str) -> str:
        told = (self._tree.missing(f, f"canTransform argument {a}") for a, f in frames.items())
        return next(filter(None, told), "")

    def _no_way(self, target: str, source: str, time_ns: int) -> str:
        try:
            self._tree.look_up(target, source, time_ns)
        except TransformException as error:
            return str(error)
        return ""

    # --- shown ---

    def all_frames_as_string(self) -> str:
        """One line a frame."""
        with self._lock:
            return self._tree.as_text()

    def all_frames_as_yaml(self) -> str:
        """A mapping from each frame to its parent, who told of it, how often, and from when on."""
        with self._lock:
            parents = self._tree.parents().items()
            known = [
                self._as_yaml(frame, parent) for frame, parent in parents if parent != NO_PARENT
            ]
        return "".join(known) or "[]"

    def _as_yaml(self, frame: str, parent: str) -> str:
        history = self._tree.histories[frame]
        length_ns = history.newest_ns - history.oldest_ns
        rate_hz = history.length * NANOSECONDS / max(length_ns, SHORTEST_NS)
        return (
            f"{frame}: \n"
            f"  parent: '{parent}'\n"
            f"  broadcaster: '{self._authorities[frame]}'\n"
            f"  rate: {rate_hz:.3f}\n"
            f"  most_recent_transform: {seconds(history.newest_ns)}\n"
            f"  oldest_transform: {seconds(history.oldest_ns)}\n"
            f"  buffer_length: {length_ns / NANOSECONDS:.3f}\n"
        )

    def _getFrameStrings(self) -> list[str]:  # noqa: N802  geometry2's name
        """The names of all frames."""
        with self._lock:
            return list(self._tree.names)

    def _frameExists(self, frame_id: str) -> bool:  # noqa: N802  geometry2's name
        """Whether somebody told of it."""
        with self._lock:
            return frame_id in self._tree.names

    def _chain(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> list[str]:
        """The frames on the way from the source by the fixed frame to the target."""
        then_ns, now_ns = time_ns_of(source_time), time_ns_of(target_time)
        with self._lock:
            up = self._tree.chain(fixed_frame, source_frame, then_ns)
            return [*up, *self._tree.chain(target_frame, fixed_frame, now_ns)[1:]]


def _faults(child: str, step: ParentTransform, authority: str) -> list[str]:
    """What makes a step one that nobody can use, in geometry2's words."""
    (shift, rotation), parent = step.motion, step.parent
    found = {
        errors.SELF_TRANSFORM: child == parent,
        errors.NO_CHILD: not child,
        errors.NO_PARENT: not parent,
        errors.NAN: any(map(math.isnan, (*shift, *rotation))),
        errors.NOT_NORMALIZED: not abs(sum(v * v for v in rotation) - 1.0) < LENGTH_WITHIN,
    }
    if True not in found.values():
        return []
    numbers = {"shift": _told(shift), "rotation": _told(rotation)}
    texts = (text for text, holds in found.items() if holds)
    return [text.format(child=child, authority=authority, **numbers) for text in texts]


def _told(numbers: tuple[float, ...]) -> str:
    return " ".join(f"{number:f}" for number in numbers)


# --- ROS's messages and times ---


def motion_of(transform: Any) -> RigidTransform:
    """Of a geometry_msgs/msg/Transform."""
    shift, turn = transform.translation, transform.rotation
    return RigidTransform((shift.x, shift.y, shift.z), (turn.x, turn.y, turn.z, turn.w))


def stamped(motion: RigidTransform, frame: str, child: str, time_ns: int) -> Any:
    """A geometry_msgs/msg/TransformStamped."""
    # Filled in after it is made: what is given to a message is made once more for nothing.
    made = TransformStamped()
    made.header.frame_id, made.child_frame_id = frame, child
    stamp, shift, turn = made.header.stamp, made.transform.translation, made.transform.rotation
    stamp.sec, stamp.nanosec = divmod(time_ns, NANOSECONDS)
    shift.x, shift.y, shift.z = motion.shift
    turn.x, turn.y, turn.z, turn.w = motion.rotation
    return made


def time_ns_of(time: Any) -> int:
    """Of rclpy's Time or builtin_interfaces/msg/Time. Raises TypeError."""
    return _nanoseconds(time, "time")


def duration_ns(duration: Any) -> int:
    """Of rclpy's Duration or builtin_interfaces/msg/Duration. Raises TypeError."""
    return _nanoseconds(duration, "duration")


def _nanoseconds(value: Any, what: str) -> int:
    if hasattr(value, "nanosec"):
        return int(value.sec) * NANOSECONDS + int(value.nanosec)
    if hasattr(value, "nanoseconds"):
        return int(value.nanoseconds)
    raise TypeError(f"{what} must have sec and nanosec, or nanoseconds.")
