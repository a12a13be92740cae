"""What the reference pages must answer, and their numbers against those of the course."""

from __future__ import annotations

import re

import pytest

from roslings.course import root

PAGES = root() / "site" / "pages" / "reference"
ANSWERS = [
    ("faq", "How long does it take?", "how-long"),
    ("faq", "Can Windows stay on my computer?", "Dual boot"),
    ("faq", "My robot and WSL do not find each other", "networkingMode=mirrored"),
    ("faq", "Letters look broken, or Python speaks of ASCII", "locale-gen"),
    ("faq", "How much memory does a camera need?", "MB"),
    ("faq", "Where can I ask?", "https://robotics.stackexchange.com/"),
    ("faq", "A list shows nodes that have ended", "ros2 daemon stop"),
    ("faq", "Can I use a virtual machine?", "bridged"),
    ("faq", "How do I get all of ROS without sudo?", "pixi add ros-jazzy-desktop"),
    ("faq", "Is there an official container?", "--network=host"),
    ("faq", "Is there an official container?", "osrf/ros:jazzy-desktop-full"),
    ("faq", "How many weeks until my robot drives by itself?", "| 3 to 4 |"),
    ("faq", "How many weeks until my robot drives by itself?", "| 6 to 8 |"),
    ("faq", "How much memory does a camera need?", "8 GB"),
    ("faq", "Is it useful for competitions?", "e-Yantra"),
    ("faq", "How do I see four terminals at once?", "tmux new -s robot"),
    ("faq", "Is ROS 2 real-time?", "PREEMPT_RT"),
    ("faq", "Is ROS 2 secure?", "ros2 security"),
    ("faq", "Where are the ideas explained, without a task?", "/en/jazzy/Concepts.html"),
    ("faq", "Is there something to watch?", "Articulated Robotics"),
    ("distributions", "Why Jazzy, when Lyrical is out?", "May 2029"),
    ("other-packages", "Cloned and built", "rosdep install --from-paths src --ignore-src -y"),
    ("other-packages", "Cloned and built", "colcon build --packages-up-to"),
    ("other-packages", "Drivers for a camera on a Pi", "v4l2_camera"),
    ("other-packages", "Drivers for a camera on a Pi", "camera_ros"),
    ("other-packages", "Drivers for a camera on a Pi", "rqt_image_view"),
    ("real-robot", "First picture", "ros2 run rqt_image_view rqt_image_view"),
    ("real-robot", "The ribbon camera", "camera_ros"),
]
"""A page, its heading, and words without which the answer would be none."""

HEADING = re.compile(r"^(#{2,4}) (.*)$", re.M)


def below(page: str, heading: str) -> str:
    """The text between a heading and the next one of its level or a higher one."""
    text = (PAGES / f"{page}.md").read_text("utf-8")
    (own,) = (found for found in HEADING.finditer(text) if found[2] == heading)
    rest = text[own.end() :]
    ends = (each.start() for each in HEADING.finditer(rest) if len(each[1]) <= len(own[1]))
    return rest[: next(ends, len(rest))]


@pytest.mark.parametrize(("page", "heading", "words"), ANSWERS)
def test_a_page_has_the_answer(page: str, heading: str, words: str) -> None:
    """Below its heading."""
    assert words in below(page, heading)


def test_the_distributions_have_their_dates() -> None:
    """Each LTS five years; Jazzy and Lyrical with their Ubuntu."""
    text = (PAGES / "distributions.md").read_text("utf-8")
    rows = re.findall(
        r"^\| \**(\w+) \(LTS\)\** \| May (\d+) \| May (\d+) \| ([\d.]+) \|$", text, re.M
    )
    table = {name: (int(begun), int(until), ubuntu) for name, begun, until, ubuntu in rows}
    assert table["Jazzy"] == (2024, 2029, "24.04")
    assert table["Lyrical"] == (2026, 2031, "26.04")
    assert all(until - begun == 5 for begun, until, _ in table.values())


def test_a_picture_is_as_large_as_told() -> None:
    """640 x 480 in three colours; ten of them; 15 a second, and for an hour."""
    picture = 640 * 480 * 3
    text = below("faq", "How much memory does a camera need?")
    assert f"{picture:,}".replace(",", " ") in text
    assert f"{10 * picture / 1e6:.0f} MB of memory" in text
    assert f"{15 * picture / 1e6:.0f} MB a second" in text
    assert "50 GB on the disk" in text
    assert 15 * picture * 3600 / 1e9 == pytest.approx(50, rel=0.05)


def test_the_quiz_asks_for_a_recording_and_for_both_in_one_node() -> None:
    """Of day 3, where both are taught."""
    quiz = (root() / "days" / "03-topics" / "quiz.yaml").read_text("utf-8")
    assert "ros2 bag record -a" in quiz
    assert re.search(r"One node has a .*subscription.*\n? .*publisher", quiz)


def test_what_the_wheels_need_is_said_alike() -> None:
    """The Pythons of pyproject.toml, in each text that names them."""
    project = (root() / "packages/roslings/pyproject.toml").read_text("utf-8")
    (first, after) = map(int, re.findall(r'requires-python = ">=3\.(\d+),<3\.(\d+)"', project)[0])
    for page in (
        "README.md",
        "days/01-install/first-15-minutes.md",
        "days/01-install/lesson.ipynb",
    ):
        text = (root() / page).read_text("utf-8")
        assert re.search(rf"3\.{first}( to |, .*)(and |or )?3\.{after - 1}\b", text), page
