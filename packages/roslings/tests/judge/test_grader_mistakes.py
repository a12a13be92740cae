"""A mistake in a grader is told with its line, Python's words and the next step; nothing runs."""

from __future__ import annotations

import shutil
import traceback
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from ros2_on_pip.errors import INCONCLUSIVE
from roslings.course import Lab, lab
from roslings.course.grader import load_grader
from roslings.evidence import Evidence, MachineSeen
from roslings.experiment import MeasuringFailed
from roslings.grading.checking import mistakes_told
from roslings.judge import GraderBroke, judge
from roslings.judge.grader_mistakes import mistake_in, mistake_of, why_it_broke_off
from roslings.judge.loaded import judge_loaded
from roslings.judge.undefined import undefined_names
from roslings.verdict import CheckResult
from roslings.workspace.inspect import inspect_package

EXAMPLE = lab("example")
TELLING = "        scene.watch(ALIVE)"
DEPENDS = "test_depends = depends"


def broken(folder: Path, old: str, new: str) -> Lab:
    """The example, with one place of its grader changed."""
    grader = folder / "grade_example.py"
    text = EXAMPLE.grader.read_text("utf-8")
    assert text.count(old) == 1
    grader.write_text(text.replace(old, new), "utf-8")
    shutil.copytree(EXAMPLE.folder, folder / "example")
    return replace(EXAMPLE, folder=folder / "example", grader=grader)


def line_of(grader: Path, words: str) -> int:
    """Where the words stand."""
    lines = grader.read_text("utf-8").splitlines()
    (number,) = (number for number, line in enumerate(lines, 1) if words in line)
    return number


def evidence() -> Evidence:
    """Of a package of which nothing was built."""
    machine = MachineSeen(
        roslings="0", ros_distro="jazzy", rmw="r", python="3", platform="p", isolation="user"
    )
    package = inspect_package(EXAMPLE.solution, EXAMPLE.card)
    return Evidence(lab="example", seed=1, machine=machine, package=package)


# --- what cannot be loaded ---------------------------------------------------------------------

WHEN_LOADED = {
    "no Python": ("def test_runs(", "def test_runs((", "def test_runs((", "SyntaxError"),
    "a demand is misspelt": (
        "import count_up, have_rate, say",
        "import count_up, hav_rate, say",
        "hav_rate",
        "ImportError: cannot import name 'hav_rate'",
    ),
    "no such module": (
        "from roslings.course import lab",
        "from roslings.corse import lab",
        "roslings.corse",
        "ModuleNotFoundError: No module named 'roslings.corse'",
    ),
    "a name is misspelt": (
        "ALIVE = BEACON.publishes[0]",
        "ALIVE = BECON.publishes[0]",
        "BECON",
        "NameError: name 'BECON' is not defined",
    ),
    "the card has no such node": (
        'CARD.node("beacon")',
        'CARD.node("becon")',
        "becon",
        "has no executable 'becon'",
    ),
}


@pytest.mark.parametrize(("old", "new", "at", "said"), WHEN_LOADED.values(), ids=WHEN_LOADED)
def test_what_cannot_be_loaded_is_told(
    old: str, new: str, at: str, said: str, tmp_path: Path
) -> None:
    """By the judge, and by the one that has loaded its sheet before a stranger's code runs."""
    found = broken(tmp_path, old, new)
    with pytest.raises(GraderBroke) as told:
        judge(found, evidence())
    insist(told.value, found.grader, at, said)
    with pytest.raises(GraderBroke) as told, judge_loaded(found):
        raise AssertionError("it did not tell")
    insist(told.value, found.grader, at, said)


def insist(error: GraderBroke, grader: Path, at: str, said: str) -> None:
    """It says where, what, and what to do."""
    words = str(error)
    assert f"grade_example.py:{line_of(grader, at)}" in words.splitlines()[0]
    assert said in words
    assert "mends this line" in words
    assert error.exit_status == INCONCLUSIVE


# --- what breaks off in the measuring process --------------------------------------------------


def last_words(run: Callable[[], object]) -> str:
    """What a process would write that ends by what `run` raises."""
    try:
        run()
    except Exception:
        return traceback.format_exc()
    raise AssertionError("it raised nothing")


class NoScene:
    """It can do nothing: whatever is asked of it is a mistake."""

    def watch(self, topic: object) -> None:
        """One thing breaks off deeper."""
        raise ValueError("deeper")


RUNS = "    with scene.run(BEACON):\n        scene.watch(ALIVE)"


@pytest.mark.parametrize(
    ("new", "said"),
    [
        ("    scene.watch(ALIFE)", "NameError: name 'ALIFE' is not defined"),
        ("    scene.wach(ALIVE)", "AttributeError: 'NoScene' object has no attribute 'wach'"),
        ("    from roslings import nothing_such", "ImportError: cannot import name 'nothing_such'"),
    ],
)
def test_what_breaks_off_in_an_experiment_is_told(new: str, said: str, tmp_path: Path) -> None:
    """From the traceback of the process that measured."""
    found = broken(tmp_path, RUNS, new)
    experiment = load_grader(found.grader).telling
    words = last_words(lambda: experiment.function(NoScene()))
    with pytest.raises(GraderBroke) as told, mistakes_told(found):
        raise MeasuringFailed(1, words)
    insist(told.value, found.grader, new.strip(), said)
    assert ", in telling\n" in str(told.value)
    assert str(told.value).startswith("The grader has a mistake:")


