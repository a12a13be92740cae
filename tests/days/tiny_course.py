"""A course of two days, small and right; the tests of the rules spoil it in one place each."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from roslings_learn.lessons.document import read
from roslings_learn.lessons.path import Path as DayPath
from roslings_learn.lessons.rules import Lesson, read_lesson
from roslings_learn.lessons.rules.form import COMPARED

DAY = "01-lamp"
PATH = """days:
  - id: 01-lamp
    title: A lamp
    can: You blink a lamp.
    hours: 1
  - id: 02-motor
    title: A motor
    can: You turn a motor.
    hours: 1
"""
TODAY = ("lamp", "blink", "period", "bulb", "switch", "socket")
OTHER = "  - id: motor\n    name: motor\n    definition: It turns.\n    note: Yes.\n    day: 2\n"
NEVER = "  - id: laser\n    name: laser\n    definition: It shines.\n    note: Yes.\n"
GLOSSARY = (
    "category: Light\nabout: All of it.\nterms:\n"
    + "".join(
        f"  - {{id: {word}, name: {word}, definition: It is a {word}., note: Yes., day: 1}}\n"
        for word in TODAY
    )
    + OTHER
    + NEVER
)

DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 200" role="img">
<title>A lamp</title><desc>A lamp that shines on a desk.</desc>
<rect width="720" height="200" rx="12" fill="#fff"/>
<text x="20" y="40" font-size="18">lamp</text></svg>
"""
QUIZ = """questions:
  - id: lamp-what
    kind: one
    ask: What does a [lamp](#word-lamp) do?
    choices:
      - text: It shines.
        why: Yes, that is `its` work.
        right: true
      - text: It sings.
        why: No, a bell does that.
  - id: lamp-parts
    kind: several
    ask: What has a lamp?
    choices:
      - {text: A bulb, why: It makes the light., right: true}
      - {text: A switch, why: It turns the light on., right: true}
      - {text: Wheels, why: A car has them.}
  - id: lamp-order
    kind: order
    ask: Bring it in order.
    steps:
      - {text: Plug it in, why: It needs power first.}
      - {text: Switch it on, why: Now it has power.}
      - {text: Look, why: Now it shines.}
  - id: lamp-prints
    kind: prints
    ask: What does this print?
    code: print(1 + 1)
    prints: "2"
    why: One and one are two.
    mistakes: [{text: "11", why: These are numbers and not texts.}]
"""


@dataclass(frozen=True)
class Cell:
    """A cell to write."""

    id: str
    text: str
    code: bool = False
    tags: Sequence[str] = ()
    answer: Sequence[Sequence[str]] = ()
    more: dict[str, Any] = field(default_factory=dict)

    def raw(self) -> dict[str, Any]:
        """As the file has it."""
        metadata: dict[str, Any] = {"tags": list(self.tags)} if self.tags else {}
        if self.answer:
            metadata["roslings"] = {"answer": [list(each) for each in self.answer]}
        cell = {"id": self.id, "metadata": metadata, "source": self.text.splitlines(keepends=True)}
        cell["cell_type"] = "code" if self.code else "markdown"
        ran = {"execution_count": None, "outputs": []} if self.code else {}
        return {**cell, **ran, **self.more}


def compared(cell: Cell, count: int, output: dict[str, Any]) -> Cell:
    """The cell with an output that nbval compares."""
    ran = {"execution_count": count, "outputs": [output]}
    return replace(cell, tags=[*cell.tags, COMPARED], more=ran)


def printed(text: str) -> dict[str, Any]:
    """An output, as a notebook holds it."""
    return {"name": "stdout", "output_type": "stream", "text": text.splitlines(keepends=True)}


def raised(name: str, told: str) -> dict[str, Any]:
    """An error, as a lesson holds it."""
    return {"ename": name, "evalue": told, "output_type": "error", "traceback": []}


HEAD = """# Day 1: A lamp

- **Goal:** You make a light go on.
- **Level:** beginner
- **Time:** 1 hour
- **You need:** nothing

Run the cell below."""
LAB = """## The lab

Make the package (10 min). Terminal 1, in the roslings folder:

```bash
./roslings start lamp
```"""
CHANGE = "# Change: blink 10 times a second.\nperiod = 0.5\nassert period == 0.1, 'Still 2 Hz.'"
WORDS = "## Words of the day\n\n" + "\n".join(f"- [{w}](#word-{w}): It is a {w}." for w in TODAY)

