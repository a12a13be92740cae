"""What Python and rclpy really say of a beginner's mistakes, and what we say of it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from ros2_on_pip.near_names import nearest
from roslings.judge.faults import WrongNodeName
from roslings.judge.faults.files import SyntaxErrorInCode
from roslings.judge.faults.python_words import hint_for, mend_for
from roslings.workspace import code

LAUNCHER = """\
import sys
from importlib.metadata import EntryPoint
sys.exit(EntryPoint("talker", {target!r}, "console_scripts").load()())
"""
"""As setuptools writes it for an executable: no file of Python's name."""

NODE = """\
import sys
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
rclpy.init(args=sys.argv)
node = Node("node")
tell = lambda *_: None
{code}
for _ in range(20):
    rclpy.spin_once(node, timeout_sec=0.1)
"""


def said_by(file: Path, *words: str) -> list[str]:
    """What a program writes before it ends with an error."""
    environment = {
        **os.environ,
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "PYTHONPATH": str(file.parent),
    }
    ran = subprocess.run(
        [sys.executable, str(file), *words],
        capture_output=True,
        text=True,
        check=False,
        env={**environment, "ROS_LOG_DIR": str(file.parent)},
    )
    assert ran.returncode != 0
    return ran.stderr.splitlines()


@pytest.mark.parametrize(
    ("target", "hint"),
    [
        ("chat.talker", "names a file and no function"),
        ("chat.talkr:main", "is in talkr.py, and there is no such file"),
        ("chat.talker:mian", "asks for the function mian of talker.py"),
        ("chat.broken:main", ""),
        ("chat.other:main", "There is no package std_msg. Did you mean std_msgs?"),
    ],
)
def test_an_entry_point(tmp_path: Path, target: str, hint: str) -> None:
    """setup.py is named where it is wrong, and where the code is wrong it is not."""
    package, launcher = tmp_path / "chat", tmp_path / "talker"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "talker.py").write_text("def main():\n    pass\n", "utf-8")
    (package / "broken.py").write_text("import chat.nothing\n", "utf-8")
    (package / "other.py").write_text("from std_msg.msg import String\n", "utf-8")
    launcher.write_text(LAUNCHER.format(target=target), "utf-8")
    found = hint_for(said_by(launcher))
    assert hint in found
    assert bool(hint) == bool(found)


@pytest.mark.parametrize(
    ("words", "hint", "mend"),
    [
        ("node.create_timer(0.1, tell())", "want a function", "the function itself: self.tell"),
        ("node.create_subscription(String, 'x', tell(), 10)", "want a function", "self.tell"),
        ("node.declare_parameter('period_s', 1)", "a whole number", "with a point: 1.0"),
        ("node.create_publisher(String, 'x')", "wants three things", "a number such as 10"),
        ("node.create_publisher(String, 'x', 10).publish('hi')", "got a text", "= String()"),
        ("node.create_timer(0.1, lambda: 1 / 0)", "", ""),
    ],
)
def test_a_call_of_rclpy(tmp_path: Path, words: str, hint: str, mend: str) -> None:
    """The mistake is named; how the call is written comes with the last hint."""
    file = tmp_path / "node.py"
    file.write_text(NODE.format(code=words), "utf-8")
    log = said_by(file, "--ros-args", "-p", "period_s:=2.0")
    found = hint_for(log)
    assert hint in found and mend in mend_for(log)
    assert bool(hint) == bool(found) == bool(mend_for(log))
    assert not mend or mend not in found


@pytest.mark.parametrize(
    ("line", "named"),
    [
        ("self.timer = self.create_timer(0.5, self.tell())  # seconds", True),
        ("self.create_subscription(String, 'x', self.hear(), 10)", True),
        ("self.timer = self.create_timer(self.period(), self.tell)", False),
        ("self.create_subscription(String, self.name(), self.hear, 10)", False),
    ],
)
def test_a_callback_that_was_called_and_failed(line: str, named: bool) -> None:
    """The program ends inside of it, with any error; the line above tells why it ran at all."""
    log = [
        'File ".../talker.py", line 15, in __init__',
        f"  {line}",
        'File ".../talker.py", line 21, in tell',
        "  message.data = self.count",
        "AttributeError: 'Talker' object has no attribute 'count'",
    ]
    assert ("want a function" in hint_for(log)) == named
    assert ("the function itself: self.tell" in mend_for(log)) == named


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("if 1:\n        x = 1\n\ty = 2\n", "turn tabs into spaces"),
        ("x = 1\n    y = 2\n", "further to the right"),
        ("if 1:\n        x = 1\n    y = 2\n", "count the spaces"),
        ("def f():\nx = 1\n", "four spaces further to the right"),
        ("x = (1\n", "one is opened and not closed"),
        ("x = 'a\n", "needs the same one at its end"),
        ("def f()\n    pass\n", "ends with a colon"),
        ("x = = 1\n", "a missing colon, bracket or quotation mark?"),
    ],
)
def test_what_python_cannot_read(tmp_path: Path, text: str, hint: str) -> None:
    """Tabs and spaces look alike; a colon is not what is missing everywhere."""
    file = tmp_path / "it.py"
    file.write_text(text, "utf-8")
    with pytest.raises(code.NotPython) as found:
        code.parse(file)
    assert hint in SyntaxErrorInCode(f"it.py:{found.value}").hint


@pytest.mark.parametrize(
    ("name", "slip"),
    [
        ("/alve", "'i' is missing"),
        ("/aliive", "'i' is too much"),
        ("/alove", "'o' stands where 'i' is wanted"),
        ("/laive", ""),
    ],
)
def test_one_letter_is_named(name: str, slip: str) -> None:
    """/alve and /alive look alike."""
    near = nearest("/alive", [name])
    assert near is not None
    said = f"there is no /alive, but {name} is running: a spelling mistake?"
    assert WrongNodeName(near).measured == f"{said} {slip}".rstrip()
