"""Teams: several students of the class list whose work is one hand-in.

| platform | what the download calls the hand-in | what names the team of a student |
| --- | --- | --- |
| Moodle | `GROUP_NUMBER_assignsubmission_PART`, the number is the group's | worksheet: `Group` |
| Canvas | `group_USER_FILE_name`, the user is one member for all | group set's CSV: `group_name` |
| GitHub Classroom | a repository `assignment-group` | its grades: `group_name` |
| anything else | the team's name | a column `team` |

Sources: Moodle, mod/assign/classes/downloader.php (who is in no group hands in with the group
`Default group`, without a number) and gradingtable.php (`Group` is there only where teams hand in);
canvas-lms, lib/content_zipper.rb, and "Download Course Group Category Data" of a group set with the
columns name, canvas_user_id, user_id, login_id, sections, group_name, canvas_group_id, group_id;
gh-classroom, cmd/gh-classroom/assignment-grades. A name of a group is cleaned for the file: letters
and digits are left in each of them, so these are what is compared.

A column says who belongs together, and no more: a group may be a tutorial group, too. So members
share a hand-in only where it is called as the team, never because one of them has handed in.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Generic, Protocol, TypeVar


class Listed(Protocol):
    """A line of the class list."""

    @property
    def cells(self) -> Mapping[str, str]:
        """Column in small letters to text."""


Member = TypeVar("Member", bound=Listed)
TEAM_COLUMNS = (
    "team",
    "group_name",
    "group",
    "gruppe",
    "grupo",
    "groupe",
    "groep",
    "gruppo",
    "群組",
)
"""The instructor's own, those of Canvas and GitHub, and Moodle's in some languages."""
OF_CANVAS = {
    "canvas_user_id": "id",
    "user_id": "sis user id",
    "login_id": "sis login id",
    "sections": "section",
}
"""Columns of a group set's CSV to what Canvas's gradebook calls them."""
PART = "_assignsubmission_"


def team_of(cells: Mapping[str, str]) -> str:
    """The team that a line of the class list names; empty where it names none."""
    told = (cells.get(column, "").strip() for column in TEAM_COLUMNS)
    return next(filter(None, told), "")


def as_in_the_gradebook(cells: Mapping[str, str]) -> dict[str, str]:
    """A line of a group set's CSV as Canvas's gradebook has it; others as they are."""
    if "canvas_user_id" not in cells:
        return dict(cells)
    return {**cells, **{theirs: cells.get(ours, "") for ours, theirs in OF_CANVAS.items()}}


class Teams(Generic[Member]):
    """The teams of a class, found by what a hand-in is called."""

    def __init__(self, students: Iterable[Member], spelling: Callable[[str], str]) -> None:
        self._spelling = spelling
        self._members: defaultdict[str, list[Member]] = defaultdict(list)
        self._called: defaultdict[str, set[str]] = defaultdict(set)
        for student in students:
            if team := team_of(student.cells):
                self._members[team].append(student)
                self._called[spelling(team)].add(team)

    def named(self, text: str) -> list[str]:
        """The teams that may be meant; one as a rule, several where only their marks differ."""
        called = self._called.get(self._spelling(text), set()) if self._spelling(text) else set()
        exactly = [team for team in called if _plain(team) == _plain(text)]
        return exactly if len(exactly) == 1 else sorted(called)

    def of_folder(self, name: str) -> list[str]:
        """The same, of a folder of one's own, and of Moodle's group without a number."""
        return self.named(name) or self.named(name.partition(PART)[0])

    def members(self, teams: Sequence[str]) -> list[Member]:
        """Everybody in these teams."""
        return [student for team in teams for student in self._members[team]]


def _plain(text: str) -> str:
    """As Moodle writes a name into a file: `_` is a space."""
    return " ".join(text.replace("_", " ").casefold().split())
