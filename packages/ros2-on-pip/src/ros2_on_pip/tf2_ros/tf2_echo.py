"""`ros2 run tf2_ros tf2_echo SOURCE TARGET [RATE]`: prints where TARGET lies in SOURCE, again and
again.

The names are turned round in the real one, too: what it calls source is the target of a look-up.
"""

from __future__ import annotations

import math
import sys
from typing import Any

import rclpy
import tf2_ros
from rclpy.clock import Clock, ClockType
from rclpy.time import Time

from ros2_on_pip.stand_ins._frames.buffer_core import motion_of
from ros2_on_pip.stand_ins._frames.euler import to_euler
from ros2_on_pip.stand_ins._frames.motion import matrix, normalized
from ros2_on_pip.tf_program import FAILED, run

USAGE = """\
Usage: tf2_echo source_frame target_frame [echo_rate]

This will echo the transform from the coordinate frame of the source_frame
to the coordinate frame of the target_frame.
Note: This is the transform to get data from target_frame into the source_frame.
Default echo rate is 1 if echo_rate is not given."""
LOOKS_HZ = 20.0
"""How often it looks while there is nothing yet; it says so once a second."""


class Echo:
    """Looks at every turn of a timer, and prints."""

    def __init__(self, node: Any, source: str, target: str, rate_hz: float) -> None:
        self.node, self.source, self.target, self.rate_hz = node, source, target, rate_hz
        self.buffer = tf2_ros.Buffer(node=node)
        self.listener = tf2_ros.TransformListener(self.buffer, node)
        self.timer = self._every(1 / LOOKS_HZ, self.wait)

    def _every(self, period_s: float, look: Any) -> Any:
        # By the computer's clock, also where the node follows /clock, as the real one.
        clock = Clock(clock_type=ClockType.STEADY_TIME)
        return self.node.create_timer(period_s, look, clock=clock)

    def wait(self) -> None:
        """Say what is missing; print from the first transform on."""
        can, lack = self.buffer.can_transform(
            self.source, self.target, Time(), return_debug_tuple=True
        )
        if can:
            self.timer.cancel()
            self.timer = self._every(1 / self.rate_hz, self.echo)
            self.echo()
            return
        self.node.get_logger().info(
            f"Waiting for transform {self.source} ->  {self.target}: {lack}",
            throttle_duration_sec=1.0,
        )

    def echo(self) -> None:
        """Print the newest."""
        try:
            print(told(self.buffer.lookup_transform(self.source, self.target, Time())), flush=True)
        except tf2_ros.TransformException as error:
            now_s = self.node.get_clock().now().nanoseconds / 1e9
            print(
                f"Failure at {now_s:.6f}\nException thrown:{error}\n"
                f"The current list of frames is:\n{self.buffer.all_frames_as_string()}",
                flush=True,
            )


def told(found: Any) -> str:
    """A TransformStamped, as the real one prints it."""
    motion, stamp = motion_of(found.transform), found.header.stamp
    rotation = normalized(motion.rotation)
    rpy = to_euler(rotation)
    rows = zip(matrix(rotation), motion.shift, strict=True)
    lines = [" ".join(f"{_even(v):6.3f}" for v in (*row, shift)) for row, shift in rows]
    return "\n".join(
        [
            f"At time {stamp.sec}.{stamp.nanosec:09}",
            f"- Translation: {_listed(motion.shift)}",
            f"- Rotation: in Quaternion (xyzw) {_listed(motion.rotation)}",
            f"- Rotation: in RPY (radian) {_listed(rpy)}",
            f"- Rotation: in RPY (degree) {_listed(tuple(map(math.degrees, rpy)))}",
            "- Matrix:",
            *(f" {line}" for line in lines),
            "  0.000  0.000  0.000  1.000",
        ]
    )


def _listed(numbers: tuple[float, ...]) -> str:
    return f"[{', '.join(f'{_even(number):.3f}' for number in numbers)}]"


def _even(number: float) -> float:
    """Of three digits, and never minus nothing."""
    return round(number, 3) + 0.0


def main(words: list[str]) -> int:
    """Run until Ctrl-C."""
    try:
        source, target, rate_hz = words[0], words[1], float(words[2]) if words[2:] else 1.0
    except (IndexError, ValueError):
        print(USAGE)
        return FAILED
    if len(words) > 3 or not 0 < rate_hz < math.inf:
        print(USAGE)
        return FAILED
    node = rclpy.create_node("tf2_echo")
    echo = Echo(node, source, target, rate_hz)
    rclpy.spin(echo.node)
    return 0


if __name__ == "__main__":
    sys.exit(run(main))
