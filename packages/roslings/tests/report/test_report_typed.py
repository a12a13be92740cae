"""A verdict names its next commands as the student typed them."""

from __future__ import annotations

import io
from dataclasses import replace

import pytest
import written_verdicts as written
from rich.console import Console

from roslings.report.command_line import CommandLine
from roslings.report.html.verdict_part import head
from roslings.report.terminal import print_verdict
from roslings.verdict import Verdict

TYPED = CommandLine("topics", "roslings", ("'my ws/chatter'",), ("--port /dev/ttyACM0",))


def shown(verdict: Verdict, screen: bool = False, **words: object) -> str:
    """What is printed, with all white space as one blank."""
    out = io.StringIO()
    console = Console(file=out, width=150, height=200, force_terminal=screen, color_system=None)
    print_verdict(verdict, console=console, command_line=TYPED, **words)  # type: ignore[arg-type]
    return " ".join(out.getvalue().split())


@pytest.mark.parametrize("screen", [True, False])
def test_next_and_hint_repeat_path_and_options(screen: bool) -> None:
    """On a screen and in a file."""
    text = shown(written.too_slow(), screen)
    again = "roslings check topics 'my ws/chatter' --port /dev/ttyACM0"
    assert f"then check again: {again} Stuck Ask for a hint: {again} --hint" in text
    assert "./roslings" not in text


def test_a_hint_names_the_next_hint_of_the_same_package() -> None:
    """With its step."""
    text = shown(written.too_slow(), hint_step=1)
    assert "roslings check topics 'my ws/chatter' --port /dev/ttyACM0 --hint 2" in text
    assert "./roslings" not in text


def test_pack_takes_the_path_and_no_option() -> None:
    """What is handed in is what was checked."""
    text = shown(written.full_score())
    assert (
        "hand in: roslings pack topics 'my ws/chatter' Then go on with the course: roslings" in text
    )


def test_nobody_hands_in_what_only_shows_a_check() -> None:
    """The example of the first page: the course goes on, in the terminal and on the page."""
    example = replace(TYPED, handed_in=False)
    console = Console(width=80, record=True, file=io.StringIO())
    print_verdict(written.full_score(), console=console, command_line=example)
    text = " ".join(console.export_text().split())
    assert "Next Go on with the course: roslings" in text
    assert "pack" not in text.partition("Next")[2]
    assert "`pack`" not in text
    page = head(written.full_score(), example)
    assert "Go on with the course:" in page and "roslings pack" not in page
    assert "roslings pack" in head(written.full_score(), TYPED)


def test_a_command_in_a_fault_is_typed_alike() -> None:
    """The picture is saved into the package that was checked."""
    told = TYPED.told("Then: ./roslings graph --for topics --force")
    assert told == "Then: roslings graph --for topics 'my ws/chatter' --force"
    assert (
        CommandLine("topics").told("./roslings graph --for topics")
        == "./roslings graph --for topics"
    )
