"""What can go wrong with many submissions: the instructor's mistakes, and one submission's own."""

from __future__ import annotations

from pathlib import Path

from ros2_on_pip.errors import RoslingsError
from ros2_on_pip.typed_paths import from_here


class BatchError(RoslingsError):
    """Something that the instructor can mend; `next_step` says how."""

    def __init__(self, problem: str, next_step: str) -> None:
        self.problem, self.next_step = problem, next_step
        super().__init__(f"{problem}\n{next_step}")


class NoSubmissions(BatchError):
    """The path leads to nothing that could be graded."""

    def __init__(self, path: Path, problem: str) -> None:
        step = (
            "Give a folder of submissions (folders, .zip, .tar.gz), a CSV file of them, or the\n"
            "zip file that Moodle or Canvas makes of all submissions."
        )
        super().__init__(f"{from_here(path)}: {problem}", step)


class BadTable(BatchError):
    """A CSV file that the instructor gave says something that it may not say."""

    def __init__(self, path: Path, line: int, problem: str, next_step: str) -> None:
        super().__init__(f"{from_here(path)}:{line}: {problem}", next_step)


class BadGradebook(BatchError):
    """The gradebook in the folder cannot be used."""


class NoGradebook(BadGradebook):
    """None lies in the folder."""

    def __init__(self, folder: Path) -> None:
        step = "Give the folder that ./roslings grade made (--out)."
        super().__init__(f"There is no gradebook in {folder}.", step)
