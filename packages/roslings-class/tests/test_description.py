"""The page of the wheel: nothing on it leads into a folder that is not there."""

from __future__ import annotations

import re
from pathlib import Path, PurePosixPath

import pytest

from roslings import course
from roslings_class.description import NoAddress, address, for_its_page, urls
from roslings_class.wheel import describe

HERE = PurePosixPath("packages/roslings")
AT = "https://git.example.org/robotics/course"
README = """\
# A course

![The verdict](../../site/pictures/verdict.svg)

Read [the task](../../labs/topics/task.md#names), [a page](https://example.org/x) and
[below](#below).
"""


def test_paths_become_addresses() -> None:
    """A picture as it is, a page as the web shows it; what is absolute stays."""
    page = for_its_page(README, HERE, AT)
    assert f"![The verdict]({AT}/raw/HEAD/site/pictures/verdict.svg)" in page
    assert f"[the task]({AT}/blob/HEAD/labs/topics/task.md#names)" in page
    assert "[a page](https://example.org/x)" in page
    assert "[below](#below)" in page


def test_without_an_address_words_stay() -> None:
    """No link that is broken, and no hole where the picture was."""
    assert for_its_page(README, HERE, "") == (
        "# A course\n\nRead the task, [a page](https://example.org/x) and\n[below](#below).\n"
    )
    far = "![A badge](https://example.org/badge.svg)\n\nText.\n"
    assert for_its_page(far, HERE, "") == far


def test_our_own_page_has_no_broken_link() -> None:
    """Each path in it is there in the course, and none is left on the page."""
    text = (course.root() / HERE / "README.md").read_text("utf-8")
    to = re.findall(r"\]\(([^)#]+)", text)
    assert [path for path in to if not (course.root() / HERE / path).exists()] == []
    assert "](.." not in for_its_page(text, HERE, "")
    absolute = re.findall(r"\]\(([^)]+)", for_its_page(text, HERE, AT))
    assert len(absolute) == len(to) >= 4
    assert all(each.startswith(f"{AT}/") and ".." not in each for each in absolute)


def test_the_wheel_gets_all_of_it(tmp_path: Path) -> None:
    """Its README, its addresses and the licences, in the folder that it is built in."""
    describe(course.root(), tmp_path, AT)
    project = (tmp_path / "pyproject.toml").read_text("utf-8")
    assert project.endswith(f'[project.urls]\nHomepage = "{AT}"\nIssues = "{AT}/issues"\n')
    page = (tmp_path / "README.md").read_text("utf-8")
    assert f"]({AT}/raw/HEAD/site/pictures/verdict.svg)" in page
    assert (tmp_path / "LICENSE").is_file()


def test_the_address_is_the_one_that_was_told() -> None:
    """As one copies it from a browser or from `git clone`."""
    assert address({}) == address({"ROSLINGS_ADDRESS": " "}) == ""
    for told in (AT, f"{AT}/", f"{AT}.git"):
        assert address({"ROSLINGS_ADDRESS": told}) == AT
    assert urls("") == ""
    assert f'Homepage = "{AT}"\n' in urls(AT)


@pytest.mark.parametrize(
    "told",
    [
        "git@git.example.org:robotics/course",
        "https://teacher:secret@git.example.org/course",
        "https://token@git.example.org/course",
        "/srv/course",
        "https://",
        "https://git.example.org/course?private_token=1",
        'https://git.example.org/"\nname = "x',
    ],
)
def test_what_is_no_public_address_is_refused(told: str) -> None:
    """A password would be in everybody's wheel."""
    with pytest.raises(NoAddress, match="ROSLINGS_ADDRESS"):
        address({"ROSLINGS_ADDRESS": told})
