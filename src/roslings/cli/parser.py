"""The table of all commands, and the reader of words that is made from it."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib import import_module

from roslings import __version__
from roslings.cli import learners, teachers
from roslings.cli.options import lab_options

Command = Callable[[argparse.Namespace], int]
Options = Callable[[argparse.ArgumentParser], None]


@dataclass(frozen=True)
class Entry:
    """One command of the table."""

    name: str
    about: str
    runs: str = ""
    """MODULE:FUNCTION in `roslings.commands`; empty where the command reads its words itself."""
    options: Options | None = None


LEARNING = (
    Entry("doctor", "is this machine ready?"),
    Entry("lab", "open the day's lesson in JupyterLab", "learning:lab", learners.jupyter_options),
    Entry("drill", "a tiny program to mend: the next one, or check it", "drilling:drill",
          learners.drill_options),
    Entry("start", "put a lab's starter into your workspace", "learning:start", lab_options),
    Entry(
        "check", "run what you built, and say what to do next", "learning:check",
        learners.check_options,
    ),
    Entry("watch", "today's drill or lab: check at every save", "watch:watch",
          learners.watch_options),
    Entry("status", "which days and labs are done", "way:status"),
    Entry("diff", "what you changed since the starter", "learning:diff", lab_options),
    Entry("pack", "make the zip file to hand in", "learning:pack", learners.pack_options),
    Entry("rover", "a small robot to drive by ROS, and its map", "devices:rover",
          learners.rover_options),
    Entry("board", "the rover's Arduino board on a serial port", "devices:board",
          learners.board_options),
    Entry("camera", "the rover's camera, for a node to read", "devices:camera",
          learners.camera_options),
    Entry("graph", "show the running graph, or save a picture of it", "devices:graph",
          learners.graph_options),
    Entry("break", "ten small faults to find and mend with the doctor"),
    Entry("ros2", "the ros2 commands, where the real ones are not installed"),
    Entry("ready", "install what a command needs, and run nothing"),
)  # fmt: skip
"""What a learner types."""

TEACHING = (
    Entry("grade", "grade many submissions", "teaching:grade_all", teachers.grade_options),
    Entry("regrade", "judge saved evidence again; runs nothing", "teaching:regrade",
          teachers.regrade_options),
    Entry("override", "give a score by hand, with its reason", "teaching:override",
          teachers.override_options),
    Entry("export", "what a grading platform needs for a lab", "teaching:export",
          teachers.export_options),
    Entry("cluster", "a scheduler or worker for grade --dask", "teaching:cluster",
          teachers.cluster_options),
    Entry("new-lab", "make a small lab that works, to change it", "authoring:new_lab",
          teachers.new_lab_options),
    Entry("prove", "show that a lab's checks catch what they should", "authoring:prove",
          teachers.prove_options),
    Entry("release", "make the students' edition, without solutions", "authoring:release",
          teachers.release_options),
    Entry("site", "build the website: lessons, words, quizzes", "upkeep:site",
          teachers.site_options),
    Entry("test", "run the tests of roslings", "upkeep:test", teachers.test_options),
    Entry("wheels", "fetch every package into a folder, for a lab without a network"),
)  # fmt: skip
"""What an instructor or an author of labs types."""

NAMES = [entry.name for entry in (*LEARNING, *TEACHING)]
WIDTH = 2 + max(map(len, NAMES))


def parser() -> argparse.ArgumentParser:
    """Every command and its options."""
    top = argparse.ArgumentParser(
        prog="./roslings",
        usage="./roslings [-h] [--version] COMMAND ...",
        description="Learn ROS 2 Jazzy day by day.",
        epilog=f"{_listed('for learners', LEARNING)}\n\n"
        f"{_listed('for instructors and authors', TEACHING)}\n\n"
        "Without a command it says what is next.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    top.add_argument("--version", action="version", version=f"roslings {__version__}")
    top.set_defaults(command=command("way:today"))
    words = top.add_subparsers(metavar="COMMAND", help=argparse.SUPPRESS, prog=top.prog)
    for entry in (*LEARNING, *TEACHING):
        about = entry.about[0].upper() + entry.about[1:]
        word = words.add_parser(entry.name, description=about, allow_abbrev=False)
        if entry.runs:
            word.set_defaults(command=command(entry.runs))
        if entry.options:
            entry.options(word)
    return top


def _listed(title: str, entries: Iterable[Entry]) -> str:
    rows = [f"  {entry.name:{WIDTH}}{entry.about}" for entry in entries]
    return "\n".join([f"{title}:", *rows])


def command(runs: str) -> Command:
    """A command, MODULE:FUNCTION in `roslings.commands`, imported when it is run."""

    def call(options: argparse.Namespace) -> int:
        module, function = runs.split(":")
        chosen: Command = getattr(import_module(f"roslings.commands.{module}"), function)
        return chosen(options)

    return call
