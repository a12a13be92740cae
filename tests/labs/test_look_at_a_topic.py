"""The tool of the lab black-box's step 6: it can be completed, and finds what the task asks for."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from roslings.course import lab
from roslings_rover.models.drives.sick_rover import Planted, sick_rover
from roslings_rover.rover.sick import write_sick_rover
from sources import python_path

LAB = lab("black-box")
TOOL = LAB.starter / "look.py"
TODO = re.compile(r"^( *)# TODO (\d+): .*\n(?:\1# .*\n)*", re.M)
WRITTEN = {
    10: """
        from collections import Counter

        from rclpy.serialization import deserialize_message
        from rosidl_runtime_py.utilities import get_message

        from black_box.read_drive import open_bag
        """,
    11: """
        reader = open_bag(path)
        types = {each.name: each.type for each in reader.get_all_topics_and_types()}
        start, found = None, []
        while reader.has_next():
            name, data, time_ns = reader.read_next()
            start = start or time_ns / 1e9
            if name == topic:
                message = deserialize_message(data, get_message(types[name]))
                found.append((time_ns / 1e9, message))
        return start, found
        """,
    12: """
        print(f'from {found[0][0] - start:.2f} s to {found[-1][0] - start:.2f} s')
        """,
    13: """
        for time_s, message in (found[0], found[len(found) // 2], found[-1]):
            stamp = message.header.stamp
            print(f'age {time_s - stamp.sec - stamp.nanosec / 1e9:.3f} s')
        """,
    14: """
        for frame, count in Counter(each.header.frame_id for _, each in found).items():
            print(f'frame {frame}: {count}')
        """,
    15: """
        values = [value_of(message, field) for _, message in found]
        print(f'{field}: {min(values):.4f} to {max(values):.4f}')
        """,
}
"""What a student writes for each TODO."""
NAMES = ("Ada Lovelace", "Emmy Noether")
FIELDS = {"/cmd_vel": "linear.x", "/temperature": "temperature"}
"""Of the topics in which these two have a value that is wrong."""


def completed() -> str:
    """The starter's tool with all of its TODOs done."""
    assert [int(found[2]) for found in TODO.finditer(TOOL.read_text("utf-8"))] == [*WRITTEN]
    return TODO.sub(_code, TOOL.read_text("utf-8"))


def _code(found: re.Match[str]) -> str:
    code = textwrap.dedent(WRITTEN[int(found[2])]).strip()
    return textwrap.indent(code, found[1]) + "\n"


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """With the program, the tool as it was begun and as it is done, and a bag for each name."""
    folder = tmp_path_factory.mktemp("home") / LAB.card.package
    shutil.copytree(LAB.solution, folder)
    (folder / "begun.py").write_text(TOOL.read_text("utf-8"), "utf-8")
    (folder / "look.py").write_text(completed(), "utf-8")
    for name in NAMES:
        write_sick_rover(name, folder / name)
    return folder


def looks(home: Path, *words: str, tool: str = "look.py", code: int = 0) -> str:
    """What the tool says in this folder."""
    done = subprocess.run(
        [sys.executable, tool, *words],
        cwd=home,
        env={"PYTHONPATH": python_path()},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout


def planted(fault: str) -> tuple[str, Planted]:
    """Whose rover has it, and what proves it."""
    return next(
        (name, each) for name in NAMES for each in sick_rover(name).planted if each.fault == fault
    )


def numbers(said: str, pattern: str) -> list[float]:
    """Those in the lines of this form."""
    return [float(each) for each in re.findall(pattern, said)]


def test_the_task_types_it_as_it_is_called() -> None:
    """Its words, and those of the tool's own usage."""
    (typed,) = re.findall(r"^python3 look\.py .*$", LAB.task.read_text("utf-8"), re.M)
    assert len(typed.split()) == 5
    assert "usage: python3 look.py BAG TOPIC [FIELD ...]" in TOOL.read_text("utf-8")


def test_as_it_is_begun_it_runs(home: Path) -> None:
    """It finds nothing yet, and falls over nothing."""
    bag, *words = NAMES[0], "/imu", "angular_velocity.z"
    assert looks(home, bag, *words, tool="begun.py", code=1) == "no message on /imu\n"
    assert "usage: " in looks(home, bag, tool="begun.py", code=2)


@pytest.mark.parametrize("fault", ["wrong_unit", "lost_parameter"])
def test_a_value_is_seen(fault: str, home: Path) -> None:
    """The largest one of the field."""
    name, wrong = planted(fault)
    said = looks(home, name, wrong.topic, FIELDS[wrong.topic])
    low, high = re.findall(r"^.*: (\S+) to (\S+)$", said, re.M)[-1]
    assert max(abs(float(low)), abs(float(high))) == pytest.approx(wrong.number, rel=0.01)


def test_a_stamp_that_stands_still_is_seen(home: Path) -> None:
    """Its last message is old, its first one is not."""
    name, wrong = planted("stale_stamps")
    first, _, last = numbers(looks(home, name, wrong.topic), r"age (\S+) s")
    assert last == pytest.approx(wrong.number, rel=0.01)
    assert first < 0.1


def test_a_clock_that_is_off_is_seen(home: Path) -> None:
    """By the same time from the first message to the last; ahead is an age below zero."""
    name, wrong = planted("wrong_clock")
    ages = numbers(looks(home, name, wrong.topic), r"age (\S+) s")
    assert [-age for age in ages] == pytest.approx([wrong.number] * 3, rel=0.05)


def test_the_end_of_a_topic_is_seen(home: Path) -> None:
    """In seconds from the start of the bag."""
    name, wrong = planted("dead_node")
    (end,) = numbers(looks(home, name, wrong.topic), r"^from \S+ s to (\S+) s")
    assert end == pytest.approx(wrong.number, rel=0.01)


def test_a_second_frame_is_seen(home: Path) -> None:
    """With how many messages have it."""
    name, wrong = planted("wrong_frame")
    counts = numbers(looks(home, name, wrong.topic), r"frame \S+: (\d+)")
    assert len(counts) == 2 and wrong.number in counts


def test_a_wheel_is_one_element_of_a_field(home: Path) -> None:
    """And a topic without a header has neither ages nor frames."""
    name = NAMES[0]
    said = looks(home, name, "/wheel_speeds", "velocity.0", "velocity.1")
    assert len(re.findall(r"^velocity\.[01]: \S+ to \S+$", said, re.M)) == 2
    assert not re.search("age|frame", looks(home, name, "/cmd_vel", "linear.x"))


def test_a_topic_that_is_not_there_is_told(home: Path) -> None:
    """A name that is misspelt is no traceback."""
    assert looks(home, NAMES[0], "/imuu", code=1) == "no message on /imuu\n"
