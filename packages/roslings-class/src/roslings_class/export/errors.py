"""Why nothing was exported."""

from __future__ import annotations

from roslings.course import CourseError


class CannotExport(CourseError):
    """The platform is not known, the folder holds something, or an answer would leak."""
