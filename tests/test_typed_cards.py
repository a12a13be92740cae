"""A misspelt word of a card is an error of mypy, wherever in a grader it stands.

Between card and grader nothing is `Any`. So in a copy of each task sheet, each word that a constant
of it says is said once more with a letter too many, and mypy must tell of every one.
"""

from __future__ import annotations

import ast
import io
import re
import subprocess
import sys
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from roslings.course import Lab, all_labs, root
from sources import code_of

pytestmark = pytest.mark.xdist_group("mypy")

LABS = all_labs()
ENGINE = code_of("roslings")
NUMBERS = {"NDArray", "np.floating"}
MORE = "x"
"""What is behind a misspelt word."""
SAID = re.compile(r"(?P<file>[^:]+):(?P<line>\d+): error: (?P<words>.*)")
UNKNOWN = re.compile(r'has no attribute "(?P<word>\w+)"')
WORDS = {
    "the engine's own, of a node": {"publishes", "subscribes", "constant", "executable"},
    "the engine's own, of the package": {"node", "package", "pictures", "ends_within_s"},
    "a capability's, of a node": {"serves", "calls", "performs", "named", "offers"},
    "a capability's, of the package": {"launch"},
    "a lab's own, of a node": {"stops"},
    "a lab's own, of the package": {"hosts", "reads_bags", "diagnosis"},
    "further inside": {"topic", "state", "tried", "deadline_s", "arguments", "within_s"},
}
"""What graders say today, by whose words these are."""


@dataclass(frozen=True)
class Misspelt:
    """A task sheet's text, and below it each of its words with a letter too many."""

    text: str
    words: tuple[str, ...]

    @property
    def first_line(self) -> int:
        """Of the misspelt ones."""
        return self.text.count("\n") + 1

    @property
    def whole(self) -> str:
        """All of the file."""
        return self.text + "".join(f"{word}{MORE}\n" for word in self.words)

    @property
    def expected(self) -> list[tuple[int, str]]:
        """Line and misspelt word of each error."""
        lasts = (f"{word.rpartition('.')[2]}{MORE}" for word in self.words)
        return [*enumerate(lasts, self.first_line)]


def misspelt(file: Path) -> Misspelt:
    """All that a task sheet says of its constants; what stands in a title is read by no checker."""
    text = file.read_text("utf-8")
    tree = ast.parse(text)
    said = {ast.unparse(each): None for each in ast.walk(tree) if _is_of_a_constant(each, tree)}
    return Misspelt(text, tuple(said))


def _is_of_a_constant(node: ast.AST, tree: ast.Module) -> bool:
    """An attribute, and all of it can be said at the end of the file."""
    if not isinstance(node, ast.Attribute):
        return False
    names = {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}
    first: ast.AST = node
    while isinstance(first, ast.Attribute | ast.Subscript | ast.Call):
        first = first.func if isinstance(first, ast.Call) else first.value
    constants, taken = _constants(tree), _taken(tree)
    return isinstance(first, ast.Name) and first.id in constants and names <= constants | taken


def _constants(tree: ast.Module) -> set[str]:
    return {
        each.id
        for statement in tree.body
        if isinstance(statement, ast.Assign | ast.AnnAssign)
        for each in ast.walk(statement)
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Store) and each.id.isupper()
    }


def _taken(tree: ast.Module) -> set[str]:
    imports = (each for each in tree.body if isinstance(each, ast.Import | ast.ImportFrom))
    return {name.asname or name.name for each in imports for name in each.names}


