"""Mistakes that Python and rclpy report in words which a beginner has not met before.

Each is known by the line with which the program ended, or by the student's line above it. The hint
says what to change and where. The words are those of Python 3.10 to 3.14 and of Jazzy's rclpy.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

from ros2_on_pip.near_names import nearest
from roslings.judge.faults.sentences import Told

PACKAGES = (
    "action_msgs",
    "builtin_interfaces",
    "diagnostic_msgs",
    "example_interfaces",
    "geometry_msgs",
    "nav_msgs",
    "rcl_interfaces",
    "rclpy",
    "rosbag2_py",
    "sensor_msgs",
    "std_msgs",
    "std_srvs",
    "test_msgs",
    "tf2_msgs",
    "tf2_ros",
    "trajectory_msgs",
    "visualization_msgs",
)
"""What a beginner imports."""


@dataclass(frozen=True)
class PythonMistake(Told):
    """What a line of the last ones tells, and what to say of it."""

    ROOM: ClassVar[str] = "python"
    SENTENCES: ClassVar[tuple[str, ...]] = ("hint", "mend")
    line: ClassVar[str] = ""
    """A pattern of `re`."""
    at_the_door: ClassVar[bool] = False
    """Only where the program could not even be entered: setup.py names another one."""

    said: tuple[str, ...]
    """What the pattern found."""

    @property
    def hint(self) -> str:
        """What is wrong."""
        raise NotImplementedError

    @property
    def mend(self) -> str:
        """What mends it; empty where it is not known, or said already."""
        return ""

    @property
    def holds(self) -> bool:
        """It is this mistake, and not one that has the same words."""
        return True


class NamesAFile(PythonMistake):
    """An entry point that is a module."""

    line = r"TypeError: 'module' object is not callable"
    at_the_door = True
    hint = "In setup.py, under console_scripts, this executable names a file and no function in it."
    mend = "Write 'NAME = PACKAGE.FILE:main'."


class NoSuchFile(PythonMistake):
    """An entry point in a module that is not there."""

    line = r"No module named '(?:\w+\.)+(\w+)'"
    at_the_door = True
    hint = (
        "setup.py says under console_scripts that this executable is in {said[0]}.py,"
        " and there is no such file. Compare each letter with the names of your files."
    )


class NoSuchFunction(PythonMistake):
    """An entry point of a module that has none of this name."""

    line = r"AttributeError: module '(?:\w+\.)*(\w+)' has no attribute '(\w+)'"
    at_the_door = True
    hint = (
        "setup.py asks for the function {said[1]} of {said[0]}.py, and there is"
        " none of that name. Compare what stands behind the colon with your `def`."
    )


class MisspeltPackage(PythonMistake):
    """An import of a package that has nearly the name of a known one."""

    line = r"No module named '(\w+)'"
    hint = "There is no package {said[0]}. Did you mean {meant}? Look at your imports."

    @property
    def meant(self) -> str:
        """The package that was probably meant; empty where none is like it."""
        near = nearest(self.said[0], PACKAGES)
        return near.found if near and near.how in ("case", "spelling") else ""

    @property
    def holds(self) -> bool:
        """Other names may be anything."""
        return bool(self.meant)


class CalledAtOnce(PythonMistake):
    """A callback with brackets: rclpy gets None."""

    line = "|".join(
        (
            r"TypeError: 'NoneType' object is not callable",
            r"__init__\(\): callback should be either be callable",
            r"create_timer\([^,]+, *self\.\w+\(\)",
            r"create_(?:subscription|service)\([^,]+,[^,]+, *self\.\w+\(\)",
        )
    )
    hint = (
        "create_timer, create_subscription and create_service want a function. What do they get"
        " here: the function, or what it gives back?"
    )
    mend = (
        "Name the function itself: self.tell. With brackets, self.tell(), Python calls it at once,"
        " and hands over what it gave back: None."
    )


class WholeNumberDefault(PythonMistake):
    """A parameter that is an integer gets a double."""

    line = r"Trying to set parameter '(\w+)' to '.*' of type 'DOUBLE', expecting type 'INTEGER'"
    hint = (
        "The default in declare_parameter('{said[0]}', ...) is a whole number, so"
        " the parameter takes no other."
    )
    mend = "Write the default with a point: 1.0, and not 1."


class NoDepth(PythonMistake):
    """A publisher without a quality of service."""

    line = r"create_publisher\(\) missing 1 required positional argument: 'qos_profile'"
    hint = "create_publisher wants three things. How many does it get here?"
    mend = "The three are the type, the name, and a number such as 10: so many messages may wait."


class TextInPlaceOfMessage(PythonMistake):
    """A text is published, and no message."""

    line = r"TypeError: Expected <class '[\w.]+\.(\w+)'>, got <class 'str'>"
    hint = "publish() wants a message of the type {said[0]}, and got a text."
    mend = (
        "Make one, message = {said[0]}(), put the text into message.data, and publish the message."
    )


KNOWN: tuple[type[PythonMistake], ...] = (
    NamesAFile,
    NoSuchFile,
    NoSuchFunction,
    MisspeltPackage,
    CalledAtOnce,
    WholeNumberDefault,
    NoDepth,
    TextInPlaceOfMessage,
)
"""Of two that fit one line, the first one holds."""


def hint_for(log: Sequence[str]) -> str:
    """What the mistake is that the log names; empty where it names none of these."""
    known = next(_known(log), None)
    return known.hint if known else ""


def mend_for(log: Sequence[str]) -> str:
    """What mends it; empty where it is not known, or said already."""
    known = next(_known(log), None)
    return known.mend if known else ""


def _is_of_the_program(line: str) -> bool:
    """A line of a traceback that names a file of code: Python came as far as that."""
    found = re.search(r'File "([^"]+\.py)", line', line)
    return found is not None and "importlib" not in found[1]


def _known(log: Sequence[str]) -> Iterator[PythonMistake]:
    """The mistakes that there is something to say of, the last line's first."""
    entered = any(_is_of_the_program(line) for line in log)
    for line in reversed(log):
        for kind in KNOWN:
            found = re.search(kind.line, line)
            mistake = kind(found.groups()) if found else None
            if mistake and not (kind.at_the_door and entered) and mistake.holds:
                yield mistake


SYNTAX = {
    "tabs": "inconsistent use of tabs and spaces",
    "indent": "unexpected indent",
    "unindent": "unindent does not match",
    "block": "expected an indented block",
    "bracket": "was never closed",
    "text": "unterminated string",
    "colon": "expected ':'",
}
"""Short names of errors of syntax to a part of Python's words."""

SYNTAX_HINTS = {
    "tabs": "This line begins with tabs, and the others with spaces"
    " (or the other way round). They look alike. Let your editor turn tabs into spaces.",
    "indent": "This line stands further to the right than the one above it, for no"
    " reason. Give both the same number of spaces.",
    "unindent": "This line stands under no other one: count the spaces before it."
    " Each block has four more than the line that begins it.",
    "block": "After a line that ends with a colon, the next one stands four"
    " spaces further to the right.",
    "bracket": "Count the brackets of that line: one is opened and not closed.",
    "text": "A text begins with a quotation mark and needs the same one at its end.",
    "colon": "A line with if, for, while, def, class, try or else ends with a colon.",
}
"""The same names to what to do."""


def syntax_mistake(said: str) -> str:
    """The short name of an error of syntax; empty where Python's words are none of these."""
    return next((name for name, words in SYNTAX.items() if words in said), "")
