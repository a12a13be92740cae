"""What can be seen of a lab without running anything is told at once, before the first grading."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from roslings.course import Lab, all_labs, lab, root
from roslings_prove.consistency import files_fit
from roslings_prove.new_lab import new_lab
from roslings_prove.prove import can_be_made, packages_of
from roslings_prove.telling import told

LABS = {each.name: each for each in [*all_labs(), lab("example")]}
DAYS = root() / "days"
NAME = "line-follower"
SLOW = "mutants/rate_2_hz.yaml"
CODE = "follower/follower.py"


@pytest.fixture
def made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lab:
    """The example under another name, in a course with two lessons; to be broken."""
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    for day in ("02-nodes", "03-topics"):
        (tmp_path / "days" / day).mkdir(parents=True)
        shutil.copy(DAYS / day / "lesson.ipynb", tmp_path / "days" / day)
    return new_lab(NAME, package="follower", day="03-topics")


def change(file: Path, old: str, new: str) -> None:
    """One place of a file."""
    text = file.read_text("utf-8")
    assert text.count(old) == 1, f"{file.name} has {old!r} {text.count(old)} times"
    file.write_text(text.replace(old, new), "utf-8")


def wrong() -> dict[str, str]:
    """Rule to what is wrong by it."""
    found = [proof for proof in files_fit(lab(NAME)) if not proof.holds]
    return {proof.about.removeprefix(f"{NAME}: "): proof.problem for proof in found}


HINTS = "each check has a hint, and each hint a check"
ANCHORS = "each hint leads to a paragraph of a lesson"
MUTANTS = "each check is shown at work by a mutant"
NAMES = "each mutant names checks of the card"
TASK = "task.md says what the card says"
FITS = "each mutant fits the solution"
OWN = "each mutant is a package of its own"
POINTS = "the card gives points for the grader's checks"
ORDER = "what a check needs, and what explains it, is checked before"
FAULTS = "each fault that is named is one"
ASKED = "what experiments and checks ask for is there"
DEFINED = "each name in the grader is defined"
READ = "its files can be read"
RULES = {
    HINTS,
    ANCHORS,
    MUTANTS,
    NAMES,
    TASK,
    FITS,
    OWN,
    POINTS,
    ORDER,
    FAULTS,
    ASKED,
    DEFINED,
    READ,
}


@pytest.mark.parametrize("each", LABS.values(), ids=LABS)
def test_the_files_of_a_lab_fit(each: Lab) -> None:
    """By every rule, in every lab of the course."""
    proofs = list(files_fit(each))
    assert [proof.line for proof in proofs if not proof.holds] == []
    assert {proof.about.removeprefix(f"{each.name}: ") for proof in proofs} == RULES


def test_a_new_lab_fits(made: Lab) -> None:
    """In a course with lessons, too: what breaks below was whole before."""
    assert wrong() == {}


GRADER = f"../../graders/grade_{NAME.replace('-', '_')}.py"
CASES: dict[str, tuple[tuple[str, str, str], str, str]] = {
    "a hint is missing": (
        ("hints.yaml", "\ntopic:", "\ntopics:"),
        HINTS,
        "without one: topic",
    ),
    "a hint has no check": (
        ("hints.yaml", "\ntopic:", "\ntopics:"),
        HINTS,
        "hints without a check: topics",
    ),
    "an anchor is dead": (
        ("hints.yaml", "#timers", "#timer"),
        ANCHORS,
        "days/03-topics#timer leads nowhere",
    ),
    "a lesson is not there": (
        ("hints.yaml", "days/03-topics#timers", "days/30-topics#timers"),
        ANCHORS,
        "days/30-topics#timers leads nowhere",
    ),
    "the points are too few": (
        ("card.yaml", "  ends: 5", "  ends: 4"),
        READ,
        "the points add up to 99, not to 100",
    ),
    "the grader has no such check": (
        ("card.yaml", "  ends: 5", "  ends: 3\n  extra: 2"),
        POINTS,
        "points, and no check in the grader: extra",
    ),
    "a check has no points": (
        (GRADER, "def test_ends(", "def test_ending("),
        POINTS,
        "checks without points: ending",
    ),
    "a check that nobody fails": (
        ("card.yaml", "  ends: 5", "  ends: 3\n  extra: 2"),
        MUTANTS,
        "nobody has seen these fail: extra",
    ),
    "the task is old": (
        ("card.yaml", "hz: 1.0", "hz: 2.0"),
        TASK,
        f"python -m roslings.course.task {NAME}",
    ),
    "a mutant fails in a check that is not there": (
        (SLOW, "fails: [rate]", "fails: [rates]"),
        NAMES,
        f"{SLOW}: fails: no check of this name: rates",
    ),
    "a mutant skips a check that is not there": (
        (SLOW, "fails: [rate]", "fails: [rate]\nskips: [txt]"),
        NAMES,
        f"{SLOW}: skips: no check of this name: txt",
    ),
    "a mutant has a fault where it does not fail": (
        (SLOW, "fails: [rate]", "fails: [rate]\nfaults: {text: TooSlow}"),
        NAMES,
        f"{SLOW}: faults: it must not fail there: text",
    ),
    "a fault is misspelt": (
        (SLOW, "fails: [rate]", "fails: [rate]\nfaults: {rate: TooSlov}"),
        FAULTS,
        f"{SLOW}: no fault of this name: TooSlov",
    ),
    "an edit finds nothing": (
        (SLOW, "create_timer(1.0,", "timer(9.9,"),
        FITS,
        f"{SLOW}: edit 1 of 1: 'timer(9.9,' stands 0 times in {CODE}",
    ),
    "an edit finds two places": (
        (SLOW, "create_timer(1.0,", "self."),
        FITS,
        f"{SLOW}: edit 1 of 1: 'self.' stands",
    ),
    "an edit's file is not there": (
        (SLOW, CODE, "follower/walker.py"),
        FITS,
        f"{SLOW}: edit 1 of 1: No such file or directory: follower/walker.py",
    ),
    "a file to remove is not there": (
        (SLOW, "fails: [rate]", "fails: [rate]\nremove: [gone.py]"),
        FITS,
        f"{SLOW}: remove: No such file or directory: gone.py",
    ),
    "a mutant is no YAML of a mutant": (
        (SLOW, "fails:", "failing:"),
        READ,
        f"{SLOW}:",
    ),
    "the task has a damaged section": (
        ("task.md", "<!-- card: contract -->", "<!-- card: contact -->"),
        TASK,
        "task.md:",
    ),
    "what accounts for a sentence is misspelt": (
        ("promises.yaml", "sentences:", "sentence:"),
        READ,
        "promises.yaml:",
    ),
    "the solution is not there": (
        ("card.yaml", "package: follower", "package: walker"),
        READ,
        "solution/walker: there is no such folder",
    ),
    "the grader is no Python": (
        (GRADER, "def test_ends(", "def test_ends(("),
        READ,
        "SyntaxError",
    ),
    "a demand is misspelt": (
        (GRADER, "import count_up, have_rate", "import count_up, hav_rate"),
        READ,
        "ImportError: cannot import name 'hav_rate'",
    ),
    "a name in an experiment is misspelt": (
        (GRADER, "scene.watch(ALIVE)", "scene.watch(ALIFE)"),
        DEFINED,
        "NameError: name 'ALIFE' is not defined",
    ),
    "a check asks for no experiment": (
        (GRADER, "test_text(telling:", "test_text(tellin:"),
        ASKED,
        "it asks for 'tellin', and no experiment is called so. There are: package, telling",
    ),
    "an experiment asks for no earlier one": (
        (GRADER, "def telling(scene: Scene)", "def telling(scene: Scene, before: object)"),
        ASKED,
        "it asks for 'before', and no experiment before it is called so. There are: none",
    ),
    "a check needs a later one": (
        (GRADER, 'needs=["builds"]', 'needs=["ends"]'),
        ORDER,
        "needs: no earlier check: ends",
    ),
}


@pytest.mark.parametrize(("broken", "rule", "said"), CASES.values(), ids=CASES)
def test_each_mistake_is_told_by_its_rule(
    broken: tuple[str, str, str], rule: str, said: str, made: Lab
) -> None:
    """With file and place."""
    file, old, new = broken
    change(made.folder / file, old, new)
    assert said in wrong()[rule]


def test_a_mistake_in_the_grader_is_told_with_its_line(made: Lab) -> None:
    """As an editor opens it, with the line itself and the next step."""
    change(made.folder / GRADER, "import count_up, have_rate", "import count_up, hav_rate")
    told_of_it = wrong()[READ]
    assert "The grader has a mistake: graders/grade_line_follower.py:7" in told_of_it
    assert "from roslings.capabilities.topics.demands import count_up, hav_rate" in told_of_it
    assert "mends this line, and types the same" in told_of_it


def test_two_mutants_of_one_content_are_told(made: Lab) -> None:
    """Also where only a comment is another, and a mutant that is the solution."""
    slow = made.folder / SLOW
    text = slow.read_text("utf-8")
    twin = text.replace("create_timer(0.5,", "create_timer(  # slow\\n            0.5,")
    (made.folder / "mutants/slow.yaml").write_text(twin, "utf-8")
    (made.folder / "mutants/whole.yaml").write_text("what: Nothing.\nfails: [rate]\n", "utf-8")
    assert wrong() == {
        OWN: f"mutants/slow.yaml: the same package as {SLOW}\n"
        "       mutants/whole.yaml: the same package as the solution"
    }


def break_several(made: Lab) -> None:
    """Two mutants that do not apply, one of them in two edits; a hint; an anchor; the points."""
    code = made.solution / CODE
    change(code, "(1.0,", "(1.5,")
    change(made.folder / "mutants/wrong_topic.yaml", "edits:", TWO_EDITS)
    change(made.folder / "hints.yaml", "\ntopic:", "\ntopics:")
    change(made.folder / "hints.yaml", "#timers", "#timer")


TWO_EDITS = f"""edits:
  - file: {CODE}
    find: "nowhere at all"
    replace: ""
  - file: {CODE}
    find: "not here either"
    replace: \"\""""


