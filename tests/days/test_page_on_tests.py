"""The site's page on tests: each file written and each command typed, as it says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from student import Student

from ros2_on_pip.create.texts import MARKS, TEST_DEPENDENCIES
from ros2_on_pip.domain_lease import leased_domain
from roslings.course import root

PAGE = (root() / "site/pages/reference/colcon-test.md").read_text("utf-8")
TO_SAVE = re.compile(r"[Ss]ave this as\s+`~/([^`]+)`:\n\n```python\n(.*?)^```$", re.M | re.S)
SHOWN = re.compile(r"^```text\n(.*?)^```$", re.M | re.S)
CHANGE = re.compile(r"^```diff\n-(.*)\n\+(.*)\n```$", re.M)


@pytest.fixture
def student(tmp_path: Path) -> Iterator[Student]:
    """With an empty home, in the course's folder."""
    with leased_domain() as domain, ExitStack() as stack:
        yield Student(tmp_path, domain, stack, PAGE)


def types_all(student: Student) -> str:
    """The next block to its end; all that it has said."""
    terminal, said = student.types()
    terminal.is_free()
    return said + terminal.heard()


def exit_code(student: Student) -> str:
    """Of what was typed last."""
    terminal = student.terminal(1)
    terminal.type("echo code $?")
    terminal.is_free()
    return terminal.heard()


def results_again(student: Student) -> str:
    """Of the tests as they are now, without a build."""
    terminal = student.terminal(1)
    terminal.type("(cd ~/try_ws && colcon test > /dev/null 2>&1; colcon test-result --verbose)")
    terminal.is_free()
    return terminal.heard()


def test_each_file_that_is_there_is_explained() -> None:
    """The three of `ros2 pkg create`, and what they need."""
    marks = [mark for mark in MARKS if mark != "linter"]
    assert re.findall(r"^\| `(test_\w+\.py)` \|", PAGE, re.M) == [f"test_{m}.py" for m in marks]
    for name in TEST_DEPENDENCIES:
        assert name.removeprefix("python3-") in PAGE
    assert "the four lines `<test_depend>`" in PAGE and len(TEST_DEPENDENCIES) == 4


@pytest.mark.slow
def test_the_page_on_tests_goes_as_it_tells(student: Student) -> None:
    """A test fails as it is shown, is mended, and passes; what is odd is said as in its table."""
    home, (failed, why, _) = student.home, SHOWN.findall(PAGE)
    assert types_all(student).split()[-4:-1] == [
        "test_copyright.py",
        "test_flake8.py",
        "test_pep257.py",
    ]
    for path, text in TO_SAVE.findall(PAGE):
        (home / path).write_text(text, "utf-8")
    said = in_lines(types_all(student))
    assert failed in said and why in said
    assert "Warning" not in said
    assert "code 1" in exit_code(student)
    student.promised("The exit code of `colcon test` is 0, even now")
    student.terminal(1).type("colcon test > /dev/null 2>&1")
    student.terminal(1).is_free()
    assert "code 0" in exit_code(student)
    mends(student)


def mends(student: Student) -> None:
    """The change as it is shown; then what was odd before."""
    home, (*_, passed) = student.home, SHOWN.findall(PAGE)
    ((old, new),) = CHANGE.findall(PAGE)
    code, tests = (home / path for path, _ in TO_SAVE.findall(PAGE))
    assert old in code.read_text("utf-8")
    code.write_text(code.read_text("utf-8").replace(old, new), "utf-8")
    said = in_lines(types_all(student))
    assert passed in said and "test failures" not in said
    assert "code 0" in exit_code(student)
    assert re.search(student.promised("3 passed"), types_all(student))
    assert student.left == []

    is_odd_as_told(student, tests)


def is_odd_as_told(student: Student, tests: Path) -> None:
    """Each row of the last table."""
    terminal = student.terminal(1)
    terminal.type("cd ~/try_ws; python3 -m pytest src/power/test/test_battery.py")
    terminal.is_free()
    assert re.search(student.promised("No module named 'power'"), terminal.heard())
    text = tests.read_text("utf-8")
    tests.write_text(text.replace("import percent", "import procent"), "utf-8")
    said = results_again(student)
    for words in ("1 error", "collection failure"):
        assert re.search(student.promised(words), said), said
    tests.rename(tests.with_name("battery_tests.py"))
    assert re.search(student.promised("Summary: 3 tests"), results_again(student))


def in_lines(said: str) -> str:
    """A terminal's line ends as a file has them."""
    return said.replace("\r\n", "\n")