def test_what_the_line_calls_may_break_off_deeper(tmp_path: Path) -> None:
    """Then the grader's line is told, and where it was raised: the mistake may be there."""
    found = broken(tmp_path, RUNS, "    scene.watch(ALIVE)")
    experiment = load_grader(found.grader).telling
    mistake = mistake_in(last_words(lambda: experiment.function(NoScene())), found.graders)
    assert mistake and mistake.line == line_of(found.grader, "scene.watch(ALIVE)")
    assert mistake.told.startswith("The grader broke off:")
    assert "ValueError: deeper  (raised in judge/test_grader_mistakes.py:" in mistake.told


def test_the_line_is_found_however_deep_it_broke_off(tmp_path: Path) -> None:
    """The message has the last words only, and the line of the grader stands far above them."""
    found = broken(tmp_path, RUNS, "    scene.watch(ALIVE)")
    experiment = load_grader(found.grader).telling
    words = last_words(lambda: experiment.function(Deep(30)))
    failure = MeasuringFailed(1, words)
    assert "grade_example.py" not in str(failure)
    with pytest.raises(GraderBroke) as told, mistakes_told(found):
        raise failure
    assert f"grade_example.py:{line_of(found.grader, 'scene.watch(ALIVE)')}" in str(told.value)


@dataclass(frozen=True)
class Deep:
    """A scene that calls itself before it breaks off."""

    times: int

    def watch(self, topic: object) -> None:
        """By two functions in turn: Python tells a line that calls itself once."""
        if not self.times:
            raise ValueError("deeper")
        self.again(topic)

    def again(self, topic: object) -> None:
        """The other one."""
        Deep(self.times - 1).watch(topic)


def test_what_is_not_the_graders_is_left_as_it_is() -> None:
    """The machine's trouble has no line in a grader."""
    failure = MeasuringFailed(1, last_words(lambda: int("x")))
    with pytest.raises(MeasuringFailed) as told, mistakes_told(EXAMPLE):
        raise failure
    assert told.value is failure
    for words in ("", "There is no lab 'tropics'", 'File "x", line y'):
        assert mistake_in(words, EXAMPLE.graders) is None
        assert why_it_broke_off(EXAMPLE, words) is None


def test_an_experiment_that_asks_for_nothing_is_told(tmp_path: Path) -> None:
    """No line of the grader has run then: the words of the process do not name it."""
    found = broken(
        tmp_path, "def telling(scene: Scene)", "def telling(scene: Scene, beter: object)"
    )
    error = why_it_broke_off(found, "KeyError: 'beter'")
    assert error
    insist(error, found.grader, "def telling", "asks for 'beter', and no experiment before it")


def test_its_words_may_not_name_the_line(tmp_path: Path) -> None:
    """Then the file tells what is wrong with it."""
    found = broken(tmp_path, "def test_runs(", "def test_runs((")
    error = why_it_broke_off(found, "SyntaxError: '(' was never closed")
    assert error
    insist(error, found.grader, "def test_runs((", "SyntaxError")


# --- what breaks off in a check ----------------------------------------------------------------


def judged(folder: Path, body: str, asks: str = "package") -> tuple[CheckResult, Path]:
    """What becomes of a check with this body."""
    check = f'def test_depends({asks}):\n    """It depends."""\n    {body}'
    found = broken(folder, DEPENDS, check)
    verdict = judge(found, evidence())
    return next(each for each in verdict.checks if each.id == "depends"), found.grader


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("assert BECON", "NameError: name 'BECON' is not defined"),
        ("package.mst(depends)", "AttributeError: 'PackageView' object has no attribute 'mst'"),
        ("from roslings.judge import dpends", "ImportError: cannot import name 'dpends'"),
    ],
)
def test_what_breaks_off_in_a_check_is_told(body: str, said: str, tmp_path: Path) -> None:
    """It is inconclusive: no points are lost, and the others are judged."""
    result, grader = judged(tmp_path, body)
    assert (result.outcome, result.fault) == ("inconclusive", "GraderBroke")
    assert result.why
    assert f"grade_example.py:{line_of(grader, body)}: {said}" in result.why
    assert "mends this line" in result.why and "tells the instructor" in result.why


def test_a_check_that_asks_for_nothing_is_told(tmp_path: Path) -> None:
    """With all that it can ask for."""
    result, grader = judged(tmp_path, "pass", asks="teling")
    assert result.outcome == "inconclusive" and result.why
    said = "it asks for 'teling', and no experiment is called so. There are: package, telling"
    assert f"grade_example.py:{line_of(grader, 'def test_depends')}: {said}" in result.why


def test_a_fault_of_a_package_is_none_of_the_grader(tmp_path: Path) -> None:
    """A bare assert is the usual way of a check."""
    result, _ = judged(tmp_path, "assert False, 'it does not'")
    assert (result.outcome, result.fault, result.measured) == ("fail", "Unmet", "it does not")


# --- what is told before anything runs ---------------------------------------------------------


def test_names_that_nothing_defines_are_found(tmp_path: Path) -> None:
    """Also in a function inside of one; what is defined, given or Python's own is none."""
    inside = "        scene.until(lambda: len([x for x in range(3)]) > ALIFE or scene)"
    found = broken(tmp_path, TELLING, inside)
    (mistake,) = undefined_names(load_grader(found.grader))
    assert mistake.line == line_of(found.grader, "ALIFE")
    assert mistake.words == "NameError: name 'ALIFE' is not defined"


def test_a_syntax_error_elsewhere_is_none_of_the_grader(tmp_path: Path) -> None:
    """What a grader imports may be another's."""
    other = tmp_path / "other.py"
    other.write_text("def (", "utf-8")
    with pytest.raises(SyntaxError) as found:
        compile("def (", str(other), "exec")
    assert mistake_of(found.value, [EXAMPLE.grader]) is None
