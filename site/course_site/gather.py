"""Gathers all pages in one folder, as Sphinx wants them: the course keeps them where they belong.

site/pages/**            -> the same place
days/NN-name/lesson.ipynb -> days/NN-name/index.ipynb, with the pictures and pages beside it
days/NN-name/quiz.yaml   -> days/NN-name/quiz.md and answers.md
labs/NAME/task.md        -> labs/NAME.md, with its pictures in labs/NAME/pictures
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, field
from pathlib import Path

import ros2_on_pip
from ros2_on_pip.language import said
from roslings.course import all_labs
from roslings_learn.lessons import Day, read_lessons

COMMANDS = Path(ros2_on_pip.__file__).with_name("COMMANDS.md")
NOT_A_PAGE = ("quiz.yaml", "lesson.ipynb")
DRILLS = "drills"
IMPORTS = "imports"
"""The cell of a lesson that only makes the others ready."""
LINK_TO_LESSON = re.compile(r"\]\(((?:\.\./[0-9a-z-]+/)?)lesson\.ipynb")
LINK_TO_PAGE = "](../../site/pages/"
LINK_TO_TASK = re.compile(r"\]\(\.\./\.\./labs/([0-9a-z-]+)/task\.md")


@dataclass
class Gathered:
    """The folder with all pages, and where each came from."""

    folder: Path
    origins: dict[Path, Path] = field(default_factory=dict)

    def copy(self, origin: Path, name: str) -> None:
        """Put a file at `name`; an unchanged one keeps its date, so that Sphinx passes it over."""
        self.origins[self.folder / name] = origin
        self._put(name, origin.read_bytes())

    def write(self, name: str, text: str, origin: Path) -> None:
        """Put a page that is made from `origin`."""
        self.origins[self.folder / name] = origin
        self._put(name, text.encode())

    def _put(self, name: str, content: bytes) -> None:
        target = self.folder / name
        if not target.is_file() or target.read_bytes() != content:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)

    def forget_the_rest(self) -> None:
        """Remove what an earlier build left here."""
        for path in sorted(self.folder.rglob("*"), reverse=True):
            if path.is_file() and path not in self.origins:
                path.unlink()
            elif path.is_dir() and not any(path.iterdir()):
                path.rmdir()

    def in_the_authors_words(self, said: str) -> str:
        """Replace the names of gathered files by those of the files they came from."""
        for path, origin in self.origins.items():
            said = said.replace(str(path), str(origin))
        return said


def gather(course: Path, pages: Path, folder: Path) -> Gathered:
    """Gather the pages of the course in `folder`. Raises BadLessons and CourseError."""
    gathered = Gathered(folder)
    folder.mkdir(parents=True, exist_ok=True)
    lessons = read_lessons(course)
    for page in sorted(pages.rglob("*")):
        if page.is_file():
            gathered.copy(page, str(page.relative_to(pages)))
    for day in lessons.days:
        _gather_day(gathered, course / "days" / day.id, day)
    _gather_labs(gathered, {day.id: day for day in lessons.days})
    gathered.copy(COMMANDS, "reference/commands.md")
    gathered.forget_the_rest()
    return gathered


def _gather_day(gathered: Gathered, folder: Path, day: Day) -> None:
    lesson, quiz = folder / "lesson.ipynb", folder / "quiz.yaml"
    if lesson.is_file():
        gathered.write(f"days/{day.id}/index.ipynb", _with_tree(lesson, quiz), lesson)
        for beside in folder.rglob("*"):
            if DRILLS in beside.relative_to(folder).parts:
                continue  # a drill is run in a terminal, and its answer lies beside it
            if beside.suffix == ".md":
                name = f"days/{day.id}/{beside.relative_to(folder)}"
                gathered.write(name, _linked(beside), beside)
            elif beside.is_file() and beside.name not in NOT_A_PAGE:
                gathered.copy(beside, f"days/{day.id}/{beside.relative_to(folder)}")
    if quiz.is_file():
        gathered.write(f"days/{day.id}/quiz.md", _quiz_page(day), quiz)
        gathered.write(f"days/{day.id}/answers.md", _answers_page(day), quiz)


def _linked(page: Path) -> str:
    """Its text, with links to pages of the course as they are called here: there they are files."""
    text = page.read_text("utf-8").replace(LINK_TO_PAGE, "](../../")
    text = LINK_TO_TASK.sub(r"](../../labs/\1.md", text)
    return LINK_TO_LESSON.sub(r"](\1index.ipynb", text)


def _with_tree(lesson: Path, quiz: Path) -> str:
    """The lesson, with the other pages of its day below it in the side bar."""
    folder = lesson.parent
    pages = sorted(str(p.relative_to(folder).with_suffix("")) for p in folder.rglob("*.md"))
    pages += [f"{said('site.quiz', 'Quiz')} <{quiz.stem}>"] if quiz.is_file() else []
    notebook = json.loads(_linked(lesson))
    for cell in notebook["cells"]:
        if cell.get("id") == IMPORTS:  # becomes a class of the cell on the page
            cell["metadata"].setdefault("tags", []).append(IMPORTS)
    if pages:
        tree = "\n".join(["```{toctree}", ":hidden:", "", *pages, "```"])
        cell = {"cell_type": "markdown", "id": "tree-of-the-day", "metadata": {}, "source": tree}
        notebook["cells"].append(cell)
    return json.dumps(notebook, indent=1, ensure_ascii=False)


def _quiz_page(day: Day) -> str:
    title = "Quiz of day {day}: {title}"
    head = said("site.quiz.title", title, day=day.number, title=day.title)
    return f"# {head}\n\n```{{quiz}} {day.id}\n```\n"


def _answers_page(day: Day) -> str:
    front = "---\norphan: true\nnosearch: true\n---\n"
    title = "Answers of day {day}: {title}"
    head = said("site.answers.title", title, day=day.number, title=day.title)
    return f"{front}# {head}\n\n```{{quiz-answers}} {day.id}\n```\n"


def _gather_labs(gathered: Gathered, days: dict[str, Day]) -> None:
    for lab in all_labs():
        senses = days[lab.card.day].senses if lab.card.day in days else ()
        front = f"---\nsenses: [{', '.join(senses)}]\n---\n"
        task = lab.task.read_text("utf-8").replace("](pictures/", f"]({lab.name}/pictures/")
        gathered.write(f"labs/{lab.name}.md", front + task, lab.task)
        for picture in (lab.folder / "pictures").glob("*"):
            gathered.copy(picture, f"labs/{lab.name}/pictures/{picture.name}")
