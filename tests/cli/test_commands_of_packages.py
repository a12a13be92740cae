"""Each package brings its commands; the launcher finds them all, before anything is installed."""

from __future__ import annotations

import configparser
from importlib.metadata import entry_points

import pytest

from roslings_desk.book_names import WINDOWS
from roslings_launcher.cli.table import GROUP, ORDER, CommandEntry, commands
from roslings_launcher.virtual import COMMANDS
from sources import ROOT

LISTED = [command for command in commands().values() if command.about]


def test_each_listed_command_has_its_place() -> None:
    """In the order of `--help`; none that is gone is named there."""
    assert {command.name for command in LISTED} - {""} == set(ORDER)


@pytest.mark.parametrize("command", commands().values(), ids=lambda each: each.name or "today")
def test_each_command_is_there(command: CommandEntry) -> None:
    """Its options and what it runs stand in one file; or it reads its words itself."""
    found = command.load()
    if command.reads_its_words:
        assert callable(found)
    else:
        assert callable(found.add_options)
        assert callable(found.run)


def test_programs_on_the_path_are_commands() -> None:
    """An environment of the course has a small program for each."""
    assert set(COMMANDS) <= commands().keys()
    windows = {name for name in commands() if name.startswith("rqt")}
    assert windows <= set(COMMANDS) and windows <= set(WINDOWS)


def test_a_package_offers_what_it_brings() -> None:
    """By entry points, as a wheel of it does; the environment has those of all packages."""
    offered = set()
    for file in ROOT.glob("packages/*/entry_points.txt"):
        read = configparser.ConfigParser(delimiters=("=",))
        read.read(file, "utf-8")
        offered |= {name for name in read[GROUP]}
    assert offered == {
        folder.name
        for folder in ROOT.glob("packages/*/src/*")
        if (folder / "command_names.py").is_file()
    }
    installed = entry_points(group=GROUP)
    assert {point.name for point in installed} >= offered
    rows = {row[1] for point in installed for row in point.load()}
    assert rows >= commands().keys()
