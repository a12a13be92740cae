"""Errors below a cell: short, and ending in the student's own lines.

An assertion of a cell is a task that is not done yet: it is told in a line. It stays an error, so
that whoever runs the notebook sees that the cell failed.
"""

from __future__ import annotations

import linecache
import traceback
from types import TracebackType
from typing import Any

from roslings_learn.notebook.errors import NoRos, NotebookTrouble

RED, BOLD, PLAIN = "\x1b[31m", "\x1b[1m", "\x1b[0m"
NOT_YET = "Not yet"
ROS_PACKAGES = ("rclpy", "std_msgs", "geometry_msgs", "sensor_msgs", "nav_msgs", "std_srvs")


def install() -> None:
    """Show errors so from now on, where this is a notebook. Once is enough, twice does no harm."""
    from roslings_learn.notebook.picture import notebook_shell

    shell = notebook_shell()
    if shell is not None:
        shell.set_custom_exc((Exception, KeyboardInterrupt), _show)


def _show(
    shell: Any,
    kind: type[BaseException],
    error: BaseException,
    trace: TracebackType | None,
    tb_offset: int | None = None,
) -> list[str]:
    lines = told(shell, error)
    shell._showtraceback(kind, error, lines)
    return lines


def told(shell: Any, error: BaseException) -> list[str]:
    """The lines that the student sees."""
    frames = [
        frame for frame in traceback.extract_tb(error.__traceback__) if _is_cell(shell, frame)
    ]
    if isinstance(error, KeyboardInterrupt):
        return [f"{BOLD}Stopped.{PLAIN} All that this cell started has ended."]
    if isinstance(error, AssertionError) and _ends_in_a_cell(shell, error):
        return [f"{RED}{BOLD}{NOT_YET}:{PLAIN} {_asserted(error, frames)}"]
    if isinstance(error, ModuleNotFoundError) and error.name in ROS_PACKAGES:
        error = NoRos()
    if isinstance(error, NotebookTrouble) or _is_problem(error):
        return [*map(_where, frames[-1:]), f"{RED}{BOLD}{type(error).__name__}:{PLAIN} {error}"]
    return [*map(_where, frames or _last(error)), _named(error)]


def _named(error: BaseException) -> str:
    """Python's own last lines. Only the kind is red: long red text is hard to read on pink."""
    said = "".join(traceback.format_exception_only(type(error), error)).rstrip()
    kind, colon, rest = said.partition(":")
    if "\n" in kind:  # a SyntaxError shows its place first
        return said
    return f"{RED}{BOLD}{kind}{colon}{PLAIN}{rest}"


def _is_problem(error: BaseException) -> bool:
    from ros2_on_pip.errors import RoslingsError
    from ros2_on_pip.problem import CommandProblem

    return isinstance(error, (CommandProblem, RoslingsError))


def _is_cell(shell: Any, frame: traceback.FrameSummary) -> bool:
    return frame.filename in getattr(shell.compile, "_filename_map", {})


def _ends_in_a_cell(shell: Any, error: BaseException) -> bool:
    frames = traceback.extract_tb(error.__traceback__)
    return bool(frames) and _is_cell(shell, frames[-1])


def _last(error: BaseException) -> list[traceback.FrameSummary]:
    return list(traceback.extract_tb(error.__traceback__))[-1:]


def _asserted(error: BaseException, frames: list[traceback.FrameSummary]) -> str:
    """Its message; without one, the line that was not true."""
    line = frames[-1].line if frames else ""
    return str(error) or f"this is not true: {(line or '').removeprefix('assert').strip()}"


def _where(frame: traceback.FrameSummary) -> str:
    line = linecache.getline(frame.filename, frame.lineno or 0).strip()
    return f"Line {frame.lineno} of the cell, in {frame.name}:\n    {line}"
