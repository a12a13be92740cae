"""Comments and docstrings read as lessons do: the same rule on sentences, from the same place."""

from __future__ import annotations

from pathlib import Path

from comments import sentences_of
from roslings_learn.lessons.rules.prose import words
from roslings_learn.lessons.rules.reading import MOST_WORDS
from sources import ROOT, our_modules

BEGIN = "The rover stops" + " and then it stops" * 4
END = "and then it stops " * 3 + "and then it stops."
LONG = f"{BEGIN} {END}"


def too_long(code: str) -> list[str]:
    """Line, length and text of each sentence that breaks the rule."""
    return [
        f"{said.line}: {length} words: {said.text}"
        for said in sentences_of(code)
        if (length := words(said.text)) > MOST_WORDS
    ]


def modules() -> list[Path]:
    """Those of our packages, and the graders."""
    return [*our_modules(), *sorted((ROOT / "graders").rglob("*.py"))]


def test_a_sentence_beside_the_code_is_as_short_as_one_of_a_lesson() -> None:
    """Make two of each that is named."""
    found = [f"{file}:{each}" for file in modules() for each in too_long(file.read_text("utf-8"))]
    assert not found, "\n".join(found)


def test_a_long_sentence_is_found_in_a_comment() -> None:
    """Over several lines, and behind code."""
    assert too_long(f"speed = 0\n# Short.\n# {BEGIN}\n# {END}\n") == [f"2: 35 words: {LONG}"]
    assert too_long(f"speed = 0\nturn = 0  # {LONG}\n") == [f"2: 35 words: {LONG}"]
    assert not too_long(f"# {BEGIN}\nspeed = 0\n# {END}\n")


def test_a_long_sentence_is_found_in_a_docstring() -> None:
    """Of a function, in a later paragraph, in an item, and below a field."""
    function = f'def stop():\n    """Stop.\n\n    {LONG}\n    """\n'
    assert too_long(function) == [f"4: 35 words: {LONG}"]
    item = f'"""Stop.\n\n- {BEGIN}\n  {END}\n"""\n'
    assert too_long(item) == [f"3: 35 words: {LONG}"]
    assert too_long(f'speed = 0\n"""{LONG}"""\n') == [f"2: 35 words: {LONG}"]


def test_what_is_no_sentence_may_be_long() -> None:
    """Code, tables and sources in a docstring, and a text that the program uses."""
    code = "\n".join(["    rover.stop() and then rover.stop() again"] * 8)
    table = "\n".join(["stop   the rover stands and goes on later"] * 8)
    for text in (code, table, f"| {LONG} |", f"```\n{LONG}\n```", f"Sources: {LONG}"):
        assert not too_long(f'"""Stop.\n\n{text}\n"""\n'), text
    assert not too_long(f'said = """{LONG}"""\n')
