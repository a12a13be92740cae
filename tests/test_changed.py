"""`./roslings test --changed`: what is changed, and the tests that look at it."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from changed import (
    ENGINE,
    KEPT,
    OF_A_DAY,
    OF_A_LAB,
    SOLUTION,
    STYLE,
    WORDS,
    Choice,
    NoSuchCommit,
    changed_files,
    choices_for,
    places_of,
)
from roslings.course import all_labs, root
from slow import slow_files

ROOMS_WITHOUT = {"__init__", "__main__", "command_names"}
"""Parts of the engine without a folder of tests: their changes judge the proofs and the style."""
CODE = "packages/roslings/src/roslings"
OF_SERVICES = (
    "labs/services/card.yaml",
    "labs/services/mutants/slow.yaml",
    "graders/grade_services.py",
    "graders/services/act.py",
    "tests/proofs/services.jsonl",
    "tests/proofs/services/0.tar.xz",
)


def chosen(file: str, name: str, is_slow: bool = False) -> bool:
    """Whether a test of this name runs where this file is changed."""
    return any(choice.takes(name, is_slow) for choice in choices_for([file])[0])


@pytest.mark.parametrize("file", OF_SERVICES)
def test_a_file_of_a_lab_chooses_the_tests_of_that_lab(file: str) -> None:
    """Its kept proofs, its solution live, its files, its lesson; and no other lab's."""
    for name in (
        f"{KEPT}[services]",
        "tests/labs/test_content.py::test_it[services-rate]",
        "tests/labs/test_content.py::test_of_all",
        "tests/days/test_days_lessons.py::test_a_rule[04-services]",
        "tests/test_anchors.py::test_it",
        f"{STYLE}::test_the_code_is_formatted",
    ):
        assert chosen(file, name), name
    for name in (
        f"{KEPT}[topics]",
        "tests/labs/test_content.py::test_it[topics-no_services]",
        "tests/days/test_days_lessons.py::test_a_rule[03-topics]",
        f"{ENGINE}/judge/test_judge.py::test_it",
        f"{STYLE}::test_the_types_hold",
    ):
        assert not chosen(file, name), name


def test_a_folder_beside_a_grader_chooses_its_tests_too() -> None:
    """And what each capability must hold."""
    file = "graders/e_stop/act.py"
    for place in (
        "tests/lab_folders/e_stop/test_x.py",
        "tests/outside/test_capabilities_conform.py",
    ):
        assert chosen(file, f"{place}::test_it")
    assert chosen(file, f"{KEPT}[e-stop]") and not chosen(file, f"{KEPT}[topics]")


def test_of_slow_tests_the_solution_alone_is_graded() -> None:
    """Once, and no mutant."""
    file = OF_SERVICES[0]
    assert chosen(file, f"{SOLUTION}[services]", is_slow=True)
    assert not chosen(file, f"{SOLUTION}[topics]", is_slow=True)
    assert not chosen(file, "tests/labs/test_content.py::test_it[services]", is_slow=True)


def test_a_change_of_the_engine_chooses_its_room_and_all_kept_proofs() -> None:
    """Without a live run: whoever changes what judges sees the words of 600 verdicts."""
    for file, place in (
        (f"{CODE}/judge/rates.py", f"{ENGINE}/judge/test_rates.py::test_it"),
        (f"{CODE}/seen/matching.py", f"{ENGINE}/judge/test_matching.py::test_it"),
        (f"{CODE}/commands/way.py", "tests/cli/test_door.py::test_it"),
        (f"{CODE}/capabilities/qos/faults.py", f"{ENGINE}/capabilities/qos/test_x.py::test_it"),
        ("packages/ros-doctor/src/ros_doctor/mends.py", "packages/ros-doctor/tests/test_x.py::t"),
    ):
        assert chosen(file, place)
        assert all(chosen(file, f"{KEPT}[{lab.name}]") for lab in all_labs())
        assert chosen(file, f"{STYLE}::test_the_arrows_run_one_way")