CELLS = (
    Cell("head", HEAD),
    Cell("first", "from roslings_learn.notebook import quiz\n\nprint('on')", code=True),
    Cell("everyday", "## Like in everyday life\n\nIt is like a candle. A candle burns down."),
    Cell("words", WORDS),
    Cell(
        "blinking",
        "## Blinking\n\nA [lamp](#word-lamp) can [blink](#word-blink).\n\n"
        "![A lamp that shines on a desk](pictures/lamp.svg)",
    ),
    Cell("blink-predict", "Before you run: how often is it on?", tags=["predict"]),
    compared(
        Cell("blink-run", "on = [n % 2 for n in range(4)]\nprint(on)", code=True, tags=["run"]),
        2,
        printed("[0, 1, 0, 1]\n"),
    ),
    Cell("blink-explain", "It is on every second time.", tags=["explain"]),
    Cell(
        "blink-change",
        CHANGE,
        code=True,
        tags=["change", "raises-exception"],
        answer=[["period = 0.5", "period = 0.1"]],
    ),
    Cell("wrong", "## What goes wrong\n\nThe name is wrong."),
    compared(
        Cell("wrong-1", "print(lampp)", code=True, tags=["raises-exception"]),
        4,
        raised("NameError", "name 'lampp' is not defined"),
    ),
    Cell("wrong-1-mended", "lamp = 1\nprint(lamp)", code=True),
    Cell("wrong-2", "print(1 / 0)", code=True, tags=["raises-exception"]),
    compared(Cell("wrong-2-mended", "print(1 / 1)", code=True), 7, printed("1.0\n")),
    Cell("real", "## On a real robot\n\nA [motor](#word-motor) is stronger. The motor is loud."),
    Cell("lab", LAB),
    Cell("check", "## The check\n\nRun this cell."),
    Cell("check-run", "lab = 'lamp'\nprint(f'check({lab})')", code=True),
    Cell("reading", "## Further reading and watching\n\n- [Lamps](https://example.org/lamps)"),
    Cell("quiz", "## Quiz\n\nNow ask yourself."),
    Cell("quiz-run", 'quiz("01-lamp")', code=True),
)
METADATA = {
    "kernelspec": {"name": "roslings", "display_name": "ROS 2 (roslings)", "language": "python"},
    "language_info": {"name": "python"},
}


def with_cell(name: str, **changes: Any) -> tuple[Cell, ...]:
    """The lesson with one cell changed; `text` may be a pair (old, new)."""
    found = next(cell for cell in CELLS if cell.id == name)
    if isinstance(changes.get("text"), tuple):
        old, new = changes["text"]
        assert old in found.text, (name, old)
        changes["text"] = found.text.replace(old, new)
    changed = replace(found, **changes)
    return tuple(changed if cell is found else cell for cell in CELLS)


def without(name: str) -> tuple[Cell, ...]:
    """The lesson without one cell."""
    return tuple(cell for cell in CELLS if cell.id != name)


def write_course(
    root: Path, cells: Sequence[Cell] = CELLS, metadata: dict[str, Any] | None = None
) -> Path:
    """Write the course into `root`; returns the lesson's file."""
    folder = root / "days" / DAY
    (folder / "pictures").mkdir(parents=True)
    (root / "glossary").mkdir()
    (root / "days" / "path.yaml").write_text(PATH, "utf-8")
    (root / "glossary" / "light.yaml").write_text(GLOSSARY, "utf-8")
    (folder / "pictures" / "lamp.svg").write_text(DRAWING, "utf-8")
    (folder / "quiz.yaml").write_text(QUIZ, "utf-8")
    lesson = folder / "lesson.ipynb"
    lesson.write_text(notebook(cells, metadata or METADATA), "utf-8")
    return lesson


def notebook(cells: Sequence[Cell], metadata: dict[str, Any]) -> str:
    """The file of a notebook."""
    raw = [cell.raw() for cell in cells]
    content = {"cells": raw, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def read_tiny(path: Path) -> Lesson:
    """The lesson, read."""
    days = read(path.parents[1] / "path.yaml", DayPath).content.days
    return read_lesson(path, next(day for day in days if day.id == DAY))
