"""What leads through the course is read from a card before anything is installed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from roslings.course import all_labs, lab, root
from roslings.course.files import text_of
from roslings.course.labs import EXAMPLE
from roslings.course.outline import outline_as_written, outline_in

CARDS = [each.folder / "card.yaml" for each in (*all_labs(), lab(EXAMPLE))]
VALUES = st.one_of(
    st.sampled_from(
        [
            "A talker",
            "03-topics",
            "chatter",
            "[topics]",
            "[topics, services]",
            "yes",
            "No",
            "12",
            "1.5",
            "2026-11-27",
            "'quoted'",
            '"quoted"',
            "|",
            ">",
            "&a b",
            "*a",
            "a: b",
            "a # b",
            "a #b",
            "a#b",
            "[yes]",
            "[1, 2]",
            "[]",
            "{}",
            "~",
            "null",
            "",
            "é",
            "x\\ty",
            "- a",
            "? a",
            "!t a",
            "%a",
            "@a",
            "`a",
        ]
    ),
    st.text(st.characters(codec="utf-8", exclude_characters="\n\r\x85\u2028\u2029"), max_size=12),
)
LINES = st.lists(
    st.tuples(st.sampled_from(["title", "day", "needs", "package", "points", "titles"]), VALUES),
    max_size=8,
)


@pytest.mark.parametrize("card", CARDS, ids=lambda card: card.parent.name)
def test_the_course_s_own_cards_are_written_as_usual(card: Path) -> None:
    """Their outline needs no YAML, and is the same."""
    found = outline_as_written(text_of(card))
    assert found is not None
    assert found == outline_in(yaml.safe_load(text_of(card)))


@settings(max_examples=400, deadline=None, database=None)
@given(LINES)
def test_lines_are_read_as_yaml_reads_them_or_not_at_all(lines: list[tuple[str, str]]) -> None:
    """Of a card that is written otherwise, YAML has the word."""
    card = "title: A talker\nday: 03-topics\npackage: chatter\n"
    card += "".join(f"{word}: {value}\n" for word, value in lines)
    found = outline_as_written(card)
    if found is None:
        return
    try:
        by_yaml = outline_in(yaml.safe_load(card))
    except yaml.YAMLError:
        return  # a mistake elsewhere: whoever reads the whole card tells it
    assert found == by_yaml


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["status"],
        ["doctor", "--list"],
        ["break", "--list"],
        ["--version"],
        ["--help"],
        ["check", "--help"],
        ["no-such"],
    ],
    ids=" ".join,
)
def test_a_fresh_clone_answers_before_anything_is_installed(
    words: list[str], tmp_path: Path
) -> None:
    """With Python's standard library, and nothing else: the first word of many is `./roslings`."""
    start = root() / "packages/roslings-launcher/src/roslings_launcher/start.py"
    bare = [sys.executable, "-I", "-S", str(start), *words]
    environment = {"HOME": str(tmp_path), "PATH": "/usr/bin:/bin"}
    ran = subprocess.run(
        bare, cwd=root(), env=environment, capture_output=True, text=True, check=False
    )
    assert "Traceback" not in ran.stderr
    assert (ran.stdout if ran.returncode == 0 else ran.stderr).strip()
    assert ran.returncode == (2 if words == ["no-such"] else 0), ran.stderr
