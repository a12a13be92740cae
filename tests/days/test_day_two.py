"""Day 2 as its lesson tells it: every command typed, in the terminal that is named.

Its cells are executed by `test_days_running.py`; what the student writes between the commands is
taken from the solutions, TODO by TODO and drill by drill.
"""

from __future__ import annotations

import re
import shutil
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from student import BLOCK, Student, lesson_of, placed, save_as, text_of
from terminals import Terminal

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import lab, root
from roslings_learn.drills import Drill, all_drills
from roslings_learn.drills.course import of_day

sys.path.append(str(root() / "tests" / "labs"))
from half_done import states

LAB = lab("nodes")
LESSON = lesson_of(2)
SECTIONS = ("The lab", "The check")
ELSEWHERE = ("Remapping",)
"""Sections with commands that are no steps of the lab."""
BY_HAND = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool

{lamp}
def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Lamp())

main()
"""


@pytest.fixture
def student(tmp_path: Path) -> Iterator[Student]:
    """With an empty home, in the course's folder."""
    with leased_domain() as domain, ExitStack() as stack:
        yield Student(tmp_path, domain, stack, text_of(LESSON, SECTIONS))


def writes(student: Student, todo: int | None) -> None:
    """The TODOs up to this one, as the solution does them; or all."""
    own = student.home / "roslings_ws" / "src" / LAB.card.package
    if todo is None:
        save_as(LAB.solution, own)
        return
    (state,) = (each for each in states(LAB) if each.done == todo)
    save_as(state.make(student.home / "typed" / str(todo) / LAB.card.package), own)


def test_each_command_of_the_lesson_is_typed_by_a_test() -> None:
    """None stands in another section, and each step of the lab names its terminal."""
    lab_text, others = text_of(LESSON, SECTIONS), text_of(LESSON, ELSEWHERE)
    every = text_of(LESSON, [*LESSON.sections])
    assert len(BLOCK.findall(lab_text)) == len(placed(lab_text))
    assert len(BLOCK.findall(every)) == len(BLOCK.findall(lab_text + others))


@pytest.mark.slow
def test_the_lab_of_day_2_goes_as_its_lesson_tells(student: Student) -> None:
    """No command that fails, and each success looks as it is described."""
    _, started = student.types()
    assert re.search(r"roslings_ws/src/rover_status \(6 files\)", started)
    student.promised("names a folder in `~/roslings_ws/src`, with 6 files")
    student.terminal(1).is_free()
    built = student.promised("1 package finished")
    writes(student, 10)
    student.types()[0].shows(built)  # step 3
    student.types()[0].shows("Publishing: ")  # step 4
    echo, listed = student.types()
    assert "/minimal_publisher" in listed.split()
    echo.shows(r"(?s)data: \D+\d+.*data: \D+\d+")
    student.ends(3)
    student.promised("It says about 1.")
    student.types()[0].shows(r"average rate: (0\.9|1\.0)")
    student.ends(3)
    student.promised("Your text appears on the map, over the rover")
    student.types()[0].shows(r'"Robot status count: \d+"')
    student.ends(1)
    student.ends(2)
    writes(student, 11)
    student.terminal(1).is_free()
    student.types_again(1)[0].shows(built)  # step 5
    student.types()[0].shows("Publishing: ")
    student.promised("Success: it says about 2.")
    student.types()[0].shows(r"average rate: (1\.[89]|2\.[01])")
    student.ends(3)
    student.ends(2)
    student.types()[0].shows("Publishing: ")  # step 6
    student.terminal(1).is_free()
    student.types()[0].shows("Publishing: ")
    picture, _ = student.types()
    for name in ("/left/first", "/right/second", "/left/robot_status", "/right/robot_status"):
        picture.shows(name)
    picture.is_free()
    assert "KeyboardInterrupt" in student.ends(1) and "KeyboardInterrupt" in student.ends(2)
    writes(student, None)
    student.closes(1)  # step 7: a new one
    _, said = student.types()
    assert re.search(built, said)
    student.terminal(1).is_free()
    student.types_again(2)[0].shows("Publishing: ")
    assert "Traceback" not in student.ends(2)
    student.types()[0].tells(student.promised("100 of 100"))
    assert student.left == []


@pytest.mark.slow
def test_the_drills_of_days_1_and_2_come_one_after_the_other(student: Student) -> None:
    """`watch` as the lesson says: mended and saved, the next one comes; then the lab; q ends it."""
    watch = student.types_of_the_text(1, "./roslings watch")
    mended = [*of_day(all_drills(), "1"), *of_day(all_drills(), "2")]
    student.promised("`h` is a hint, `q` ends it")
    for number, drill in enumerate(mended, 1):
        head = f"Drill {number} of {len(all_drills())}, day {int(drill.day[:2])}: "
        watch.shows(rf"(?s){head}.*\n\S+ {drill.name} .*q quit")
        if number in (1, len(mended)):
            watch.press("h")
            watch.shows(rf"Hint 1 of 3 for {drill.name}")
        mends(student, watch, drill)
    watch.shows(r"The starter of 'nodes' is in ~/roslings_ws/src/rover_status")
    watch.shows(r"(?s)Day 02-nodes: .*q quit")
    watch.press("q")
    watch.is_free()


def mends(student: Student, watch: Terminal, drill: Drill) -> None:
    """In the file that the screen names; it is saved once, whole, as an editor does."""
    named = rf"~/(roslings_ws/drills/{drill.day}/{re.escape(drill.file_name)})"
    (place, *_) = re.findall(named, watch.heard()) or [""]
    assert place, f"the screen names no file of {drill.name}:\n{watch}"
    file, part = student.home / place, student.home / "typed"
    assert file.read_bytes() == drill.starter.read_bytes()
    shutil.copyfile(drill.solution, part)
    part.replace(file)
    watch.shows(rf"{drill.name} +it does all that is asked")


@pytest.mark.slow
def test_the_other_commands_of_day_2_work_as_they_stand(student: Student) -> None:
    """A lamp in a file of its own is started under another name."""
    (start,) = BLOCK.findall(text_of(LESSON, ELSEWHERE))
    (lamp,) = (
        cell.text.partition("\nwith session")[0]
        for cell in LESSON.sections["Remapping"]
        if cell.is_code and "change" not in cell.tags
    )
    (student.home / "lamp.py").write_text(BY_HAND.format(lamp=lamp), "utf-8")
    for number in (1, 2):
        student.terminal(number).type("source setup.bash")
        student.terminal(number).is_free()
    student.terminal(1).type(f"cd; {start.strip()}")
    looks = student.terminal(2)
    for line in ("until ros2 node list | grep -x /left/lamp; do :; done", "ros2 topic list"):
        looks.type(line)
        looks.is_free()
    assert "/left/light" in looks.heard().split()