def told_by_mypy(*files: Path) -> list[tuple[str, int, str]]:
    """File's name, line and words of each error; the course's own settings and cache."""
    done = subprocess.run(
        [sys.executable, "-m", "mypy", *map(str, files)],
        cwd=root(),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode in (0, 1), done.stdout + done.stderr
    found = filter(None, map(SAID.fullmatch, done.stdout.splitlines()))
    return [(Path(each["file"]).name, int(each["line"]), each["words"]) for each in found]


@pytest.fixture(scope="module")
def told(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[str, int, str]]:
    """Of a copy of each task sheet; mypy reads all at once."""
    folder = tmp_path_factory.mktemp("misspelt")
    copies = [folder / lab.grader.name for lab in LABS]
    for lab, copy in zip(LABS, copies, strict=True):
        copy.write_text(misspelt(lab.grader).whole, "utf-8")
    return told_by_mypy(*copies)


@pytest.mark.parametrize("lab", LABS, ids=lambda lab: lab.name)
def test_each_misspelt_word_is_told(lab: Lab, told: list[tuple[str, int, str]]) -> None:
    """By its name and its line, and of the grader as it is nothing is told."""
    found = {
        (line, unknown["word"] if (unknown := UNKNOWN.search(words)) else words)
        for file, line, words in told
        if file == lab.grader.name
    }
    assert found == set(misspelt(lab.grader).expected)


@pytest.mark.parametrize("whose", WORDS)
def test_words_of_each_kind_were_misspelt(whose: str) -> None:
    """The test above has looked at them."""
    said = {word.rpartition(".")[2] for lab in LABS for word in misspelt(lab.grader).words}
    assert said >= WORDS[whose]


def test_words_are_asked_of_what_has_them(tmp_path: Path) -> None:
    """Those of a node have no place in what is said of the package; and so the other way round."""
    (lab,) = (each for each in LABS if each.name == "e-stop")
    text = lab.grader.read_text("utf-8")
    copy = tmp_path / "asked.py"
    copy.write_text(f"{text}CARD.of(GuardWords)\nGUARD.of(HostsWords)\n", "utf-8")
    end = text.count("\n")
    (_, first, of_the_card), (_, second, of_a_node) = told_by_mypy(copy)
    assert (first, second) == (end + 1, end + 2)
    assert '"GuardWords"' in of_the_card and '"HostsWords"' in of_a_node


# --- nothing stands between --------------------------------------------------------------------


NOT_CHECKED = re.compile(r"#\s*(type:\s*ignore|mypy:)")
OF_A_FAULT = re.compile(r"def \w+\(self\) -> str:  # type: ignore\[override\]")
"""A sentence of a fault that a property makes, where others are templates: `judge/faults/base.py`
tells why. No word of a card goes through it."""
ROS = ("rclpy", "_msgs", "_interfaces", "_srvs")
"""Parts of the names of packages whose objects have no types."""
CARDS = [
    ENGINE / "course/card.py",
    ENGINE / "course/contract.py",
    ENGINE / "course/labs.py",
    *sorted(ENGINE.glob("capabilities/*/contract.py")),
]
"""What a card is read with."""
GRADERS = sorted((root() / "graders").rglob("*.py"))


def untyped(text: str) -> Iterator[str]:
    """What keeps a type from whoever reads a value: `Any`, a cast, and what the checker leaves out.

    Any is allowed to a module that imports ROS: messages and endpoints have no types there.
    """
    tree = ast.parse(text)
    of_numbers = {id(node) for node in _of_numbers(tree)}
    names = {
        each.id
        for each in ast.walk(tree)
        if isinstance(each, ast.Name) and id(each) not in of_numbers
    }
    names |= {each.attr for each in ast.walk(tree) if isinstance(each, ast.Attribute)}
    yield from names & ({"cast"} if _imports_ros(tree) else {"cast", "Any"})
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and NOT_CHECKED.match(token.string):
            yield from () if OF_A_FAULT.search(token.line) else (token.line.strip(),)


def _of_numbers(tree: ast.Module) -> Iterator[ast.AST]:
    """What is said of numpy's numbers: `floating[Any]` leaves their precision open, and no word."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Subscript) and ast.unparse(node.value) in NUMBERS:
            yield from ast.walk(node.slice)


def _imports_ros(tree: ast.Module) -> bool:
    taken = (
        each.module if isinstance(each, ast.ImportFrom) else each.names[0].name
        for each in ast.walk(tree)
        if isinstance(each, ast.Import | ast.ImportFrom)
    )
    firsts = {(name or "").partition(".")[0] for name in taken}
    return any(first.endswith(ROS) for first in firsts)


@pytest.mark.parametrize("file", [*CARDS, *GRADERS], ids=lambda file: "/".join(file.parts[-2:]))
def test_nothing_stands_between_card_and_grader(file: Path) -> None:
    """Of a task sheet no ROS is needed, so there Any has no place at all."""
    text = file.read_text("utf-8")
    assert [*untyped(text)] == []
    if file.name.startswith("grade_"):
        assert not _imports_ros(ast.parse(text))


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("def f(command: dict[str, Any]) -> None: ...", ["Any"]),
        ("def f(points: NDArray[np.floating[Any]]) -> None: ...", []),
        ("def f(points: NDArray[np.int64], card: Any) -> None: ...", ["Any"]),
        ("LAUNCH: typing.Any = CARD.launch", ["Any"]),
        ("LAUNCH = cast(LaunchContract, CARD.launch)", ["cast"]),
        ("LAUNCH = typing.cast('LaunchContract', CARD.launch)", ["cast"]),
        ("LAUNCH = CARD.launch  # type: ignore", ["LAUNCH = CARD.launch  # type: ignore"]),
        ("# mypy: ignore-errors", ["# mypy: ignore-errors"]),
        ("from sensor_msgs.msg import Image\ndef f(image: Any) -> Any: ...", []),
        ("    def measured(self) -> str:  # type: ignore[override]\n        ...", []),
        ("SAID = 'Any type: ignore'", []),
    ],
)
def test_what_would_stand_between_is_found(text: str, found: list[str]) -> None:
    """What the test above looks for."""
    code = f"class F:\n{text}" if text.startswith(" ") else text
    assert [*untyped(code)] == found
