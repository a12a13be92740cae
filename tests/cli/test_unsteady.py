"""tests/unsteady.yaml: each test in it exists, and has a day and a reason."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from datetime import date
from pathlib import Path

import pytest
import yaml
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from roslings.course import root

FILE = root() / "tests" / "unsteady.yaml"


class Unsteady(BaseModel):
    """One entry."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    test: str
    date: date
    reason: str = Field(min_length=10)


def read(text: str) -> list[Unsteady]:
    """All entries. Raises ValidationError."""
    return TypeAdapter(list[Unsteady]).validate_python(yaml.safe_load(text))


def functions_of(file: Path) -> Iterator[str]:
    """The tests in a file, by their names there."""
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.FunctionDef):
            yield node.name


def exists(test: str) -> bool:
    """A function of a test file, or a cell of a lesson."""
    path, _, name = test.partition("::")
    file = root() / path
    if file.suffix == ".ipynb":
        return file.is_file()
    function = name.partition("[")[0].rpartition("::")[2]
    return file.is_file() and function.startswith("test_") and function in functions_of(file)


def test_each_is_there_once_with_its_day_and_its_reason() -> None:
    """A test that was renamed or mended leaves the file."""
    entries = read(FILE.read_text("utf-8"))
    names = [each.test for each in entries]
    assert [name for name in names if not exists(name)] == []
    assert len(set(names)) == len(names)


@pytest.mark.parametrize(
    "entry",
    [
        "- {test: tests/a.py::test_it, date: 2026-11-26}",
        "- {test: tests/a.py::test_it, reason: late beside others}",
        "- {test: tests/a.py::test_it, date: soon, reason: late beside others}",
        "- {test: tests/a.py::test_it, date: 2026-11-26, reason: late}",
        "just a word",
    ],
)
def test_what_lacks_something_is_refused(entry: str) -> None:
    """The reason too."""
    with pytest.raises(ValidationError):
        read(entry)


def test_a_test_that_is_not_there_is_found() -> None:
    """This one is."""
    here = "tests/cli/test_unsteady.py"
    assert exists(f"{here}::test_a_test_that_is_not_there_is_found[a-b::c]")
    assert not exists(f"{here}::test_that_nobody_wrote") and not exists("tests/no.py::test_it")
    assert exists("days/02-nodes/lesson.ipynb::Cell 3")
