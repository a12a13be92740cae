"""Mistakes that Python and rclpy report in words which a beginner has not met before.

Each is known by the line with which the program ended, or by the student's line above it; the hint
says what to change and where. The words are those of Python 3.10 to 3.14 and of Jazzy's rclpy.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from ros2_on_pip.near_names import nearest

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

NOT_CALLED = (
    "create_timer, create_subscription and create_service want a function. What do they get"
    " here: the function, or what it gives back?"
)
ITSELF = (
    "Name the function itself: self.tell. With brackets, self.tell(), Python calls it at once, and"
    " hands over what it gave back: None."
)


@dataclass(frozen=True)
class Known:
    """A line of the last ones, and what to say of it."""

    line: str
    """A pattern of `re`."""
    hint: Callable[[re.Match[str]], str]
    mend: str = ""
    """What mends it; `{0}` is the first thing that the pattern found."""
    at_the_door: bool = False
    """Only where the program could not even be entered: setup.py names another one."""


def _misspelt_package(found: re.Match[str]) -> str:
    near = nearest(found[1], PACKAGES)
    if near and near.how in ("case", "spelling"):
        return f"There is no package {found[1]}. Did you mean {near.found}? Look at your imports."
    return ""


KNOWN = (
    Known(
        r"TypeError: 'module' object is not callable",
        lambda _: (
            "In setup.py, under console_scripts, this executable names a file and no function"
            " in it."
        ),
        "Write 'NAME = PACKAGE.FILE:main'.",
        at_the_door=True,
    ),
    Known(
        r"No module named '(?:\w+\.)+(\w+)'",
        lambda found: (
            f"setup.py says under console_scripts that this executable is in {found[1]}.py,"
            " and there is no such file. Compare each letter with the names of your files."
        ),
        at_the_door=True,
    ),
    Known(
        r"AttributeError: module '(?:\w+\.)*(\w+)' has no attribute '(\w+)'",
        lambda found: (
            f"setup.py asks for the function {found[2]} of {found[1]}.py, and there is"
            " none of that name. Compare what stands behind the colon with your `def`."
        ),
        at_the_door=True,
    ),
    Known(r"No module named '(\w+)'", _misspelt_package),
    Known(r"TypeError: 'NoneType' object is not callable", lambda _: NOT_CALLED, ITSELF),
    Known(r"__init__\(\): callback should be either be callable", lambda _: NOT_CALLED, ITSELF),
    Known(r"create_timer\([^,]+, *self\.\w+\(\)", lambda _: NOT_CALLED, ITSELF),
    Known(
        r"create_(?:subscription|service)\([^,]+,[^,]+, *self\.\w+\(\)",
        lambda _: NOT_CALLED,
        ITSELF,
    ),
    Known(
        r"Trying to set parameter '(\w+)' to '.*' of type 'DOUBLE', expecting type 'INTEGER'",
        lambda found: (
            f"The default in declare_parameter('{found[1]}', ...) is a whole number, so"
            " the parameter takes no other."
        ),
        "Write the default with a point: 1.0, and not 1.",
    ),
    Known(
        r"create_publisher\(\) missing 1 required positional argument: 'qos_profile'",
        lambda _: "create_publisher wants three things. How many does it get here?",
        "The three are the type, the name, and a number such as 10: so many messages may wait.",
    ),
    Known(
        r"TypeError: Expected <class '[\w.]+\.(\w+)'>, got <class 'str'>",
        lambda found: f"publish() wants a message of the type {found[1]}, and got a text.",
        "Make one, message = {0}(), put the text into message.data, and publish the message.",
    ),
)


def hint_for(log: Sequence[str]) -> str:
    """What the mistake is that the log names; empty where it names none of these."""
    known = next(_known(log), None)
    return known[0].hint(known[1]) if known else ""


def mend_for(log: Sequence[str]) -> str:
    """What mends it; empty where it is not known, or said already."""
    known = next(_known(log), None)
    return known[0].mend.format(*known[1].groups()) if known else ""


def _is_of_the_program(line: str) -> bool:
    """A line of a traceback that names a file of code: Python came as far as that."""
    found = re.search(r'File "([^"]+\.py)", line', line)
    return found is not None and "importlib" not in found[1]


def _known(log: Sequence[str]) -> Iterator[tuple[Known, re.Match[str]]]:
    """The mistakes that there is something to say of, the last line's first."""
    entered = any(_is_of_the_program(line) for line in log)
    for line in reversed(log):
        for known in KNOWN:
            found = re.search(known.line, line)
            if found and not (known.at_the_door and entered) and known.hint(found):
                yield known, found


SYNTAX = {
    "inconsistent use of tabs and spaces": "This line begins with tabs, and the others with spaces"
    " (or the other way round). They look alike. Let your editor turn tabs into spaces.",
    "unexpected indent": "This line stands further to the right than the one above it, for no"
    " reason. Give both the same number of spaces.",
    "unindent does not match": "This line stands under no other one: count the spaces before it."
    " Each block has four more than the line that begins it.",
    "expected an indented block": "After a line that ends with a colon, the next one stands four"
    " spaces further to the right.",
    "was never closed": "Count the brackets of that line: one is opened and not closed.",
    "unterminated string": "A text begins with a quotation mark and needs the same one at its end.",
    "expected ':'": "A line with if, for, while, def, class, try or else ends with a colon.",
}
"""Part of Python's words to what to do."""


def syntax_hint(said: str) -> str:
    """What to do about an error of syntax; empty where Python's words are none of these."""
    return next((hint for words, hint in SYNTAX.items() if words in said), "")
