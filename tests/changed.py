"""`./roslings test --changed`: the tests that look at what was changed, in about a minute a lab.

Changed is what differs from the last commit, files that git does not know among it;
`--changed=main` compares with another commit. `RULES` says which tests look at which file. They are
chosen by path and not by what a test was seen to read: an author can foretell them. Whatever no
rule names runs in CI, and the first lines of the run say so.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

from sources import ROOT

PLUGIN = "tests-of-what-is-changed"
ENGINE, LEARN = "packages/roslings/tests", "packages/roslings-learn/tests"
CLASS, PROVE = "packages/roslings-class/tests", "packages/roslings-prove/tests"
KEPT = f"{PROVE}/test_authoring_proofs.py::test_what_is_kept_shows_what_it_must"
SOLUTION = "tests/labs/test_verdicts.py::test_the_solution_gets_the_full_score"
BUILT_TYPES = "tests/bootstrap/test_built_interfaces.py"
STYLE = "tests/test_code_style.py"
NO_TYPES = ("ruff", "formatted", "short", "lab", "machine")
"""Of the rules of the code those that take no processor for half a minute."""
WORDS = ("tests/test_names.py", "tests/test_comments.py")
"""Rules of what stands in the code for who reads it: names, and sentences beside it."""
TEXTS = ("tests/test_anchors.py",)
OF_A_LAB = (
    "tests/labs",
    f"{PROVE}/test_authoring_consistency.py",
    f"{PROVE}/test_authoring_promises.py",
    f"{PROVE}/test_authoring_contract.py",
    f"{PROVE}/test_authoring_generated.py",
    "tests/days/test_days_give_nothing_away.py",
    "tests/days/test_days_lessons.py",
)
OF_A_DAY = (
    "tests/days/test_days_lessons.py",
    "tests/days/test_days_reading.py",
    "tests/days/test_days_compared.py",
    "tests/days/test_days_quiz.py",
    "tests/drills/test_drills_files.py",
)


@dataclass(frozen=True)
class Choice:
    """The tests of a file or folder, or one test; of those with parameters the ones that fit."""

    place: str
    word: str = ""
    """What a test's parameters must name, where it has some; nothing takes all."""
    only: tuple[str, ...] = ()
    """Words of which a test's name must hold one."""
    live: bool = False
    """Slow ones too."""

    def takes(self, name: str, is_slow: bool) -> bool:
        """Whether a test of this name is one of them."""
        test, _, parameters = name.partition("[")
        of_here = test == self.place or test.startswith((f"{self.place}/", f"{self.place}::"))
        named = not self.only or any(word in test.rpartition("::")[2] for word in self.only)
        return of_here and named and self._fits(parameters) and (self.live or not is_slow)

    def _fits(self, parameters: str) -> bool:
        """A word stands alone: `nodes` is not in `no_nodes`, and `topics` is in `03-topics`."""
        if not (self.word and parameters):
            return True
        return bool(re.search(rf"(?<![a-z_]){re.escape(self.word)}(?![a-z_])", parameters))


# --- which tests look at which file ------------------------------------------------------------


def of_a_lab(name: str) -> Iterator[Choice]:
    """Its kept proofs are judged, its solution is graded, its files fit, its lesson too."""
    yield Choice(KEPT, name)
    yield Choice(SOLUTION, name, live=True)
    yield from (Choice(place, name) for place in OF_A_LAB)
    yield from (Choice(place) for place in TEXTS)
    yield Choice(STYLE, only=NO_TYPES)
    if day := _day_of(name):
        yield from of_a_day(day)


def of_a_grader(name: str) -> Iterator[Choice]:
    """`e_stop`: the lab, the tests of the folder beside its grader, what each capability holds."""
    yield from of_a_lab(name.replace("_", "-"))
    yield from (Choice(place) for place in WORDS)
    if (ROOT / "graders" / name).is_dir():
        yield Choice(f"tests/lab_folders/{name}")
        yield Choice("tests/outside/test_capabilities_conform.py")


def of_types(lab: str) -> Iterator[Choice]:
    """The lab, and whether what comes built of its message types is still what they say."""
    yield from of_a_lab(lab)
    yield Choice(BUILT_TYPES)


@cache
def _day_of(name: str) -> str | None:
    from roslings.course import all_labs  # tests of one package alone have no course

    return next((lab.card.day for lab in all_labs() if lab.name == name), None)


def of_a_day(day: str) -> Iterator[Choice]:
    """The rules of lessons, quizzes and drills; a lesson's cells are run by `test days`."""
    yield from (Choice(place, day) for place in OF_A_DAY)
    yield Choice("tests/days/test_days_rules.py")
    yield from (Choice(place) for place in TEXTS)


