"""Packages on the way: the starter with its first TODOs done, as the solution does them.

A TODO that has a function, a file or a place in a file of its own is found by its number. Where
several stand in one function, `DONE_BY` says which of the solution's statements belong to which.
"""

from __future__ import annotations

import ast
import copy
import difflib
import re
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from roslings.course import Lab

TODO = re.compile(r"TODO (\d+)")
Function = ast.FunctionDef | ast.AsyncFunctionDef
Words = Mapping[int, tuple[str, ...]]
"""TODO to what its statements begin with, or hold in their first line."""

MOST_AMBIGUOUS = 5
INSIDE = "inside: "
"""Before the beginning of a statement that stands in another one."""

UNTIL = {"nodes": (11, "self.get_parameter('period').value", "1.0")}
"""What a student writes until a TODO tells of something better."""

MADE: Words = {4: ("super().__init__",), 5: ("create_publisher",)}
DONE_BY: dict[str, dict[str, Words]] = {
    "nodes": {
        "minimal_publisher:MinimalPublisher.__init__": {
            **MADE,
            6: ("create_timer",),
            7: ("self.count",),
            11: ("declare_parameter",),
        },
        "minimal_publisher:MinimalPublisher.tell_status": {
            9: ("self.get_logger",),
            8: ("status", "self.publisher"),
            10: ("self.count",),
        },
    },
    "topics": {
        "talker:Talker.__init__": {**MADE, 6: ("create_timer",), 7: ("self.count",)},
        "talker:Talker.say_hello": {
            9: ("self.get_logger",),
            8: ("message", "self.publisher"),
            10: ("self.count",),
        },
        "listener:Listener": {12: ("class",)},
        "listener:Listener.__init__": {13: ("",)},
    },
    "distance-sensor": {
        "distance_sensor:DistanceSensor.__init__": {
            4: ("super().__init__",),
            5: ("create_subscription",),
            6: ("create_publisher", "create_timer"),
        },
        "distance_sensor:DistanceSensor.tell_distance": {
            9: ("reading.range", "if self.distance", "self.publisher"),
            8: ("reading",),
        },
        "distance_subscriber:DistanceSubscriber": {11: ("class",)},
        "distance_subscriber:DistanceSubscriber.__init__": {12: ("",)},
        "distance_subscriber:DistanceSubscriber.hear_distance": {
            13: ("if reading",),
            14: ("if math",),
            15: ("self.publisher",),
        },
    },
    "services": {
        "motor_controller:MotorController.__init__": {
            4: ("super().__init__",),
            5: ("create_publisher", "create_timer"),
            7: ("SetBool",),
            9: ("Trigger",),
        },
        "motor_client:MotorClient.__init__": {12: ("super().__init__",), 13: ("create_client",)},
        "motor_client:MotorClient.limit_speed": {
            14: ("if not",),
            15: ("request", "future", "rclpy"),
            16: ("self.get_logger", "return"),
        },
    },
    "actions": {
        "drive_server:WEST": {7: ("WEST",)},
        "drive_server:DriveServer.__init__": {4: ("super().__init__",), 5: ("self.server",)},
        "drive_server:DriveServer.judge_goal": {8: ("if self.busy",), 6: ("",)},
        "drive_server:DriveServer.drive": {11: (INSIDE + "if goal_handle.is_cancel",), 9: ("",)},
        "drive_client:DriveClient.__init__": {13: ("super().__init__",), 14: ("",)},
        "drive_client:DriveClient.send_rover": {
            15: ("if not self.client",),
            16: ("goal_handle =", "if not goal_handle"),
            17: ("",),
        },
    },
    "serial-bridge": {
        "serial_bridge:SerialBridge.__init__": {
            9: ("super().__init__",),
            10: ("declare_parameter",),
            11: ("create_", "self.connect"),
            12: ("self.",),
        },
        "serial_bridge:SerialBridge.odometry": {14: ("",)},
        "serial_bridge:SerialBridge.disconnect": {12: ("",)},
        "serial_bridge:SerialBridge.motion_of_now": {15: ("",)},
    },
    "e-stop": {
        "e_stop_button:LATC": {4: ("",)},
        "guard:BUTT": {9: ("",)},
        "guard:COMM": {9: ("",)},
        "guard:MOTO": {9: ("",)},
        "guard:Guard.__init__": {
            10: (
                "super().__init__",
                "self.pressed",
                "self.lost",
                "self.silent",
                "self.command",
                "self.reason",
            ),
            11: ("self.publisher", "self.create_"),
        },
    },
    "pi-camera": {
        "camera:Camera.__init__": {
            4: ("super().__init__",),
            5: ("declare_parameter", "whole", "limits"),
            6: ("create_", "self.connect"),
        },
        "ball_finder:picture_of": {
            11: ("channels", "if channels", "needed", "if not image", "if len"),
            12: ("rows", "picture"),
            13: ("conversion", "return"),
        },
        "ball_finder:find_ball": {
            14: ("calm", "hue", "away", "bright", "mask = ((away"),
            15: ("",),
        },
        "ball_finder:BallFinder.look": {
            18: (INSIDE + "cv2.circle", "self.image_publisher"),
            17: ("",),
        },
        "ball_finder:BallFinder.message": {18: ("",)},
        "ball_finder:main": {19: ("",)},
    },
    "bring-up": {
        "speed_limiter:SpeedLimiter.__init__": {
            4: ("super().__init__", "declare_parameter"),
            6: ("add_on_set",),
        },
        "speed_limiter:SpeedLimiter.limit": {5: ("",)},
        "beacon:Beacon.__init__": {
            9: (
                "super().__init__",
                "declare_parameter",
                "fixed",
                "whole",
                "limits",
                "create_publisher",
            ),
            11: ("add_post_set",),
        },
        "beacon:Beacon.tell": {10: ("",)},
    },
    "black-box": {},
    "wander": {
        "wander:WALL": {5: ("",)},
        "wander:STOP": {6: ("",)},
        "wander:TIGH": {6: ("",)},
        "wander:FAST": {5: ("",)},
        "wander:LOST": {5: ("",)},
        "wander:LOOK": {9: ("",)},
        "wander:WAIT": {9: ("",)},
        "wander:HAS_": {9: ("",)},
        "wander:Wander.look": {8: ("",)},
        "wander:Wander.decide": {9: ("",)},
    },
    "frames": {
        "frames:CELL": {11: ("",)},
        "frames:WEST": {11: ("",)},
        "frames:MOST": {8: ("",)},
        "frames:LATC": {11: ("",)},
        "frames:Frames.__init__": {12: ("self.cells", "self.map", "self.create_timer"), 4: ("",)},
        "frames:Frames.hear": {10: ("self.waiting",), 6: ("",)},
        "frames:Frames.place": {13: (INSIDE + "self.draw",), 9: ("",)},
    },
}


