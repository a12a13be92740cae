"""How one gets the course: the same in all texts that tell it, from one place."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from roslings.course import root
from roslings_learn.lessons.address import (
    CLONE,
    FILE,
    READ,
    TELL_HOW_TO_GET_IT,
    TELL_WHERE_TO_READ,
    Address,
    address_in,
    outdated,
    told,
    told_in,
)

KNOWN = Address("https://example.org/a/very-long-address/of-the-course.git", "https://example.org/")


@pytest.fixture
def texts(tmp_path: Path) -> Path:
    """The texts of the course, to be changed."""
    for name in (FILE, *TELL_HOW_TO_GET_IT):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(root() / name, tmp_path / name)
    return tmp_path


def test_all_texts_tell_what_the_project_says() -> None:
    """Mend: .venv/bin/python -m roslings_learn.lessons.address."""
    assert [*outdated(root())] == []


@pytest.mark.parametrize("name", TELL_HOW_TO_GET_IT)
def test_a_text_tells_it_and_can_tell_another_address(texts: Path, name: str) -> None:
    """Once; lines stay short, and back again nothing has changed."""
    file, before = texts / name, (texts / name).read_text("utf-8")
    assert len(CLONE.findall(before.replace('\\n",\n    "', "\n"))) == 1
    assert len(READ.findall(before)) == (name in TELL_WHERE_TO_READ)
    changed = told_in(file, KNOWN)
    assert KNOWN.repository in changed and "ADDRESS" not in changed
    assert (KNOWN.documentation + ">" in changed) is (name in TELL_WHERE_TO_READ)
    file.write_text(changed, "utf-8")
    assert told_in(file, KNOWN) == changed
    words = told_in(file, address_in((root() / FILE).read_text("utf-8"))).split()
    assert words == before.split() or file.suffix == ".ipynb"


def test_what_the_project_says_is_read(texts: Path) -> None:
    """A row that is a comment, and a table that is empty or missing, say nothing."""
    head = "[project]\nname = 'x'\n"
    assert (
        address_in(head) == address_in(head + "\n[project.urls]\n# Repository = 'x'\n") == Address()
    )
    rows = f'Repository = "{KNOWN.repository}"\nDocumentation = "{KNOWN.documentation}"\n'
    assert address_in(f'{head}[project.urls]\n{rows}[tool.x]\nRepository = "y"\n') == KNOWN
    (texts / FILE).write_text(f"{head}[project.urls]\n{rows}")
    assert len([*outdated(texts)]) == len(TELL_HOW_TO_GET_IT)


def test_only_the_paragraph_that_tells_it_is_broken_anew() -> None:
    """And no line of it is longer than 80 columns."""
    other = "A line\nof two.\n\n"
    paragraph = "Type `git clone ADDRESS\nroslings`. ADDRESS is the address or folder that\nyour "
    changed = told(f"{other}{paragraph}teacher gave you. Then type `cd roslings`.\n", KNOWN)
    assert changed.startswith(other) and changed.endswith("Then type `cd roslings`.\n")
    assert f"Type `git clone {KNOWN.repository} roslings`. Then" in " ".join(changed.split())
    assert max(map(len, changed.splitlines())) <= 80