def of_our_code(place: str) -> Iterator[Choice]:
    """`PACKAGE/src/NAME/ROOM`: the tests of the room or the package, all kept proofs, the style."""
    package, _, _, room = place.split("/")
    own = f"packages/{package}/tests"
    usual = (f"{own}/{room}", f"tests/{room}") if package in WITH_ROOMS else (own,)
    for found in (*usual, *ROOMS.get(room, ())):
        if (ROOT / found).exists():
            yield Choice(found)
    yield Choice(KEPT)
    yield from of_any_code()


def of_a_capability(name: str) -> Iterator[Choice]:
    """Its own tests, what each capability holds, and all kept proofs."""
    yield Choice(f"{ENGINE}/capabilities/{name}")
    yield Choice("tests/outside/test_capabilities_conform.py")
    yield Choice(KEPT)
    yield from of_any_code()


def of_any_code() -> Iterator[Choice]:
    """Its style, its names, and the sentences beside it."""
    yield Choice(STYLE)
    yield from (Choice(place) for place in WORDS)


def of_courses_outside(_: str) -> Iterator[Choice]:
    """What is proven by labs of others."""
    yield Choice("tests/outside")
    yield Choice(STYLE, only=NO_TYPES)


def of_tests(place: str) -> Iterator[Choice]:
    """The file itself; of what a folder's tests share, the folder. None hides a module's name."""
    path = Path(place)
    yield Choice(place if path.name.startswith("test_") else str(path.parent))
    yield Choice(STYLE)
    yield Choice(WORDS[0])


def of_texts(_: str) -> Iterator[Choice]:
    """Links and what must not stand in a text."""
    yield from (Choice(place) for place in TEXTS)
    yield Choice(STYLE, only=("machine",))


def of_pages(_: str) -> Iterator[Choice]:
    """The site's builder, its words, and links."""
    yield Choice("tests/site")
    yield from of_texts("")


def of_the_gate(_: str) -> Iterator[Choice]:
    """What `.ci/run` tells."""
    yield Choice("tests/cli/test_ci_again.py", live=True)
    yield Choice("tests/cli/test_ci_summary.py", live=True)


def of_pins(_: str) -> Iterator[Choice]:
    """What is installed, and the rules of the code."""
    yield Choice("packages/roslings-launcher/tests/test_bootstrap_pins.py")
    yield Choice(BUILT_TYPES)
    yield Choice(STYLE)


WITH_ROOMS = ("roslings", "roslings-learn")
"""Packages whose tests have a folder for each room."""
ROOMS = {
    "commands": ("tests/cli", "tests/languages"),
    "language": ("tests/languages",),
    "false_language": ("tests/languages",),
    "label_column": ("tests/languages", "tests/cli/test_as_typed.py"),
    "drills": ("tests/languages",),
    "texts": ("tests/languages",),
    "checks": ("tests/languages/test_false_doctor.py",),
    "screen": ("tests/languages/test_false_doctor.py",),
    "course": (
        "tests/labs",
        f"{ENGINE}/judge/test_grader_mistakes.py",
        f"{ENGINE}/workspace/test_workspace_variants.py",
        f"{PROVE}/test_authoring_consistency.py",
        f"{PROVE}/test_authoring_course_files.py",
    ),
    "workspace": ("tests/cli/test_cli_startup.py",),
    "lessons": ("tests/days", "tests/site/test_site_lessons.py"),
    "record": (f"{ENGINE}/evidence",),
    "evidence": (f"{ENGINE}/evidence",),
    "capability": ("tests/outside",),
    "folders": ("tests/outside", "tests/labs", "tests/lab_folders/test_lab_folders.py"),
    "seen": (f"{ENGINE}/judge",),
    "verdict": (f"{ENGINE}/judge",),
    "grading": ("tests/cli/test_evidence.py", "tests/cli/test_platforms.py", f"{ENGINE}/report"),
    "jupyter": (f"{LEARN}/notebook", "tests/days"),
    "of_window": ("tests/days/test_days_window.py",),
    "models": (f"{ENGINE}/capabilities",),
    "hand_in": (f"{CLASS}/batch",),
    "interfaces": (BUILT_TYPES,),
}
"""Rooms whose tests stand elsewhere, too."""

RULES: tuple[tuple[str, Callable[[str], Iterator[Choice]]], ...] = (
    (r"labs/([^/]+)/interfaces/", of_types),
    (r"labs/([^/]+)/", of_a_lab),
    (r"graders/(?:grade_)?(\w+)(?:\.py$|/)", lambda name: of_a_grader(name)),
    (r"tests/proofs/([\w-]+?)(?:/|\.jsonl$)", of_a_lab),
    (r"days/(\d\d-[^/]+)/", of_a_day),
    (r"packages/roslings/src/roslings/capabilities/(\w+)/", of_a_capability),
    (r"packages/([\w-]+/src/\w+/\w+)(?:/|\.py$)", of_our_code),
    (r"(tests/outside/courses/)", of_courses_outside),
    (r"((?:packages/[\w-]+/)?tests/.+\.py)$", of_tests),
    (r"((?:site|glossary)/)", of_pages),
    (r"(\.ci/)", of_the_gate),
    (
        r"(pyproject\.toml|constraints\.txt|roslings|packages/[\w-]+/(?:pyproject\.toml|entry_points\.txt))$",
        of_pins,
    ),
    (r"(.+\.md)$", of_texts),
)
"""The first that fits a path decides; what it captures is given to the function."""


