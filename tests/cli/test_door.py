"""A path may be given relative, from any folder: whoever works for the command finds it."""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslings import course
from roslings_launcher import cli
from roslings_launcher.cli.door import absolute_paths
from roslings_launcher.paths import MAY_BE_A_WORD, PATH_VARIABLES, absolute_variables
from until_told import run_until_told

PLACES = re.compile(r"FILE|DIR|FOLDER|PATH|DEVICE")
"""What the help calls an option that takes a path."""
NO_PATHS = {
    "ROSLINGS_CHECK_PAGE": "set by the window of a day, for its terminals: absolute",
    "ROSLINGS_FOLDER": "set by the window of a day, for its terminals: absolute",
    "ROSLINGS_TERMINAL": "the name of a terminal of the window",
    "ROSLINGS_WINDOW": "the path of an address",
    "ROSLINGS_WINDOW_DOMAIN": "the number of a ROS domain",
    "ROSLINGS_ADDRESS": "where a course stands on the web",
    "ROSLINGS_BREAK": "whether a terminal has sourced an exercise",
    "ROSLINGS_GRADER": "a repository of an organisation, on GitHub",
    "ROSLINGS_ISOLATION": "the name of a wall",
    "ROSLINGS_LANGUAGE": "the name of a language",
    "ROSLINGS_MUTANTS_UNTIL": "seconds since 1970",
    "ROSLINGS_OWN_DOMAIN": "the number of a ROS domain",
    "ROSLINGS_READY_S": "seconds",
    "ROSLINGS_RESULTS": "a result itself, for the reporter of GitHub Classroom",
    "ROSLINGS_ROOMS": "numbers of rooms",
    "ROSLINGS_ROOM_SECRET": "a text that nobody else has",
    "ROSLINGS_SITE": "whether the site runs the lesson",
    "ROSLINGS_SOAK_S": "seconds",
}
HIDDEN = '''
"""One check that students do not have."""
from roslings.judge import check

POINTS = {"secret": 5}


@check()
def test_secret() -> None:
    """It is there."""
'''


def commands() -> dict[str, argparse.ArgumentParser]:
    """Each command that argparse reads."""
    (words,) = (each for each in cli.parser()._actions if isinstance(each.choices, dict))
    return dict(words.choices or {})


def taking_paths() -> list[tuple[str, str]]:
    """Each option and each place of a command line that takes a path: command, and its name."""
    return [
        (name, action.dest)
        for name, word in commands().items()
        for action in word._actions
        if PLACES.search(str(action.metavar)) or action.type is Path
    ]


def line(word: argparse.ArgumentParser, wanted: str, text: str) -> Iterator[str]:
    """Words that give `wanted`, and all that the command cannot do without."""
    at = [action.dest for action in word._actions].index(wanted)
    for number, action in enumerate(word._actions):
        is_place = not action.option_strings
        if action.dest == wanted or action.required or (is_place and number < at):
            yield from action.option_strings[-1:]
            yield text if action.dest == wanted else any_word(action)


def any_word(action: argparse.Action) -> str:
    """One that the action takes."""
    return next(iter(action.choices)) if action.choices else "1"


@pytest.mark.parametrize(("name", "option"), taking_paths())
def test_every_option_that_takes_a_path(
    name: str, option: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What the command gets is absolute, and from the folder in which it was typed."""
    got: list[argparse.Namespace] = []
    monkeypatch.setattr(cli, "run", lambda command, options: got.append(options) or 0)
    monkeypatch.chdir(tmp_path)
    cli.main([name, *line(commands()[name], option, "some/where")])
    found = getattr(got[0], option)
    assert found in (tmp_path / "some/where", [tmp_path / "some/where"])


def test_the_terminal_is_no_path() -> None:
    """`--json -` writes there."""
    assert absolute_paths(argparse.Namespace(json=Path("-"))).json == Path("-")


def test_a_home_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """The shell leaves `--to=~/x` as it is."""
    monkeypatch.setenv("HOME", "/home/ann")
    assert absolute_paths(argparse.Namespace(to=Path("~/x"))).to == Path("/home/ann/x")


def variables() -> set[str]:
    """Each variable of ours that the engine, its scripts or its templates read."""
    root = course.root()
    files = [
        root / "roslings",
        root / "setup.bash",
        *root.glob("packages/*/src/**/*"),
    ]
    texts = (
        path.read_text("utf-8", "replace")
        for path in files
        if path.is_file() and path.suffix not in (".pyc", ".png")
    )
    return {name for text in texts for name in re.findall(r"ROSLINGS_[A-Z_]+[A-Z]", text)}


def test_every_variable_is_a_path_or_none() -> None:
    """A new one is put into one of the two tables."""
    assert variables() == {*PATH_VARIABLES, *NO_PATHS}


@pytest.mark.parametrize("name", PATH_VARIABLES)
def test_every_variable_that_names_a_place(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Absolute before any command begins; a word for the shell to find stays one."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(cli, "run", lambda command, options: 0)
    monkeypatch.setenv(name, "some/where")
    cli.main(["status"])
    assert os.environ[name] == str(tmp_path / "some/where")
    own = {name: "word"}
    absolute_variables(own)
    assert own[name] == ("word" if name in MAY_BE_A_WORD else str(tmp_path / "word"))


def test_hidden_checks_are_found_from_another_folder(tmp_path: Path) -> None:
    """For real: the measuring process stands in the folder of its run."""
    (tmp_path / "graders").mkdir()
    (tmp_path / "graders/secret.py").write_text(HIDDEN)
    words = ["check", "example", "--solution", "--hidden", "graders/secret.py", "--json", "v.json"]
    done = run_until_told([sys.executable, "-m", "roslings", *words], cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    checks = json.loads((tmp_path / "v.json").read_bytes())["checks"]
    assert [check["outcome"] for check in checks if check["id"] == "secret"] == ["pass"]
