"""The picture of each lab that works: it is in the task, and what it shows is typed again."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest
from works import Works, drawn, seen, texts_of

from roslings.course import Lab, all_labs, root

SVG = "{http://www.w3.org/2000/svg}"
each_lab = pytest.mark.parametrize("lab", all_labs(), ids=lambda lab: lab.name)


def picture(lab: Lab) -> str:
    """The drawing as it lies in the lab."""
    return (lab.folder / "pictures" / "works.svg").read_text("utf-8")


@each_lab
def test_the_task_shows_it_with_words(lab: Lab) -> None:
    """Under its heading, with the sentence that the picture itself holds."""
    _, _, success = lab.task.read_text("utf-8").partition("## What success looks like")
    alt = Works.of(lab).alt.strip()
    assert f"![{alt}](pictures/works.svg)" in success.partition("\n## ")[0]
    drawing = ElementTree.fromstring(picture(lab))
    assert (drawing.findtext(f"{SVG}title") or "").strip() == alt


@each_lab
def test_it_is_small_and_asks_nobody(lab: Lab) -> None:
    """At most 100 kB, no script, no other file."""
    svg = picture(lab)
    assert len(svg) < 100_000 and "<script" not in svg
    assert all(link.startswith("data:image/") for link in re.findall(r'href="([^"]*)', svg))


@each_lab
def test_its_commands_stand_in_the_task(lab: Lab) -> None:
    """Or a part of them does: a picture may give a default by name."""
    task = " ".join(lab.task.read_text("utf-8").split())
    for each in (each for each in Works.of(lab).terminals if each.types.startswith(("ros2", "./"))):
        assert each.types.partition(" -")[0] in task, each.types


@pytest.fixture(scope="session")
def all_is_there() -> None:
    """What the commands in the pictures need: else the first one tells what it installs."""
    for command in ("ros2", "rover", "camera", "board"):
        subprocess.run([root() / "roslings", "ready", command], check=True, capture_output=True)


@pytest.mark.slow
@pytest.mark.usefixtures("all_is_there")
@each_lab
def test_it_looks_so_when_it_is_typed(lab: Lab, tmp_path: Path) -> None:
    """Letter by letter, but for the numbers."""
    windows, shot = seen(lab, tmp_path)
    assert texts_of(drawn(Works.of(lab), windows, shot)) == texts_of(picture(lab))