def test_all_mistakes_are_told_at_once(made: Lab) -> None:
    """Every edit of every mutant, and each other rule; what applies goes on being tried."""
    break_several(made)
    found = wrong()
    assert {HINTS, ANCHORS, FITS} <= found.keys()
    steps = found[FITS].splitlines()
    assert [line.partition(": '")[0].strip() for line in steps if "wrong_topic" in line] == [
        f"mutants/wrong_topic.yaml: edit {number} of 3" for number in (1, 2)
    ]
    assert any(SLOW in line for line in steps)


def test_a_card_that_is_wrong_keeps_nothing_else_from_being_told(made: Lab) -> None:
    """A check more, and no points taken away: hint and mutant are missed all the same, and what
    does not apply is told.
    """
    change(made.folder / "card.yaml", "  ends: 5", "  ends: 5\n  extra: 2")
    change(made.folder / "card.yaml", "build_type:", "built_type:")
    change(made.folder / SLOW, "create_timer(1.0,", "timer(9.9,")
    found = wrong()
    assert "timer(9.9," in found[FITS]
    assert "extra" in found[HINTS] and "extra" in found[MUTANTS]
    assert "add up to 102" in found[READ] and "built_type" in found[READ]


# --- the command -------------------------------------------------------------------------------


def prove(course: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """What an author types."""
    command = [sys.executable, "-m", "roslings", "prove", *words]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=course)