@dataclass(frozen=True)
class HalfDone:
    """One state of a lab's package: the TODOs up to a number are done."""

    lab: Lab
    done: int

    @property
    def name(self) -> str:
        """For a list of all of them."""
        return f"{self.lab.name}-{self.done}"

    def make(self, package: Path) -> Path:
        """Write it to `package`, which is given back."""
        shutil.copytree(self.lab.starter, package)
        for file in sorted(self.lab.solution.rglob("*")):
            name = file.relative_to(self.lab.solution)
            if file.is_file() and (package / name).is_file():
                (package / name).write_text(self._filled(name), "utf-8")
        return package

    def _filled(self, name: Path) -> str:
        """One file, as far as its TODOs are done."""
        begun, whole = ((folder / name).read_text("utf-8") for folder in self._sides())
        todo, better, plain = UNTIL.get(self.lab.name, (0, "", ""))
        if self.done < todo:
            whole = whole.replace(better, plain)
        if not (todos := numbers(begun)) or max(todos) <= self.done:
            return whole if todos else begun
        if min(todos) > self.done:
            return begun
        if name.parent.name == self.lab.card.package and name.suffix == ".py":
            return Module(begun, whole, self.done, self._words(name.stem)).text()
        return by_hunks(begun, whole, self.done)

    def _sides(self) -> tuple[Path, Path]:
        return self.lab.starter, self.lab.solution

    def _words(self, stem: str) -> dict[str, Words]:
        begin = f"{stem}:"
        all_words = DONE_BY[self.lab.name].items()
        return {key.removeprefix(begin): words for key, words in all_words if key.startswith(begin)}


def states(lab: Lab) -> list[HalfDone]:
    """After each TODO but the last, which may be a finished package.

    A tool that only the starter has is no part of what is graded.
    """
    names = (file.relative_to(lab.solution) for file in lab.solution.rglob("*"))
    begun = (lab.starter / name for name in names)
    texts = [file.read_text("utf-8") for file in begun if file.is_file()]
    return [HalfDone(lab, n) for n in sorted({n for text in texts for n in numbers(text)})[:-1]]


def numbers(text: str) -> list[int]:
    """The TODOs that stand in a text."""
    return [int(number) for number in TODO.findall(text)]


def by_hunks(begun: str, whole: str, done: int) -> str:
    """The text with each place mended whose TODO is done; a place without one comes first."""
    before, after = begun.splitlines(keepends=True), whole.splitlines(keepends=True)
    lines: list[str] = []
    for kind, a, b, c, d in difflib.SequenceMatcher(None, before, after, False).get_opcodes():
        todos = numbers("".join(before[a:b]))
        lines += before[a:b] if kind == "equal" or max(todos, default=0) > done else after[c:d]
    return "".join(lines)


