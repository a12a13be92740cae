"""The rules of lessons: a right lesson breaks none, and each wrong one is told where and how."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
from tiny_course import (
    CELLS,
    CHANGE,
    METADATA,
    Cell,
    printed,
    with_cell,
    without,
    write_course,
)

from roslings_learn.lessons.rules.__main__ import main
from roslings_learn.lessons.rules.prose import blocks_of, sentences, slug, words

LONG = "The small lamp on my desk shines each evening when I come home from school and my "
WRONG: dict[str, tuple[Sequence[Cell], str, str]] = {
    # name: (cells, where, what)
    "outputs": (with_cell("first", more={"outputs": [{}]}), "cell first, line 1", "holds outputs"),
    "count": (with_cell("first", more={"execution_count": 3}), "cell first", "execution count"),
    "compared without outputs": (with_cell("blink-run", more={}), "cell blink-run", "no outputs"),
    "compared without a count": (
        with_cell("blink-run", more={"outputs": [printed("on\n")]}),
        "blink-run",
        "no execution",
    ),
    "compared picture": (
        with_cell(
            "blink-run",
            more={"execution_count": 2, "outputs": [{"output_type": "display_data", "data": {}}]},
        ),
        "cell blink-run",
        "no text, but display_data",
    ),
    "few compared": (with_cell("blink-run", tags=["run"], more={}), "", "of 2 cells are compared"),
    "path in an output": (
        with_cell("blink-run", more={"execution_count": 2, "outputs": [printed("/home/anna/x\n")]}),
        "cell blink-run",
        "/home/anna",
    ),
    "random id": (with_cell("first", id="0a1b2c3d"), "cell 0a1b2c3d", "no readable id"),
    "twin ids": (with_cell("first", id="head"), "cell head", "Another cell has this id"),
    "tag": (with_cell("first", tags=["hide"]), "cell first", "'hide' is no tag"),
    "metadata": (
        with_cell("first", more={"metadata": {"trusted": 1}}),
        "cell first",
        "hold trusted",
    ),
    "path": (
        with_cell("first", text="x = 1\nopen('/home/anna/x')"),
        "cell first, line 2",
        "/home/anna",
    ),
    "title": (with_cell("head", text=("A lamp", "The lamp")), "", "does not begin with"),
    "second h1": (with_cell("lab", text=("## The lab", "# The lab")), "cell lab", "second H1"),
    "no goal": (with_cell("head", text=("Goal", "Aim")), "", "no 'Goal'"),
    "no section": (without("real"), "", "'On a real robot' is missing"),
    "too long": (with_cell("check", text="## The check\n\n" + "Run. " * 3000), "", "words"),
    "long aside": (
        with_cell("real", text="## On a real robot\n\n" + "A [motor](#word-motor) runs. " * 40),
        "",
        "'On a real robot' has 125 words",
    ),
    "order": ((*CELLS[:2], CELLS[3], CELLS[2], *CELLS[4:]), "", "not in order"),
    "concept too late": (
        (*CELLS[:4], *CELLS[9:14], *CELLS[4:9], *CELLS[14:]),
        "",
        "no section of its place",
    ),
    "far first code": (with_cell("head", text=("Run", "So. " * 400 + "Run")), "", "signs stand"),
    "twin headings": (
        with_cell("real", text=("A [motor]", "### Blinking\n\nA [motor]")),
        "",
        "there twice",
    ),
    "few words": (with_cell("words", text=("- [socket]", "[socket]")), "", "has 5 words"),
    "word without link": (
        with_cell("words", text=("[bulb](#word-bulb)", "bulb")),
        "cell words, line 6",
        "No word",
    ),
    "one mistake": (without("wrong-2"), "", "has 3 code cells"),
    "no times": (with_cell("lab", text=(" (10 min)", "")), "", "tell no times"),
    "no check": (with_cell("check-run", text="print(lamp)"), "", "checks nothing"),
    "no links": (
        with_cell("reading", text="## Further reading and watching\n\nSee."),
        "",
        "no link",
    ),
    "no quiz": (without("quiz-run"), "", "not the quiz"),
    "embedded": (with_cell("reading", text=("- [", "<iframe>\n- [")), "cell reading", "embedded"),
    "no picture": (
        with_cell("blinking", text="## Blinking\n\nA [lamp](#word-lamp)."),
        "cell blinking",
        "no picture",
    ),
    "no predict": (without("blink-predict"), "cell blinking", "goes: run, explain, change"),
    "predict is code": (
        with_cell("blink-predict", code=True, text="x"),
        "predict, line 1",
        "for Mark",
    ),
    "change passes": (with_cell("blink-change", tags=["change"]), "blink-change", "ends well"),
    "change is mute": (
        with_cell("blink-change", text=("# Change: ", "# ")),
        "change, line 1",
        "not say",
    ),
    "no assert": (
        with_cell("blink-change", text=CHANGE.partition("assert")[0]),
        "blink-change",
        "an assert",
    ),
    "mute assert": (
        with_cell("blink-change", text=(", 'Still 2 Hz.'", "")),
        "blink-change, line 3",
        "nothing",
    ),
    "no answer": (with_cell("blink-change", answer=[]), "blink-change", "edit is not known"),
    "answer twice": (
        with_cell("blink-change", answer=[["period", "x"]]),
        "blink-change",
        "2 times",
    ),
    "answer is no python": (
        with_cell("blink-change", answer=[["period = 0.5", "period = "]]),
        "blink-change",
        "Python",
    ),
    "long cell": (with_cell("wrong-1-mended", text="x = 1\n" * 16), "mended, line 16", "16 lines"),
    "long first cell": (with_cell("first", text="x = 1\n" * 9), "first, line 9", "9 lines"),
    "wide cell": (with_cell("first", text="x = 1\n" + "y" * 89), "first, line 2", "89 columns"),
    "empty cell": (with_cell("first", text=" "), "cell first", "is empty"),
    "sleeps": (
        with_cell("first", text="import time\ntime.sleep(2)"),
        "first, line 2",
        "sleeps",
    ),
    "commands anywhere": (
        with_cell("lab", text=("Terminal 1, in the roslings folder:", "Then:")),
        "lab, line 5",
        "in which terminal",
    ),
    "long sentence": (
        with_cell("everyday", text=("It is like", LONG + LONG + "it is like")),
        "everyday, line 3",
        "A sentence has",
    ),
    "long on average": (
        with_cell("everyday", text=("It is like", (LONG + "cat sleeps. ") * 99 + "It is like")),
        "",
        "Its sentences have",
    ),
    "much prose": (
        with_cell("everyday", text=("It is", "It burns. " * 61 + "It is")),
        "everyday",
        "of prose",
    ),
    "unknown word": (with_cell("real", text=("word-motor", "word-mottor")), "real", "'mottor'"),
    "word in heading": (
        with_cell("blinking", text=("## Blinking", "## [Blink](#word-blink)")),
        "blinking, line 1",
        "A heading holds",
    ),
    "word too early": (
        with_cell("everyday", text=("a candle. A", "a motor. A")),
        "everyday, line 3",
        "day 2",
    ),
    "word of no day": (
        with_cell("everyday", text=("a candle. A", "a laser. A")),
        "everyday",
        "a word of no day",
    ),
    "later word not linked": (
        with_cell("real", text=("[motor](#word-motor)", "motor")),
        "cell real",
        "a word of day 2",
    ),
    "new word not linked": (
        with_cell("everyday", text=("a candle. A", "a lamp. A")),
        "everyday, line 3",
        "not linked where it first stands",
    ),
    "four new words": (
        with_cell(
            "blink-explain",
            text=("It is on", "A [bulb](#word-bulb) has a [switch](#word-switch). It is on"),
        ),
        "blink-explain, line 1",
        "has 4 new words",
    ),
    "picture without words": (
        with_cell("blinking", text=("A lamp that shines on a desk", "lamp")),
        "blinking, line 5",
        "no text alternative",
    ),
    "picture that is not there": (
        with_cell("blinking", text=("lamp.svg", "lump.svg")),
        "blinking",
        "no picture 'pictures/l",
    ),
    "picture told otherwise: a number": (
        with_cell("blinking", text=("A lamp that shines on a desk", "A lamp of 40 watts")),
        "cell blinking, line 5",
        "names 40,",
    ),
    "picture told otherwise: a name": (
        with_cell("blinking", text=("A lamp that shines on a desk", "A lamp hears /light")),
        "cell blinking",
        "names /light,",
    ),
    "picture told otherwise: a count": (
        with_cell("blinking", text=("A lamp that shines on a desk", "Three lamps that shine")),
        "cell blinking",
        "names three,",
    ),
    "picture told otherwise: a thing": (
        with_cell("blinking", text=("A lamp that shines on a desk", "A lamp with a dial")),
        "cell blinking",
        "names dial,",
    ),
    "link that leads nowhere": (
        with_cell("real", text=("The motor", "See [it](../03-moon/lesson.ipynb). The motor")),
        "real",
        "leads nowhere",
    ),
    "anchor that leads nowhere": (
        with_cell("real", text=("The motor", "See [it](#blinkin). The motor")),
        "real",
        "#blinkin",
    ),
}


def said_of(lesson: Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    """The exit code, and what is printed."""
    code = main([str(lesson)])
    return code, capsys.readouterr().out


def test_a_right_lesson_breaks_no_rule(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The one that the others differ from."""
    assert said_of(write_course(tmp_path), capsys)[0] == 0, said_of(write_course, capsys)


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_lesson_is_told(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Cell and line, what is wrong, and a mend."""
    cells, where, what = WRONG[name]
    code, said = said_of(write_course(tmp_path, cells), capsys)
    lines = [line for line in said.splitlines() if where in line and what in line]
    assert code == 1 and lines, said
    assert re.search(rf"{re.escape(lines[0])}\n    Mend: .{{8,}}", said), said


@pytest.mark.parametrize(
    ("metadata", "what"),
    [
        ({**METADATA, "jupytext": {}}, "hold jupytext"),
        ({**METADATA, "kernelspec": {"name": "python3"}}, "kernel is another"),
        ({**METADATA, "language_info": {"name": "python", "version": "3"}}, "says too much"),
    ],
)
def test_wrong_metadata_is_told(
    metadata: dict[str, Any], what: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Editors write more than belongs there."""
    assert what in said_of(write_course(tmp_path, CELLS, metadata), capsys)[1]


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("</svg>", "", "is no XML"),
        ("<title>A lamp</title>", "", "no <title>"),
        ("<desc>A lamp that shines on a desk.</desc>", "<desc> </desc>", "no <desc>"),
        ("0 0 720 200", "0 0 800 200", "not 720 wide"),
        ('font-size="18"', 'font-size="13"', "13 px"),
        ("<rect", '<image href="https://example.org/x.png"/><rect', "from outside"),
    ],
)
def test_a_wrong_drawing_is_told(
    old: str, new: str, what: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What a picture must have."""
    lesson = write_course(tmp_path)
    drawing = lesson.parent / "pictures" / "lamp.svg"
    drawing.write_text(drawing.read_text("utf-8").replace(old, new), "utf-8")
    assert what in said_of(lesson, capsys)[1]


def test_what_is_no_lesson_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A broken file, a folder that is no day, and nothing at all."""
    lesson = write_course(tmp_path)
    lesson.write_text("{", "utf-8")
    assert main([str(lesson)]) == 2 and "no notebook" in capsys.readouterr().err
    moved = lesson.parent.rename(lesson.parents[1] / "03-moon")
    assert main([str(moved / "lesson.ipynb")]) == 2 and "no day" in capsys.readouterr().err
    assert main([]) == 2 and "use:" in capsys.readouterr().err


def test_sentences_end_where_a_reader_stops() -> None:
    """Abbreviations, code and links do not mislead."""
    text = "Use a tool, e.g. `ros2 topic list`. See [this page](https://a.b/c.d). Does it run? Yes."
    found = sentences(text)
    assert len(found) == 4 and words(found[0]) == 5


def test_items_and_paragraphs_go_on_over_lines() -> None:
    """One block each, with the line where it begins."""
    found = list(blocks_of("One\ntwo.\n\n- three\n  four\n- five\n\n```bash\n# six\n```\n## Seven"))
    assert [(block.kind, block.line, block.text) for block in found] == [
        ("paragraph", 1, "One two."),
        ("item", 4, "three four"),
        ("item", 6, "five"),
        ("code", 8, "# six"),
        ("heading", 11, "Seven"),
    ]


def test_headings_have_the_anchors_of_the_site() -> None:
    """Lower case, no signs, a line for each space."""
    assert slug("No waiting in a callback") == "no-waiting-in-a-callback"
    assert slug("`package.xml`, and why: it's read") == "packagexml-and-why-its-read"
