"""What these tests share with those that span packages."""

from courses import (
    bare_python,
    course,
    index,
    make_course,
    online,
    ready,
    standing,
    wheels,
    wheels_for_all,
)

__all__ = [
    "bare_python",
    "course",
    "index",
    "make_course",
    "online",
    "ready",
    "standing",
    "wheels",
    "wheels_for_all",
]