@dataclass
class Module:
    """One module, with the statements of the solution whose TODOs are done."""

    begun: str
    whole: str
    done: int
    words: Mapping[str, Words]
    _begun_functions: dict[str, Function] = field(init=False)

    def __post_init__(self) -> None:
        """Reads both."""
        self._begun_tree, self._tree = ast.parse(self.begun), ast.parse(self.whole)
        self._begun_functions = dict(functions(self._begun_tree))

    def text(self) -> str:
        """Its code, without comments."""
        body: list[ast.stmt] = []
        for node in self._tree.body:
            if not isinstance(node, ast.Import | ast.ImportFrom):
                body += self._kept("", node)
        tree = ast.Module([*self._imports(), *body], [])
        text = ast.unparse(ast.fix_missing_locations(tree)) + "\n"
        compile(text, "half_done", "exec")
        return text

    def _imports(self) -> list[ast.stmt]:
        """Those of the solution, where the TODO that stands among them is done."""
        head = self.begun.partition("\nclass ")[0].partition("\ndef ")[0]
        done = min(numbers(head), default=0) <= self.done
        tree = self._tree if done else self._begun_tree
        return [node for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)]

    def _kept(self, inside: str, node: ast.stmt) -> list[ast.stmt]:
        """What is there of one statement of a module or a class."""
        if isinstance(node, ast.ClassDef):
            return [self._class(node)]
        if isinstance(node, Function):
            return self._function(inside + node.name, node)
        words = self.words.get(ast.unparse(node)[:4], {})
        return [node] if max(words, default=0) <= self.done else []

    def _class(self, node: ast.ClassDef) -> ast.stmt:
        made = copy.copy(node)
        if max(self.words.get(node.name, {}), default=0) > self.done:
            made.bases = []
        made.body = [kept for each in node.body for kept in self._kept(f"{node.name}.", each)]
        return made

    def _function(self, name: str, node: Function) -> list[ast.stmt]:
        """The function with the statements that are done; as in the starter where none is."""
        begun = self._begun_functions.get(name)
        todos = self._todos_of(begun)
        words = self.words.get(name) or {max(todos, default=0): ("",)}
        made = copy.deepcopy(node)
        made.body = list(self._statements(node.body[bool(ast.get_docstring(node)) :], words))
        if not made.body:
            return [begun] if begun else []
        if len(list(ast.walk(made))) != len(list(ast.walk(node))) - self._docstring_nodes(node):
            made.body = self._completed(made.body, begun)
        return [made]

    def _docstring_nodes(self, node: Function) -> int:
        return 2 if ast.get_docstring(node) else 0

    def _statements(
        self, body: Sequence[ast.stmt], words: Words, where: str = ""
    ) -> Iterator[ast.stmt]:
        for statement in body:
            if todo_of(statement, words, where) <= self.done:
                made = copy.deepcopy(statement)
                for part in ("body", "orelse"):
                    if inner := getattr(statement, part, None):
                        kept = list(self._statements(inner, words, INSIDE))
                        setattr(made, part, kept or ([ast.Pass()] if part == "body" else []))
                yield made

    def _completed(self, body: list[ast.stmt], begun: Function | None) -> list[ast.stmt]:
        """With the starter's own name of a node, and with what its function gives back."""
        there = "".join(map(ast.unparse, body))
        given = begun.body if begun else []
        names = [
            each for each in given if "super()" in ast.unparse(each) and "super()" not in there
        ]
        last = [each for each in given[-1:] if isinstance(each, ast.Return)]
        return [*names, *body, *last]

    def _todos_of(self, begun: Function | None) -> list[int]:
        """The TODOs in the starter's function: what stands below it and is indented more."""
        if begun is None:
            return []
        lines = self.begun.splitlines()[begun.lineno :]
        inside = " " * (begun.col_offset + 1)
        end = next((n for n, x in enumerate(lines) if x and not x.startswith(inside)), len(lines))
        return numbers("\n".join(lines[:end]))


def functions(tree: ast.Module) -> Iterator[tuple[str, Function]]:
    """Every function, with the name of its class."""
    for node in tree.body:
        if isinstance(node, Function):
            yield node.name, node
        if isinstance(node, ast.ClassDef):
            yield from ((f"{node.name}.{f.name}", f) for f in node.body if is_function(f))  # type: ignore[misc]


def is_function(node: ast.stmt) -> bool:
    """It defines one."""
    return isinstance(node, Function)


def todo_of(statement: ast.stmt, words: Words, where: str = "") -> int:
    """The TODO that a statement belongs to; 0: none of those that are named."""
    first = where + ast.unparse(statement).partition("\n")[0]
    for todo, beginnings in words.items():
        if any(is_meant(word, first, where) for word in beginnings):
            return todo
    return 0


def is_meant(word: str, first: str, where: str) -> bool:
    """The line begins with the word; a longer word may also stand in it."""
    if where:
        return word.startswith(INSIDE) and first.startswith(word)
    return first.startswith(word) or (len(word) > MOST_AMBIGUOUS and word in first)
