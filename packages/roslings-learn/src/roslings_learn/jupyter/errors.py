"""Why no lesson can be opened, with the next step."""

from __future__ import annotations

from ros2_on_pip.errors import RoslingsError
from ros2_on_pip.language import said
from roslings_learn.lessons import Day


class NoLessonToOpen(RoslingsError):
    """The day that was asked for cannot be opened."""


class NoSuchDay(NoLessonToOpen):
    """The course has no such day."""

    def __init__(self, wanted: str, days: tuple[Day, ...]) -> None:
        there = "\n".join(f"  {day.number}  {day.id}" for day in days)
        text = "There is no day {wanted!r}. The days are:\n{there}"
        super().__init__(said("lab.no_such_day", text, wanted=wanted, there=there))


class NotWritten(NoLessonToOpen):
    """The day has no lesson yet."""

    def __init__(self, day: Day) -> None:
        text = "{day} has no notebook yet. To see the days that have one: ./roslings lab"
        super().__init__(said("lab.not_written", text, day=day.name))


class NoHub(NoLessonToOpen):
    """`--hub` was typed by a person."""

    def __init__(self) -> None:
        super().__init__(
            "--hub is for JupyterHub, which starts this for each of its users. In a terminal, type"
            " ./roslings lab. In the configuration of JupyterHub:\n"
            '  c.Spawner.cmd = ["/opt/roslings/roslings", "lab", "--hub"]'
        )
