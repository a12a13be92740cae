"""`ros2`: hands over to the real one, or runs our own verb of the same name."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Sequence
from importlib import import_module

from roslings.ros2 import stopping, surroundings
from roslings.ros2.handover import hand_over
from roslings.ros2.problem import Problem, did_you_mean
from roslings.ros2.words import OK, WRONG_USE, Parser, only_in_full

COMMANDS = {
    "action": "Various action related sub-commands",
    "bag": "Various rosbag related sub-commands",
    "doctor": "Check ROS setup and other potential issues",
    "interface": "Show information about ROS interfaces",
    "launch": "Run a launch file",
    "lifecycle": "Various lifecycle related sub-commands",
    "node": "Various node related sub-commands",
    "param": "Various param related sub-commands",
    "pkg": "Various package related sub-commands",
    "run": "Run a package specific executable",
    "service": "Various service related sub-commands",
    "topic": "Various topic related sub-commands",
}
FULL_ONLY = (
    "component", "control", "daemon", "extension_points", "extensions", "multicast", "plugin",
    "security", "test", "trace", "wtf",
)  # fmt: skip
STOPPED = int(signal.SIGINT)
"""The exit code of the real `ros2` after Ctrl-C."""


def main(argv: Sequence[str]) -> int:
    """Run `ros2 argv...` and return its exit code."""
    hand_over("ros2", "ros2cli.cli", argv)
    return quietly(list(argv))


def quietly(argv: list[str]) -> int:
    """Run our own verb; Ctrl-C and a closed pipe end it without a word."""
    stopping.listen()
    try:
        sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
        code = explained(lambda: run(argv))
        sys.stdout.flush()
        return code
    except KeyboardInterrupt:
        return STOPPED
    except BrokenPipeError:
        forget_stdout()
        return OK


def explained(act: Callable[[], int]) -> int:
    """What `act` returns; what it cannot do is shown as a message."""
    try:
        surroundings.prepare()
        return act()
    except Problem as problem:
        sys.stdout.flush()
        print(problem, file=sys.stderr)
        return problem.exit_code


def forget_stdout() -> None:
    """Nobody reads any more: what is left goes nowhere, without a complaint at the end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def run(argv: list[str]) -> int:
    """Choose the command and run it."""
    complete = "_ARGCOMPLETE" in os.environ
    word = _completed_command() if complete else first_word(argv)
    if not complete and word not in COMMANDS and word is not None:
        return not_ours(word)
    if word == "doctor" and not complete:
        return examine(argv[1:])
    parser = parser_for(word)
    if complete:
        from argcomplete import autocomplete

        autocomplete(parser, exclude=["-h", "--help"])
    options = parser.parse_args(argv)
    return int(options.run(options))


def examine(words: list[str]) -> int:
    """`ros2 doctor ...`: every word, options too, is for the doctor of roslings."""
    from roslings.doctor.cli import main as doctor

    return doctor(words)


def first_word(argv: Sequence[str]) -> str | None:
    """The command: the first argument, unless it is an option."""
    return argv[0] if argv and not argv[0].startswith("-") else None


def _completed_command() -> str | None:
    words = os.environ.get("COMP_LINE", "").split()[1:]
    return words[0] if words and words[0] in COMMANDS else None


def not_ours(word: str) -> int:
    """A command of the full `ros2`, or a slip of the finger."""
    if word in FULL_ONLY:
        return only_in_full(f"ros2 {word}")
    near = did_you_mean(word, COMMANDS)
    print(f"ros2: there is no command '{word}'.{near} To see all: ros2 --help", file=sys.stderr)
    return WRONG_USE


def parser_for(word: str | None) -> Parser:
    """All commands by name; of the chosen one also its verbs and options."""
    parser = Parser(prog="ros2", description="ros2 is an extensible command-line tool for ROS 2.")
    parser.set_defaults(run=lambda _: _help(parser))
    words = parser.add_subparsers(title="Commands", metavar="COMMAND", parser_class=Parser)
    for name, about in COMMANDS.items():
        command = words.add_parser(name, help=about, description=about)
        if name == word != "doctor":
            import_module(f"roslings.ros2.commands.{name}").declare(command)
    return parser


def _help(parser: Parser) -> int:
    parser.print_help()
    print("\n  Call `ros2 COMMAND -h` for more detailed usage.")
    return OK
