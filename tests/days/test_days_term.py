"""The page for a term: its hours, needs and plans are the course's, and its commands are there."""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path

import pytest

from lesson_runs import lessons
from roslings.course import all_labs, lab, root
from roslings_class.classroom import Handout, told
from roslings_launcher.cli import parser
from roslings_launcher.machine import WheelPlatform
from roslings_launcher.readiness import readiness
from roslings_learn.lessons.rules import Lesson
from roslings_rover.usual_place import told_of

PAGE = (root() / "site/pages/teachers/term.md").read_text("utf-8")
HOURS_OF_A_WEEK = {
    "Eleven weeks, four hours each": 5,
    "Fifteen weeks, three hours each": 5,
    "Five weeks, four hours each": 5,
}
"""The most that a week of each plan asks for, home tasks included."""
LESSONS = {lesson.day.number: lesson for lesson in lessons()}
MINUTES = {
    "about one hour": 60,
    "about 70 minutes": 70,
    "about 90 minutes": 90,
    "about 2 hours": 120,
    "about two hours": 120,
    "about two and a half hours": 150,
    "about three hours": 180,
}


def section(heading: str) -> str:
    """The text below a heading of the page."""
    return PAGE.partition(f"## {heading}\n")[2].partition("\n## ")[0]


def rows(heading: str) -> list[list[str]]:
    """The cells of the first table below a heading, without its head."""
    lines = [line for line in section(heading).splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def needs() -> dict[int, set[int]]:
    """Day to the days that it needs, as the page says."""
    table = rows("Hours, and what needs what")
    return {
        int(day.split()[0]): {int(n) for n in re.findall(r"\d+", need)} for day, _, _, need in table
    }


def all_needed(day: int) -> set[int]:
    """With what those need."""
    own = needs()[day]
    return own.union(*(all_needed(each) for each in own))


def plan(heading: str) -> list[list[int]]:
    """The days of each week."""
    return [[int(day) for day in days.split(",")] for _, days in rows(heading)]


def hours() -> dict[int, int]:
    """Day to its hours, as the page says."""
    return {int(day.split()[0]): int(told) for day, told, *_ in rows("Hours, and what needs what")}


def test_the_hours_are_those_of_the_days() -> None:
    """And their sum is told."""
    assert hours() == {number: lesson.day.hours for number, lesson in LESSONS.items()}
    assert f"All of it is {sum(hours().values())} hours." in PAGE


def test_the_labs_are_those_of_the_days() -> None:
    """Each with the time that its task says."""
    told = {}
    for day, _, labs, _ in rows("Hours, and what needs what"):
        for name, minutes in re.findall(r"`([\w-]+)` (\d+)", labs):
            told[name] = (int(day.split()[0]), int(minutes))
    assert told == {
        each.name: (day_of(each.outline.day), minutes_of(each.name)) for each in all_labs()
    }


def day_of(id: str) -> int:
    """The number of a day."""
    return int(id.partition("-")[0])


def minutes_of(name: str) -> int:
    """What a lab's task says of its time."""
    text = (lab(name).folder / "task.md").read_text("utf-8")
    found = re.search(r"\*\*Time:\*\* ([^.]+)\.", text)
    assert found
    return MINUTES[" ".join(found[1].split())]


def test_a_day_needs_what_its_labs_need() -> None:
    """Through all days between; and what the head of its lesson names."""
    for each in all_labs():
        day = day_of(each.outline.day)
        wanted = {day_of(lab(name).outline.day) for name in each.outline.needs} - {day}
        assert wanted <= all_needed(day), each.name
    for number, lesson in LESSONS.items():
        assert named_in_the_head(lesson) - {number} <= all_needed(number), number


def named_in_the_head(lesson: Lesson) -> set[int]:
    """Days that a lesson's first lines ask for, by their number or by a lab."""
    text = (root() / "days" / lesson.day.id / "lesson.ipynb").read_text("utf-8")
    head = "\n".join(re.findall(r"\*\*(?:Level|You need):\*\*[^\n]*", text))
    days = {int(number) for number in re.findall(r"\bdays? (\d+)", head)}
    labs = {name for name in re.findall(r"lab `([\w-]+)`", head)}
    return days | {day_of(lab(name).outline.day) for name in labs}


@pytest.mark.parametrize("heading", HOURS_OF_A_WEEK)
def test_a_plan_can_be_kept(heading: str) -> None:
    """Each day comes after what it needs; a week is not longer than is said."""
    weeks = plan(heading)
    numbers = [int(week) for week, _ in rows(heading)]
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) == {"Eleven": 11, "Fifteen": 15, "Five": 5}[heading.split()[0]]
    done: set[int] = set()
    for days in weeks:
        for day in days:
            assert needs()[day] <= done, (heading, day)
            done.add(day)
    everything = list(chain(*weeks))
    for days in weeks:
        asked = sum(hours()[day] / everything.count(day) for day in days)
        assert asked <= HOURS_OF_A_WEEK[heading], (heading, days)
    assert done == set(LESSONS) or "half of the course" in section(heading)


