"""Why there is no verdict: what a platform's file says then, so that nobody waits for one."""

from __future__ import annotations

from dataclasses import dataclass

from ros2_on_pip.safe_text import harmless


@dataclass(frozen=True)
class Refusal:
    """A grading that ended without a verdict."""

    lab: str
    reason: str
    next_step: str
    is_students: bool
    """The student can mend it, so it counts; else it is the machine's, and never a zero."""

    @property
    def text(self) -> str:
        """What is, and what to do."""
        return harmless(f"{self.reason}\n{self.next_step}".strip(), keep_newlines=True)