@pytest.mark.parametrize("word", ["--packages", "--contract", "--record", "--kept", "--due"])
def test_nothing_is_graded_where_files_do_not_fit(word: str, made: Lab, tmp_path: Path) -> None:
    """All that is wrong is printed on 80 columns, and no grading has a line."""
    break_several(made)
    done = prove(tmp_path, NAME, word, "--all")
    assert done.returncode == 1, done.stdout + done.stderr
    assert "edit 2 of 3" in done.stdout and "#timer leads nowhere" in done.stdout
    assert "Nothing was graded." in done.stdout or "No proof was judged or made." in done.stdout
    assert "100 of 100" not in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_a_task_that_nobody_accounts_for_is_told_before_any_grading(
    made: Lab, tmp_path: Path
) -> None:
    """As far as the contract can be seen, it is seen first."""
    with made.task.open("a", encoding="utf-8") as task:
        task.write("\nThe follower must never stop.\n")
    done = prove(tmp_path, NAME, "--contract", "--all")
    assert done.returncode == 1
    assert "never stop" in done.stdout and "Nothing was graded." in done.stdout


def test_what_cannot_be_made_is_left_out_where_grading_is_asked_for(made: Lab) -> None:
    """And nothing else is."""
    break_several(made)
    left_out = {each.name for each in packages_of(lab(NAME)) if not can_be_made(each)}
    assert f"{NAME}: mutant wrong_topic" in left_out and f"{NAME}: solution" not in left_out
    unfit = {line.split(":")[0].strip() for line in wrong()[FITS].splitlines()}
    assert {f"mutants/{name.rpartition(' ')[2]}.yaml" for name in left_out} == unfit


@pytest.mark.slow
def test_the_rest_is_graded_where_that_is_asked_for(made: Lab, tmp_path: Path) -> None:
    """For real: both what is seen and what is measured is told at the end."""
    for mutant in (made.folder / "mutants").glob("*.yaml"):
        if mutant.stem not in ("wrong_topic", "rate_2_hz"):
            mutant.unlink()
    change(made.folder / "mutants/wrong_topic.yaml", "edits:", TWO_EDITS)
    done = prove(tmp_path, NAME, "--packages", "--all", "--anyway")
    assert done.returncode == 1, done.stdout + done.stderr
    assert "edit 2 of 3" in done.stdout
    assert f"ok     {NAME}: the solution gets 100 of 100" in done.stdout
    assert f"ok     {NAME}: rate_2_hz fails rate" in done.stdout


def test_lines_of_a_proof_are_told_one_below_the_other(made: Lab) -> None:
    """Each mistake begins a line."""
    break_several(made)
    lines = list(told(list(files_fit(lab(NAME)))))
    assert sum(line.startswith("       mutants/") for line in lines) >= 3
