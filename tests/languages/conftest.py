"""What these tests share."""

from __future__ import annotations

from pathlib import Path

import pytest
from false_screen import COLUMNS, Type

from ros2_on_pip.language import FALSE, speaking
from roslings import course
from roslings_launcher.cli import main


@pytest.fixture
def typed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Type:
    """In the course's folder, with a workspace of one's own."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path / "ws"))
    monkeypatch.setenv("COLUMNS", str(COLUMNS))
    monkeypatch.chdir(course.root())

    def type_words(*words: str, language: str = FALSE) -> str:
        capsys.readouterr()
        with speaking(language):
            main(words)
        return "".join(capsys.readouterr())

    return type_words
