"""The command itself: how it begins, how it ends, what it refuses."""

from __future__ import annotations

import signal
import time
from pathlib import Path

import pytest
from desk_program import desk

from ros2_on_pip.domain_lease import leased_domain

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_it_ends_and_leaves_nothing(number: signal.Signals, tmp_path: Path) -> None:
    """By Ctrl-C, by `kill`, with its terminal; neither file nor folder is left, no traceback."""
    with leased_domain() as domain, desk(domain, tmp_path) as found:
        file = found.file
        assert file.exists()
        assert found.interrupt(number) == 0
    assert not file.parent.exists()
    assert list(tmp_path.iterdir()) == []
    assert found.lines[-1] == "The desk is closed."
    assert "Traceback" not in "\n".join(found.lines)


@pytest.mark.parametrize("late_s", [0.0, 0.01, 0.03, 0.1, 0.3])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_ends_well_at_each_moment_of_its_start(
    number: signal.Signals, late_s: float, tmp_path: Path
) -> None:
    """While its loop starts, while pages are made, when it serves; twice is not too often."""
    with leased_domain() as domain, desk(domain, tmp_path) as found:
        time.sleep(late_s)
        found.process.send_signal(number)
        assert found.interrupt(number) == 0
    assert list(tmp_path.iterdir()) == []
    assert found.lines[-1] == "The desk is closed.", found.lines
    assert len(found.lines) == 4, found.lines


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nothing"], "The desk has no tab 'nothing'. It has: rover, graph"),
        (["--port", "70000"], "Port 70000 of 127.0.0.1 cannot be had"),
        (["--port", "1.5"], "invalid int value"),
    ],
)
def test_what_it_cannot_do_is_said_with_the_next_step(
    words: list[str], said: str, tmp_path: Path
) -> None:
    """In one line, and it ends with 2."""
    with leased_domain() as domain, desk(domain, tmp_path, *words) as found:
        assert found.process.wait(60) == 2
    assert said in "\n".join(found.lines)


def test_a_port_that_is_taken_is_told(tmp_path: Path) -> None:
    """By somebody else, or by another desk."""
    with leased_domain() as domain, desk(domain, tmp_path) as first:
        port = first.base.rpartition(":")[2]
        with desk(domain, tmp_path, "--port", port) as second:
            assert second.process.wait(60) == 2
    assert f"Port {port} of 127.0.0.1 cannot be had" in "\n".join(second.lines)
