"""Where the results stay, so that an interrupted run goes on: beside the course, unseen by git."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roslings import course
from roslings_class.alone import alone_in
from roslings_class.errors import BatchError


class AlreadyRewriting(BatchError):
    """Another command keeps its results there."""

    def __init__(self, folder: Path) -> None:
        problem = f"Another ./roslings prove --rewritten keeps its results in {folder} now."
        super().__init__(problem, "Wait until it ends.")


@contextmanager
def kept_results() -> Iterator[Path]:
    """A folder for one command at a time. Raises AlreadyRewriting."""
    folder = course.root() / ".roslings" / "rewritten"
    with alone_in(folder, AlreadyRewriting):
        yield folder
