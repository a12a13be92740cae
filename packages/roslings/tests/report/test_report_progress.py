"""What is told while a check runs."""

from __future__ import annotations

import io
import os
import subprocess
import sys

import pytest
from rich.console import Console

from roslings.report.progress import ProgressLine


def test_plain_lines_where_there_is_no_terminal() -> None:
    """Standard error gets one short line a step; standard output nothing."""
    code = (
        "from roslings.report.progress import ProgressLine\n"
        "with ProgressLine() as progress:\n"
        "    progress.step('Building chatter')\n"
        "    progress.step('Listening \\x1b[2J\\n to /chatter')\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        check=True,
        text=True,
    )
    assert done.stdout == ""
    assert done.stderr == "Building chatter\nListening \\x1b[2J\\n to /chatter\n"


@pytest.mark.parametrize("terminal", [True, False])
def test_quiet_tells_nothing(terminal: bool, capfd: pytest.CaptureFixture[str]) -> None:
    """Nothing at all, on a terminal and elsewhere."""
    stream = io.StringIO()
    with ProgressLine(Console(file=stream, force_terminal=terminal), quiet=True) as progress:
        progress.step("Building chatter")
    assert stream.getvalue() == ""
    assert capfd.readouterr() == ("", "")


def test_one_live_line_on_a_terminal_that_goes_away(monkeypatch: pytest.MonkeyPatch) -> None:
    """The line is drawn, cut to the width, and wiped; the cursor comes back, an error or not."""
    monkeypatch.setenv("TERM", "xterm")
    stream = io.StringIO()
    console = Console(file=stream, force_terminal=True, width=40, legacy_windows=False)
    with pytest.raises(KeyboardInterrupt), ProgressLine(console) as progress:
        progress.step("Building chatter " + "x" * 100)
        raise KeyboardInterrupt
    written = stream.getvalue()
    assert "Building chatter xx" in written
    assert "x" * 40 not in written
    assert "..." in written
    assert " 0 s" in written
    assert written.rindex("\x1b[?25h") > written.rindex("\x1b[?25l")
    assert written.endswith("\x1b[2K")


def test_plain_lines_on_a_terminal_that_cannot_move_its_cursor(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """TERM=dumb, as in an editor's window."""
    monkeypatch.setenv("TERM", "dumb")
    stream = io.StringIO()
    with ProgressLine(Console(file=stream, force_terminal=True)) as progress:
        progress.step("Building chatter")
    assert stream.getvalue() == "Building chatter\n"


def test_a_step_outside_the_block_is_harmless() -> None:
    """It is remembered for the line that is drawn later."""
    progress = ProgressLine()
    progress.step("Building chatter")
    assert progress._text == "Building chatter"
