"""Check lessons from a terminal; the exit code is 1 where a rule is broken."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from roslings_learn.lessons.document import BadLessons, read
from roslings_learn.lessons.lessons import read_glossary
from roslings_learn.lessons.path import Path as DayPath
from roslings_learn.lessons.rules import NoLesson, broken_rules, read_lesson
from roslings_learn.lessons.rules.reading import average_sentence

USE = "use: python -m roslings_learn.lessons.rules days/02-nodes/lesson.ipynb ..."


def main(files: Sequence[str]) -> int:
    """Print every broken rule of each lesson."""
    if not files:
        print(USE, file=sys.stderr)
        return 2
    try:
        return max(_checked(Path(file)) for file in files)
    except (BadLessons, NoLesson) as error:
        print(error, file=sys.stderr)
        return 2


def _checked(file: Path) -> int:
    root = file.absolute().parents[2]
    days = {day.id: day for day in read(root / "days" / "path.yaml", DayPath).content.days}
    day = days.get(file.absolute().parent.name)
    if day is None:
        print(f"{file}: its folder is no day of {root / 'days' / 'path.yaml'}.", file=sys.stderr)
        return 2
    lesson = read_lesson(file, day)
    broken = broken_rules(lesson, read_glossary(root))
    for each in broken:
        print(each)
    average = average_sentence(lesson)
    print(f"{file}: {len(broken)} rules broken, {average:.1f} words a sentence on average.")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
