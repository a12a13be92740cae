"""The words after `ros2`: a command, its verb, and the options."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NoReturn

Run = Callable[[argparse.Namespace], int]
Completer = Callable[..., list[str]]

OK, FAILED, WRONG_USE = 0, 1, 2
NOT_READ_HERE = 69
"""Exit code of our `ros2 launch` for a file that only the full ROS reads: EX_UNAVAILABLE of
sysexits(3). Of such a file nothing can be said."""
_CHOICE = re.compile(
    r"invalid choice: '(?P<typed>[^']*)' \((maybe you meant: |choose from )(?P<choices>.*)\)"
)


class CommandParser(argparse.ArgumentParser):
    """argparse with one line where a word is wrong, and a near miss where there is one."""

    def error(self, message: str) -> NoReturn:
        """Say what is wrong and how to read more; exit 2 as argparse does."""
        message = _with_near_miss(message)
        self.exit(WRONG_USE, f"{self.prog}: {message}\nTo see all words: {self.prog} --help\n")


def _with_near_miss(message: str) -> str:
    """argparse lists all choices; the one that was meant is enough, where there is one."""
    found = _CHOICE.search(message)
    if not found:
        return message
    from ros2_on_pip.problem import did_you_mean

    choices = re.findall(r"[\w.-]+", found["choices"])
    near = did_you_mean(found["typed"], choices)
    return f"there is no '{found['typed']}' here.{near or ' There is: ' + ', '.join(choices)}"


class Verbs:
    """Adds the verbs of one command."""

    def __init__(
        self, parser: argparse.ArgumentParser, absent: Iterable[str] | Mapping[str, str] = ()
    ) -> None:
        """`absent` names the verbs that only the full `ros2` has, and what to use instead."""
        self._words = parser.add_subparsers(title="Commands", metavar="VERB", required=False)
        parser.set_defaults(run=lambda _: _show_help(parser))
        for verb in absent:
            instead = absent[verb] if isinstance(absent, Mapping) else ""
            self._add_absent(parser.prog, verb, instead)

    def __call__(self, verb: str, about: str, run: Run) -> argparse.ArgumentParser:
        """A verb that calls `run`."""
        word = self._words.add_parser(
            verb,
            help=about,
            description=about,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        word.set_defaults(run=run)
        return word

    def _add_absent(self, command: str, verb: str, instead: str) -> None:
        """It is not in the list of verbs, and says where it is when somebody types it."""
        word = self._words.add_parser(verb, add_help=False, prefix_chars="\0")
        word.add_argument("rest", nargs="*")
        word.set_defaults(run=lambda _: only_in_full(f"{command} {verb}", instead))


def only_in_full(words: str, instead: str = "") -> int:
    """Say that `words` belong to the full installation, and what does the same here."""
    import sys

    print(
        f"'{words}' is part of the full ros2, which needs Ubuntu 24.04:"
        " sudo apt install ros-jazzy-ros-base",
        *([f"Here, use instead: {instead}"] if instead else []),
        sep="\n",
        file=sys.stderr,
    )
    return WRONG_USE


def _show_help(parser: argparse.ArgumentParser) -> int:
    parser.print_help()
    return OK


def add(
    parser: argparse._ActionsContainer, *names: str, complete: Completer | None = None, **how: Any
) -> None:
    """Add an argument, with what the Tab key offers for it."""
    action = parser.add_argument(*names, **how)
    if complete:
        action.completer = complete  # type: ignore[attr-defined]  # argcomplete looks for it


def positive(text: str) -> int:
    """A whole number above zero, for argparse."""
    return int(_at_least(text, int, 1))


def not_negative(text: str) -> int:
    """A whole number, zero or more, for argparse."""
    return int(_at_least(text, int, 0))


def rate(text: str) -> float:
    """A number above zero, for argparse."""
    value = _number(text, float)
    if not value > 0:
        raise argparse.ArgumentTypeError(f"{text} is not above zero")
    return float(value)


def seconds(text: str) -> float:
    """A duration in seconds, zero or more, for argparse."""
    return float(_at_least(text, float, 0))


def positive_seconds(text: str) -> float:
    """A duration in seconds, above zero, for argparse."""
    return rate(text)


def _at_least(text: str, kind: type[Any], least: int) -> Any:
    value = _number(text, kind)
    if value < least:
        raise argparse.ArgumentTypeError(f"{text} is less than {least}")
    return value


def _number(text: str, kind: type[Any]) -> Any:
    try:
        return kind(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no number") from None