def test_code_for_people_is_looked_at_by_the_rules_of_its_words() -> None:
    """Names and sentences of packages and of graders; a file of tests hides no module's name."""
    names, comments = (f"{file}::test_it" for file in WORDS)
    for file in (
        f"{CODE}/judge/rates.py",
        f"{CODE}/capabilities/qos/faults.py",
        "packages/ros-doctor/src/ros_doctor/mends.py",
        "graders/grade_services.py",
        "graders/e_stop/act.py",
    ):
        assert chosen(file, names) and chosen(file, comments), file
    assert chosen("tests/judge/test_new.py", names)
    assert not chosen("labs/services/card.yaml", comments)


def test_commands_are_looked_at_in_the_false_language() -> None:
    """Whoever adds a text is told where it has no id."""
    for file in (
        f"{CODE}/commands/way.py",
        "packages/ros2-on-pip/src/ros2_on_pip/language.py",
        "packages/roslings-learn/src/roslings_learn/drills/telling.py",
        "packages/ros-doctor/src/ros_doctor/checks/live.py",
    ):
        assert chosen(file, "tests/languages/test_false_doctor.py::t") or chosen(
            file, "tests/languages/test_false_commands.py::t"
        ), file


def test_a_file_of_slow_tests_is_chosen_with_them() -> None:
    """Named without them, it would be named in vain."""
    listed = subprocess.run(
        ["git", "ls-files"], cwd=root(), capture_output=True, text=True, check=True
    ).stdout.splitlines()
    whole = {name for name, how_many in slow_files() if how_many == "all"}
    others = [name for name in listed if "tests/" not in name]
    vain = {each.place for each in choices_for(others)[0] if each.place in whole and not each.live}
    assert vain == set()


def test_each_room_has_its_tests() -> None:
    """A room whose folder of tests has another name stands in ROOMS, or has none."""
    engine = root() / CODE
    rooms = {path.stem for path in engine.iterdir() if path.name != "__pycache__"}
    without = {
        room
        for room in rooms - {"capabilities"}
        if set(places_of(choices_for([f"{CODE}/{room}/it.py"])[0]))
        == {KEPT.partition("::")[0], STYLE, *WORDS}
    }
    assert without == ROOMS_WITHOUT & rooms


def test_what_the_rules_name_is_there() -> None:
    """A test that is renamed, or a file that moves, is renamed there too."""
    for place in (*OF_A_LAB, *OF_A_DAY, *WORDS):
        assert (root() / place).exists(), place
    for name in (KEPT, SOLUTION):
        file, test = name.split("::")
        assert re.search(rf"^def {test}\(", (root() / file).read_text("utf-8"), re.MULTILINE)


def test_each_file_of_the_repository_has_a_rule_or_is_told() -> None:
    """What no rule names is named in the run, so that nobody takes silence for a proof."""
    listed = subprocess.run(
        ["git", "ls-files"], cwd=root(), capture_output=True, text=True, check=True
    ).stdout.splitlines()
    without = {name.split("/")[0] for name in choices_for(listed)[1]}
    assert without <= {
        ".binder",
        ".devcontainer",
        ".dockerignore",
        ".gitattributes",
        ".gitignore",
        ".vscode",
        "LICENSE",
        "days",
        "example",
        "example-course",
        "graders",
        "labs",
        "packages",
        "setup.bash",
        "tests",
    }


def test_a_file_is_read_once() -> None:
    """Not again for a test in it, nor for the folder around it."""
    choices = [Choice("tests/labs"), Choice(SOLUTION), Choice(STYLE), Choice("tests/no-such")]
    assert places_of(choices) == ["tests/labs", STYLE]


def test_what_is_changed_is_what_git_tells(tmp_path: Path) -> None:
    """Changed, deleted, new, and with a strange name; not what is ignored or as it was."""

    def git(*words: str) -> None:
        subprocess.run(["git", *words], cwd=tmp_path, check=True, capture_output=True)

    git("init", "-q")
    for name in ("same", "other", "gone", ".gitignore"):
        (tmp_path / name).write_text("ignored\n")
    git("add", ".")
    git("-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "first")
    (tmp_path / "other").write_text("new words")
    (tmp_path / "gone").unlink()
    (tmp_path / "ignored").touch()
    (tmp_path / "a new ü").touch()
    assert changed_files("HEAD", tmp_path) == ["a new ü", "gone", "other"]
    with pytest.raises(NoSuchCommit, match="no-such"):
        changed_files("no-such", tmp_path)
