"""`ros2 run tf2_tools view_frames`: listens, then shows the tree of frames: in words, and as a
picture in a file."""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import rclpy
import tf2_ros

from ros2_on_pip.frames_heard import FramesHeard
from ros2_on_pip.frames_shown import graphviz, svg, words
from ros2_on_pip.tf_program import FAILED, run

LISTENED_S = 5.0
NOTHING = (
    "No frames: nobody said where something is, on /tf or on /tf_static.\n"
    "Look who publishes: ros2 topic info -v /tf"
)


def parser() -> argparse.ArgumentParser:
    """The words of the real program."""
    made = argparse.ArgumentParser(
        prog="view_frames", description="Create a diagram of the TF frames being broadcast over ROS"
    )
    made.add_argument(
        "--wait-time",
        "-t",
        type=float,
        default=LISTENED_S,
        help="Listen to the /tf topic for this many seconds before rendering the frame tree",
    )
    made.add_argument("-o", "--output", help="Output filename")
    return made


def hear(node: Any, for_s: float) -> FramesHeard:
    """All that is said in so many seconds."""
    clock = node.get_clock()
    frames = FramesHeard(lambda: clock.now().nanoseconds)
    listener = tf2_ros.TransformListener(frames, node)
    node.get_logger().info(f"Listening to tf data for {for_s} seconds...")
    end_s = time.monotonic() + for_s
    while (left_s := end_s - time.monotonic()) > 0:
        rclpy.spin_once(listener.node, timeout_sec=left_s)
    return frames


def write(frames: FramesHeard, now_ns: int, name: str) -> list[Path]:
    """The files of the picture; a PDF, as the real one makes it, where Graphviz is installed."""
    text, picture = Path(f"{name}.gv"), Path(f"{name}.svg")
    text.write_text(graphviz(frames, now_ns), encoding="utf-8")
    picture.write_text(svg(frames, now_ns), encoding="utf-8")
    return [picture, *_as_pdf(text), text]


def _as_pdf(text: Path) -> list[Path]:
    dot, pdf = shutil.which("dot"), text.with_suffix(".pdf")
    if not dot:
        return []
    done = subprocess.run([dot, "-Tpdf", str(text), "-o", str(pdf)], check=False)
    return [pdf] if done.returncode == 0 else []


def main(typed: list[str]) -> int:
    """Listen, show, and end."""
    options = parser().parse_args(typed)
    node = rclpy.create_node("view_frames")
    frames = hear(node, options.wait_time)
    if not frames.frames:
        print(NOTHING, file=sys.stderr)
        return FAILED
    now_ns = node.get_clock().now().nanoseconds
    print(words(frames, now_ns, sys.stdout.encoding))
    for fault in frames.faults():
        print(f"! {fault}")
    if frames.roots:
        name = options.output or time.strftime("frames_%Y-%m-%d_%H.%M.%S")
        print(f"Picture: {', '.join(map(str, write(frames, now_ns, name)))}")
    return 0


if __name__ == "__main__":
    sys.exit(run(main))