def test_what_is_said_of_a_missed_day_is_so() -> None:
    """Days that need day 4, and those that do not."""
    text = " ".join(section("Somebody missed a day").split())
    later = [day for day in LESSONS if day > 4]
    free = [day for day in later if 4 not in all_needed(day)]
    bound = [day for day in later if 4 in all_needed(day)]
    assert f"days {listed(free)} do not need it, and days {listed(bound)} do." in text


def listed(days: list[int]) -> str:
    """As a sentence lists them."""
    return ", ".join(map(str, days[:-1])) + f" and {days[-1]}"


def test_a_lab_needs_no_package_of_another() -> None:
    """Each has a starter and a package of its own, and names no other lab's."""
    packages = {each.name: each.outline.package for each in all_labs()}
    assert len(set(packages.values())) == len(packages)
    for each in all_labs():
        assert each.starter.is_dir()
        manifest = next(each.starter.rglob("package.xml")).read_text("utf-8")
        others = set(packages.values()) - {each.outline.package}
        assert [other for other in others if f"depend>{other}<" in manifest] == []


@pytest.mark.parametrize("page", ["term", "handing-out"])
def test_each_command_is_there(page: str) -> None:
    """What the pages tell an instructor to type is understood; what has a folder gets one."""
    text = (root() / f"site/pages/teachers/{page}.md").read_text("utf-8")
    typed = {line for line in re.findall(r"\./roslings ([^`\n]+)", text)}
    own = [words for line in sorted(typed) if (words := line.split()) and words[0].islower()]
    assert own
    for words in own:
        name = words[0]
        if name not in ("ready", "wheels", "doctor", "site"):  # read their words by themselves
            parser([name]).parse_args(words)


# --- the page on how a class gets the course ----------------------------------------------------

HANDING_OUT = (root() / "site/pages/teachers/handing-out.md").read_text("utf-8")


def shown(first: str) -> str:
    """The block of the page that begins with a line."""
    return first + HANDING_OUT.partition(f"```text\n{first}")[2].partition("\n```")[0]


def test_what_new_prints_is_shown_as_it_is(tmp_path: Path) -> None:
    """On Ubuntu 24.04; sizes are those of a day."""
    ubuntu = WheelPlatform("Linux", "x86_64", 64, (2, 39), (3, 12), cpython=True)
    seen = readiness(ubuntu, {"PATH": "/nowhere"}, tmp_path, root=tmp_path)
    printed = "\n".join(["This machine:", *map(str, seen)])
    sizes = re.compile(r"[\d.]+ GB free|about \d+")
    assert sizes.sub("", shown("This machine:")) == sizes.sub("", printed)


def test_what_serve_prints_is_shown_as_it_is() -> None:
    """With a folder of packages for one Python."""
    address = "http://192.168.0.10:8000"
    rclpy = "ros_rclpy-7.1.6-cp312-cp312-manylinux_2_28_x86_64.whl"
    wheels = {name: Path() for name in (rclpy, *map(str, range(141)))}
    printed = told(Handout({}, wheels, has_site=True), [address, "http://127.0.0.1:8000"])
    assert shown(f"The course can be had at {address}") == printed


def test_one_server_gets_what_each_lab_needs() -> None:
    """Students may not write there, so every lab with groups of its own is named."""
    (words,) = re.findall(r"^\./roslings ready check (.+)$", HANDING_OUT, re.MULTILINE)
    own = {each.name for each in all_labs() if each.card.groups}
    assert own
    assert set(words.split()) == own


def test_what_is_said_on_a_shared_computer_is_said_so() -> None:
    """By setup.bash, and by the board and the camera."""
    page = " ".join(HANDING_OUT.split())
    said = (root() / "packages/roslings-launcher/src/roslings_launcher/domain.sh").read_text(
        "utf-8"
    )
    (sentence,) = re.findall(r'_roslings_said="(.+)"', said)
    assert sentence.replace("$ROS_DOMAIN_ID", str(1004 % 101 + 1)) in page
    place = Path("/run/user/1004/roslings/rover_camera")
    assert told_of(place, "rover_camera", "device") in page
