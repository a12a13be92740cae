"""`ros2`: hands over to the real one, or runs our own verb of the same name."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import NoReturn

from ros2_on_pip import own_output, stopping, surroundings
from ros2_on_pip.handover import hand_over
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.quick_exit import leave
from ros2_on_pip.words import OK, WRONG_USE, CommandParser, only_in_full

COMMANDS = {
    "action": "Various action related sub-commands",
    "bag": "Various rosbag related sub-commands",
    "component": "Various component related sub-commands",
    "daemon": "Various daemon related sub-commands",
    "doctor": "Check ROS setup and other potential issues",
    "interface": "Show information about ROS interfaces",
    "launch": "Run a launch file",
    "lifecycle": "Various lifecycle related sub-commands",
    "multicast": "Various multicast related sub-commands",
    "node": "Various node related sub-commands",
    "param": "Various param related sub-commands",
    "pkg": "Various package related sub-commands",
    "run": "Run a package specific executable",
    "service": "Various service related sub-commands",
    "topic": "Various topic related sub-commands",
    "wtf": "Use `wtf` as alias to `doctor`",
}
DOCTORS = ("doctor", "wtf")
FULL_ONLY = ("control", "extension_points", "extensions", "plugin", "security", "test", "trace")
BUFFERING = "--use-python-default-buffering"
STARTERS = ("launch", "run")
"""What these start writes to our own standard output."""

STOPPED = int(signal.SIGINT)
"""The exit code of the real `ros2` after Ctrl-C."""


def main(argv: Sequence[str]) -> int:
    """Run `ros2 argv...` and return its exit code."""
    hand_over("ros2", "ros2cli.cli", argv)
    return quietly(list(argv))


def begin() -> NoReturn:
    """The whole life of a process that is `ros2`."""
    try:
        leave(main(sys.argv[1:]))
    except KeyboardInterrupt:  # Ctrl-C while we were still starting
        sys.exit(STOPPED)


def quietly(argv: list[str]) -> int:
    """Run our own verb; Ctrl-C and a closed pipe end it without a word."""
    stopping.listen()
    words = argv[1:] if argv[:1] == [BUFFERING] else argv
    try:
        if words is argv:
            sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
        code = explained(lambda: run(words))
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
    except CommandProblem as problem:
        sys.stdout.flush()
        print(problem, file=sys.stderr)
        return problem.exit_code


def forget_stdout() -> None:
    """Nobody reads any more: what is left goes nowhere, without a complaint at the end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def run(argv: list[str]) -> int:
    """Choose the command and run it."""
    if "_ARGCOMPLETE" in os.environ:
        complete()
    leave_out_generator()
    if first_word(argv) not in STARTERS:
        own_output.keep()
    return run_here(argv)


def leave_out_generator() -> None:
    """Message types load, where it can be loaded, what makes them from .msg files.

    That is a fifth of the start. Where it cannot be loaded they do without; a look makes no types.
    """
    sys.modules.setdefault("rosidl_generator_py.generate_py_impl", None)  # type: ignore[arg-type]  # Python's own way to say so


def complete() -> None:
    """What the Tab key offers; it does not come back."""
    from argcomplete import autocomplete

    autocomplete(parser_for(_completed_command()), exclude=["-h", "--help"])


def run_here(argv: list[str]) -> int:
    """Run the command in this process, and leave the process as it is."""
    word = first_word(argv)
    if argv[:1] == ["--version"]:
        return no_version()
    if word not in COMMANDS and word is not None:
        return not_ours(word)
    if word in DOCTORS:
        return examine(word, argv[1:])
    options = parser_for(word).parse_args(argv)
    return int(options.run(options))


def no_version() -> int:
    """The real `ros2` has no such option either; what is asked for has an answer all the same."""
    print(
        "ros2 has no --version. This is ROS 2 Jazzy, as Python packages, and the ros2 command is"
        " that of roslings.\nAll about this computer: ros2 doctor."
        " Where ROS comes from apt: echo $ROS_DISTRO",
        file=sys.stderr,
    )
    return WRONG_USE


def examine(command: str, words: list[str]) -> int:
    """`ros2 doctor ...`: hello, the report of the real one, or the doctor of roslings."""
    if words[:1] == ["hello"]:
        from ros2_on_pip.commands.hello import run as hello

        return hello(command, words[1:])
    from ros2_on_pip.commands.doctor import run as doctor

    return doctor(command, words)


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


def parser_for(word: str | None) -> CommandParser:
    """All commands by name; of the chosen one also its verbs and options."""
    parser = CommandParser(
        prog="ros2", description="ros2 is an extensible command-line tool for ROS 2."
    )
    parser.set_defaults(run=lambda _: _help(parser))
    parser.add_argument(
        BUFFERING,
        action="store_true",
        help="Do not write each line at once, but as Python does where the output is no terminal",
    )
    words = parser.add_subparsers(title="Commands", metavar="COMMAND", parser_class=CommandParser)
    for name, about in COMMANDS.items():
        command = words.add_parser(name, help=about, description=about)
        if name == word and name not in DOCTORS:
            import_module(f"ros2_on_pip.commands.{name}").declare(command)
    return parser


def _help(parser: CommandParser) -> int:
    parser.print_help()
    print("\n  Call `ros2 COMMAND -h` for more detailed usage.")
    return OK
