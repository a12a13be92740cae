"""What `ros2 doctor` asks of a doctor.

It finds this module by the entry point `ros2_on_pip.doctor`.
"""

from __future__ import annotations

from collections.abc import Sequence

from ros_doctor.cli import WrongUse, look, main, words_parser
from ros_doctor.finding import Status
from ros_doctor.machine import this_machine
from ros_doctor.redact import secrets_of

__all__ = ["WrongUse", "failed_themes", "hidden", "main", "words_parser"]


def failed_themes(words: Sequence[str], warnings_too: bool) -> list[str]:
    """Examine this machine, print what was found, and return the themes that failed, worst first.

    Raises WrongUse.
    """
    count = (Status.FAULT, Status.WARNING) if warnings_too else (Status.FAULT,)
    failed = [one.check.theme for one in look(words).worst_first() if one.finding.status in count]
    return list(dict.fromkeys(failed))


def hidden(text: str) -> str:
    """The text without names and addresses of this machine."""
    return secrets_of(this_machine()).hidden(text)
