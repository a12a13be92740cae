"""The wheel's command before there is a course: what the packages beside the launcher do."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslings_launcher import installed


def test_the_doctor_looks_where_no_course_is_yet(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """At the computer alone."""
    monkeypatch.delenv("ROSLINGS_COURSE", raising=False)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.argv", ["roslings", "doctor", "--list"])
    with pytest.raises(SystemExit) as ended:
        installed.main()
    said = capsys.readouterr()
    assert ended.value.code == 0
    assert "disk-space" in said.out
    assert "computer alone" in said.err