def choices_for(files: Sequence[str]) -> tuple[list[Choice], list[str]]:
    """The tests that look at these files, each once; and the files that no rule names."""
    found: dict[Choice, None] = {}
    strange: list[str] = []
    for file in files:
        rule = next(((m, of) for text, of in RULES if (m := re.match(text, file))), None)
        if rule is None:
            strange.append(file)
        else:
            found.update(dict.fromkeys(rule[1](rule[0][1])))
    return list(found), strange


# --- what is changed ---------------------------------------------------------------------------


class NoSuchCommit(Exception):
    """What was given is no commit that git knows."""


def changed_files(revision: str, course: Path) -> list[str]:
    """Against a commit, and what git does not know yet. Raises NoSuchCommit."""
    tracked = _git(course, "diff", "--name-only", "-z", revision, "--")
    new = _git(course, "ls-files", "--others", "--exclude-standard", "-z")
    return sorted({name for name in (tracked + new).split("\0") if name})


def _git(course: Path, *words: str) -> str:
    done = subprocess.run(["git", *words], cwd=course, capture_output=True, text=True, check=False)
    if done.returncode:
        raise NoSuchCommit(done.stderr.strip())
    return done.stdout


# --- for pytest --------------------------------------------------------------------------------


def add_changed_option(parser: pytest.Parser) -> None:
    """`--changed`, or `--changed=COMMIT`."""
    parser.addoption(
        "--changed",
        metavar="COMMIT",
        nargs="?",
        const="HEAD",
        help="only the tests that look at what is changed since COMMIT (HEAD)",
    )


def choose_what_is_changed(config: pytest.Config, not_slow: str) -> None:
    """Where it was asked for: only files that hold such tests are read, and only those tests run.

    A worker of pytest-xdist gets the places that were found, and chooses among their tests alike.
    """
    revision = config.getoption("--changed")
    if not revision:
        return
    try:
        files = changed_files(revision, ROOT)
    except NoSuchCommit as error:
        raise pytest.UsageError(f"--changed={revision}: {error}") from None
    choices, strange = choices_for(files)
    if config.option.markexpr == not_slow:
        config.option.markexpr = ""
    if not hasattr(config, "workerinput"):
        config.args[:] = places_of(choices)
    if not choices:
        pytest.exit(_nothing(revision, strange), returncode=0)
    config.pluginmanager.register(Changed(revision, files, choices, strange), PLUGIN)


def places_of(choices: Sequence[Choice]) -> list[str]:
    """The files and folders to read, none within another."""
    places = {choice.place.partition("::")[0] for choice in choices}
    there = sorted(place for place in places if (ROOT / place).exists())
    return [each for each in there if not any(each.startswith(f"{other}/") for other in there)]


def _nothing(revision: str, strange: Sequence[str]) -> str:
    unknown = f"No test is known to look at {', '.join(strange)}."
    told = unknown if strange else f"Nothing is changed since {revision}."
    return f"{told} All tests: ./roslings test"


class Changed:
    """Leaves all other tests out, and says so."""

    def __init__(
        self, revision: str, files: Sequence[str], choices: Sequence[Choice], strange: Sequence[str]
    ) -> None:
        self._revision, self._files, self._strange = revision, files, strange
        self._choices = choices

    def pytest_report_header(self) -> list[str]:
        """What is changed, and where the tests are that look at it."""
        places = ", ".join(places_of(self._choices))
        unknown = f"; no test is known for {', '.join(self._strange)}" if self._strange else ""
        return [
            f"changed since {self._revision}: {len(self._files)} files{unknown}",
            f"tests that look at them: {places}",
            "left out: all other tests, and the slow ones. All: ./roslings test",
        ]

    @pytest.hookimpl(tryfirst=True)
    def pytest_collection_modifyitems(
        self, config: pytest.Config, items: list[pytest.Item]
    ) -> None:
        """Keep those that a choice takes."""
        kept = [item for item in items if self._takes(item)]
        gone = [item for item in items if not self._takes(item)]
        config.hook.pytest_deselected(items=gone)
        items[:] = kept

    def _takes(self, item: pytest.Item) -> bool:
        is_slow = item.get_closest_marker("slow") is not None
        return _taken(tuple(self._choices), item.nodeid, is_slow)


@cache
def _taken(choices: tuple[Choice, ...], name: str, is_slow: bool) -> bool:
    return any(choice.takes(name, is_slow) for choice in choices)
