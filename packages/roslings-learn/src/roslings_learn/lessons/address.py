"""Where the course is cloned from, and where it can be read: said once, told in several texts.

`[project.urls]` of the engine's pyproject.toml says it; the wheel carries it, too. After a change,
`python -m roslings_learn.lessons.address` writes it into the texts. While it says nothing, they
name the teacher, and the site that the students' edition brings.
"""

from __future__ import annotations

import json
import re
import sys
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from roslings.course import root

FILE = "packages/roslings/pyproject.toml"
TELL_HOW_TO_GET_IT = (
    "README.md",
    "days/01-install/first-15-minutes.md",
    "days/01-install/lesson.ipynb",
    "site/pages/index.md",
    "site/pages/reference/installing.md",
)
TELL_WHERE_TO_READ = ("README.md", "site/pages/reference/installing.md")

TABLE = re.compile(r"^\[project\.urls\]$(.*?)(?=^\[|\Z)", re.M | re.S)
ROW = re.compile(r'^(\w+) = "([^"\n]+)"', re.M)
UNKNOWN = (
    "`git clone ADDRESS roslings`. ADDRESS is the address or folder that your teacher gave you."
)
UNPUBLISHED = (
    "To read without installing anything, open `site/html/index.html`: a course from your teacher"
    " or from `roslings new` has it."
)
COLUMNS = 80


@dataclass(frozen=True)
class Address:
    """An empty one is not known yet."""

    repository: str = ""
    documentation: str = ""

    @property
    def clone(self) -> str:
        """How one gets the course."""
        return f"`git clone {self.repository} roslings`." if self.repository else UNKNOWN

    @property
    def read(self) -> str:
        """How one reads it without installing it."""
        known = f"To read without installing anything: <{self.documentation}>."
        return known if self.documentation else UNPUBLISHED


def address_in(pyproject: str) -> Address:
    """What the text of a pyproject.toml says. Python 3.10 reads no TOML."""
    found = TABLE.search(pyproject)
    rows = dict(ROW.findall(found[1])) if found else {}
    return Address(rows.get("Repository", ""), rows.get("Documentation", ""))


def _loose(sentence: str) -> str:
    """A pattern for it, wherever its lines are broken."""
    return r"\s+".join(map(re.escape, sentence.split()))


CLONE = re.compile(rf"{_loose(UNKNOWN)}|`git\s+clone\s+\S+\s+roslings`\.")
READ = re.compile(rf"{_loose(UNPUBLISHED)}|To\s+read\s+without\s+installing\s+anything:\s+<\S+>\.")


def told(text: str, address: Address) -> str:
    """The text with this address in it; a paragraph that changes is broken into lines anew."""
    return "\n\n".join(_paragraph(each, address) for each in text.split("\n\n"))


def _paragraph(before: str, address: Address) -> str:
    after = CLONE.sub(lambda _: address.clone, before)
    after = READ.sub(lambda _: address.read, after)
    if " ".join(after.split()) == " ".join(before.split()):
        return before
    end = "\n" if before.endswith("\n") else ""
    lines = textwrap.wrap(after, COLUMNS, break_long_words=False, break_on_hyphens=False)
    return "\n".join(lines) + end


def told_in(file: Path, address: Address) -> str:
    """The content of a text of the course with this address in it: Markdown, or a notebook."""
    content = file.read_text("utf-8")
    if file.suffix != ".ipynb":
        return told(content, address)
    notebook = json.loads(content)
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown":
            cell["source"] = told("".join(cell["source"]), address).splitlines(keepends=True)
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def outdated(course: Path) -> Iterator[Path]:
    """The texts that tell another address than the course's."""
    address = address_in((course / FILE).read_text("utf-8"))
    for file in (course / name for name in TELL_HOW_TO_GET_IT):
        if told_in(file, address) != file.read_text("utf-8"):
            yield file


def main() -> int:
    """Bring the texts up to date, and name them."""
    course = root()
    address = address_in((course / FILE).read_text("utf-8"))
    for file in [*outdated(course)]:
        file.write_text(told_in(file, address), "utf-8")
        print(file.relative_to(course))
    return 0


if __name__ == "__main__":
    sys.exit(main())
