"""The path of days: `days/path.yaml` names all days, also those whose lesson is not yet there."""

from __future__ import annotations

from pydantic import Field

from ros2_on_pip.language import said
from roslings_learn.lessons.document import DocumentPart


class Day(DocumentPart):
    """One day of the course."""

    id: str = Field(pattern=r"^[0-9]{2}-[a-z0-9-]+$", description="Its folder in days/")
    title: str
    can: str = Field(description="What the student can do after it, one sentence")
    hours: float = Field(gt=0, le=24, description="Lesson and lab together")
    picture: str | None = Field(
        default=None, description="The drawing that shows what the day is about, in its pictures/"
    )
    senses: tuple[str, ...] = Field(
        default=(), description="Ids of words that this day's pages mean, where a word has several"
    )

    @property
    def number(self) -> int:
        """1 for the first day."""
        return int(self.id[:2])

    @property
    def name(self) -> str:
        """As a person says it: `Day 3: Topics`."""
        return said("path.day", "Day {number}: {title}", number=self.number, title=self.title)


class Path(DocumentPart):
    """The file `days/path.yaml`."""

    days: tuple[Day, ...] = Field(min_length=1)
