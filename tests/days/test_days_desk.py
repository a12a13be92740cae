"""What lessons say of the desk: each command is one of its tabs, and opens it."""

from __future__ import annotations

import os
import re
import shlex
import signal
import subprocess
from pathlib import Path

import pytest

from lesson_runs import lessons
from ros2_on_pip.domain_lease import leased_domain
from ros2_on_pip.rosbag2.metadata import Topic
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions
from roslings.course import root
from roslings_desk.tab import BUILT_IN

TYPED = re.compile(r"`\./roslings desk([^`]*)`")
COMMANDS = [
    (lesson.day.id, words)
    for lesson in lessons()
    for cell in lesson.cells
    if not cell.is_code
    for words in TYPED.findall(cell.text)
]
PATIENCE_S = 120
OPEN = "The desk is open."


def test_lessons_name_tabs_that_there_are() -> None:
    """Some do; a word that is no option is a tab, or stands behind one."""
    assert len(COMMANDS) >= 4
    for day, words in COMMANDS:
        first = (shlex.split(words) or ["rover"])[0]
        assert first.startswith("--") or first in BUILT_IN, day


@pytest.mark.slow
@pytest.mark.parametrize(("day", "words"), COMMANDS, ids=[f"{d}:{w}" for d, w in COMMANDS])
def test_what_a_lesson_types_opens_the_desk(day: str, words: str, tmp_path: Path) -> None:
    """In a folder with a bag that is called `drive`, as on day 9; Ctrl-C ends it."""
    from rclpy.serialization import serialize_message
    from std_msgs.msg import String

    bag = BagWriter(tmp_path / "drive", BagWriterOptions())
    bag.add_topic(Topic("/word", "std_msgs/msg/String"))
    bag.write("/word", 1, serialize_message(String(data="hello")))
    bag.close()
    command = [root() / "roslings", "desk", *shlex.split(words), "--no-browser"]
    with leased_domain() as domain:
        seen = {**os.environ, "HOME": str(tmp_path), "ROS_DOMAIN_ID": str(domain)}
        with subprocess.Popen(
            command,
            cwd=tmp_path,
            env=seen,
            text=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        ) as process:
            assert process.stdout
            said = ""
            while OPEN not in said and (line := process.stdout.readline()):
                said += line  # who waits for another one's environment says so before
            said += process.stdout.readline()
            process.send_signal(signal.SIGINT)
            said += process.communicate(timeout=PATIENCE_S)[0]
    assert OPEN in said, said
    assert process.returncode == 0, said
