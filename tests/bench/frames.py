"""Prints how many look-ups a second a Buffer of `tf2_ros` makes, and how far from the reference.

    python tests/bench/frames.py [ROUNDS [TREES]]

Each rate is the best of ROUNDS, by the seconds of a processor, so that other work on the machine
counts little: for frames that many steps apart, of which each was heard 50 times a second for 10 s,
newest and at a time between two. "message" is how many TransformStamped can be made in the same
time, which is the most that is to be had. The last line is the largest error of a number against
transforms3d, over TREES random trees. It asserts nothing.
"""

from __future__ import annotations

import platform
import sys
import time
from collections.abc import Callable
from pathlib import Path

from rclpy.time import Time

from ros2_on_pip.stand_ins._frames.buffer_core import BufferCore, stamped
from ros2_on_pip.stand_ins._frames.euler import from_euler
from ros2_on_pip.stand_ins._frames.motion import RigidTransform

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "packages/ros2-on-pip/tests/frames"))

from frame_reference import worst_error

ROUNDS, TREES = 5, 10_000
DEPTHS = (1, 4, 10)
LOOKS = 5_000
BEGIN_NS, PERIOD_NS, HEARD = 10**18, 20_000_000, 500


def filled(depth: int) -> BufferCore:
    """A chain of so many frames that move, f0 at its top."""
    buffer = BufferCore()
    for level in range(depth):
        for number in range(HEARD):
            motion = RigidTransform((1.0, level, number / 50), from_euler((0.1, 0.2, number / 100)))
            time_ns = BEGIN_NS + number * PERIOD_NS
            told = stamped(motion, f"f{level}", f"f{level + 1}", time_ns)
            buffer.set_transform(told, "bench")
    return buffer


def rate(act: Callable[[], object], rounds: int) -> float:
    """How often a second of a processor, at best."""
    return max(_rate(act) for _ in range(rounds))


def _rate(act: Callable[[], object]) -> float:
    began = time.process_time()
    for _ in range(LOOKS):
        act()
    return LOOKS / (time.process_time() - began)


def main(rounds: int = ROUNDS, trees: int = TREES) -> None:
    """Print them all."""
    print(f"Python {platform.python_version()}, {LOOKS} look-ups, best of {rounds}")
    newest, between = Time(), Time(nanoseconds=BEGIN_NS + 100 * PERIOD_NS + 7)
    for depth in DEPTHS:
        buffer, bottom = filled(depth), f"f{depth}"
        both = [
            rate(lambda b=buffer, f=bottom, at=at: b.lookup_transform_core("f0", f, at), rounds)  # type: ignore[misc]
            for at in (newest, between)
        ]
        print(f"depth {depth}: {both[0]:,.0f} newest, {both[1]:,.0f} at a time, a CPU s")
    motion = RigidTransform((1.0, 2.0, 3.0))
    print(f"message: {rate(lambda: stamped(motion, 'a', 'b', BEGIN_NS), rounds):,.0f} a CPU s")
    print(f"largest error over {trees:,} random trees: {worst_error(1, trees):.1e}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
