"""What is seen of a launch, beside the record that every experiment has."""

from __future__ import annotations

from pydantic import Field

from roslings.record import Columns, PartSeen, Record

LABEL = "ros2 launch"
"""The name of the process that launches the others."""

UP = "launch"
"""The timed stretch from the last node to the last topic."""


class ProgramKilled(Record):
    """One program that was killed, as a crash would do it, and whether its node came back."""

    executable: str
    node: str = Field(description="Full name of the node that must answer again")
    killed_ns: int = Field(description="Observer's monotonic clock")
    back_ns: int | None = Field(default=None, description="It answered again; None: it did not")

    @property
    def back_after_s(self) -> float | None:
        """From the kill to its first answer; None where none came."""
        return None if self.back_ns is None else (self.back_ns - self.killed_ns) / 1e9


class LaunchSeen(PartSeen):
    """All that was seen of a launch in an experiment."""

    NAME = "launch"

    given: dict[str, str] = Field(
        default_factory=dict, description="Arguments of the launch file, and their values"
    )
    values: dict[str, bool | int | float | str] = Field(
        default_factory=dict,
        description="EXECUTABLE.PARAMETER to its value in the file that the launch was given",
    )
    by_name: dict[str, dict[str, bool | int | float | str]] = Field(
        default_factory=dict,
        description="Full name of a node to what the file says, below `values`, for it alone",
    )
    running: dict[str, int] = Field(
        default_factory=dict,
        description="Executable to how many of it ran when all nodes were there",
    )
    killed: Columns[ProgramKilled] = Field(default_factory=list)
    patience_s: float = Field(
        default=4.0, description="So long a topic that is missing was waited for"
    )
