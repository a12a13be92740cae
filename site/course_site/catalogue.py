"""All texts that a translator has: those with ids, and those of the pages.

Texts with ids stand in the code beside them (`said("verdict.score", "Score")`), or in the course's
own files: titles of checks, hints, words, questions. What is in a page as its author wrote it is
taken out of it by Sphinx, a `.po` file a page.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from itertools import chain
from pathlib import Path
from typing import Literal, NamedTuple, get_args

from course_site.glossary_page import category_id
from course_site.qos_table import texts_of_rules
from course_site.small_scripts import texts_of_scripts
from ros2_on_pip.errors import RoslingsError
from ros2_on_pip.language import FOLDER, Translation
from ros_doctor.pages import english_page_of, page_id
from ros_doctor.registry import CheckText, all_checks
from roslings.course import Lab, all_labs
from roslings.course.grader import load_grader
from roslings.course.titles import lab_title_id
from roslings.folders.course_folder import engine_root
from roslings.judge.faults.sentences import every_told
from roslings.judge.plugin import hint_id
from roslings.judge.sheet import PREFIX, english_title, title_id
from roslings_class.export.bundle import README, readme_id
from roslings_class.export.systems import SYSTEMS
from roslings_learn.drills.card_texts import texts_of as texts_of_drill
from roslings_learn.drills.course import all_drills
from roslings_learn.lessons.lessons import read_lessons
from roslings_learn.lessons.translated import texts_of

ONE_TEXT = ("Text", "DoctorText", "said", "told")
FORMS = ("counted", "form")
"""Calls that have a text for each form of the plural."""
Home = Literal["lowest", "doctor", "engine", "site", "course"]
"""The package below all others; the doctor; the engine; its site and graders; the course asked."""
ALONE: dict[str, Home] = {"ros2-on-pip": "lowest", "ros-doctor": "doctor"}
"""Packages that are used without the course, too, and have their own translations in them."""


class BadTexts(RoslingsError):
    """Two texts have one id, or a text cannot be read where its id stands."""


@dataclass(frozen=True)
class Entry:
    """One text with an id."""

    id: str
    english: str
    where: str
    """For who translates: the file, with the line where there is one."""
    home: Home
    """Whose it is: its translations lie there, too."""


def entries(course: Path) -> dict[str, Entry]:
    """Every text of the course and its programs, by its id. Raises BadTexts, and of bad files."""
    found: dict[str, Entry] = {}
    of_course = _of_labs(course), _of_lessons(course), _of_drills(course)
    for each in chain(_of_code(), _of_faults(), *of_course):
        known = found.setdefault(each.id, each)
        if known.english != each.english:
            raise BadTexts(f"{each.where}: {each.id!r} is another text in {known.where}.")
    return found


def folder_of(entry: Entry, course: Path) -> Path:
    """The folder of the languages that it lies in."""
    packages = engine_root() / "packages"
    return {
        "lowest": packages / "ros2-on-pip/src/ros2_on_pip" / FOLDER,
        "doctor": packages / "ros-doctor/src/ros_doctor" / FOLDER,
        "engine": packages / "roslings/src/roslings" / FOLDER,
        "site": engine_root() / "site" / FOLDER,
        "course": course / "site" / FOLDER,
    }[entry.home]


# --- in code -----------------------------------------------------------------------------------


def _of_code() -> Iterator[Entry]:
    engine = engine_root()
    for file in sorted(engine.glob("packages/*/src/**/*.py")):
        home = home_of(file.relative_to(engine).parts[1])
        for line, name, english in texts_in(file):
            yield Entry(name, english, f"{file.relative_to(engine)}:{line}", home)
    yield from _of_doctor()
    for system in SYSTEMS.values():
        readme = system.templates / README
        english, where = readme.read_text("utf-8"), str(readme.relative_to(engine))
        yield Entry(readme_id(system), english, where, "engine")
    for file in sorted((*engine.glob("graders/**/*.py"), *engine.glob("site/**/*.py"))):
        for line, name, english in texts_in(file):
            yield Entry(name, english, f"{file.relative_to(engine)}:{line}", "site")
    for name, english in (*texts_of_scripts(), *texts_of_rules()):
        yield Entry(name, english, "site/", "site")


def home_of(package: str) -> Home:
    """Whose the texts of a package are."""
    return ALONE.get(package, "engine")


def _of_doctor() -> Iterator[Entry]:
    """What each check of the doctor is about, and its page."""
    for check in all_checks():
        for part in get_args(CheckText):
            yield Entry(check.text_id(part), getattr(check, part), f"check {check.id}", "doctor")
        if page := english_page_of(check):
            yield Entry(page_id(check), page, f"pages/{check.theme}.md", "doctor")


def texts_in(file: Path) -> Iterator[tuple[int, str, str]]:
    """Line, id and English of each text of a Python file. Raises BadTexts."""
    tree = ast.parse(file.read_text("utf-8"))
    shared = [*_constants(tree)]
    for scope in (node for node in ast.walk(tree) if isinstance(node, SCOPES)):
        own = [*_constants(scope)] if scope is not tree else []
        for call in _own_calls(scope):
            for name, node in _asked(call):
                text = _text_of(node, call.lineno, own, shared)
                if text is None:
                    raise BadTexts(f"{file}:{call.lineno}: write the English of {name!r} out.")
                yield call.lineno, name, text


SCOPES = (ast.Module, ast.FunctionDef, ast.Lambda)


def _own_calls(scope: ast.AST) -> Iterator[ast.Call]:
    """The calls in it, and not in a function inside of it."""
    for node in ast.iter_child_nodes(scope):
        if isinstance(node, ast.Call):
            yield node
        if not isinstance(node, SCOPES):
            yield from _own_calls(node)


class NamedText(NamedTuple):
    """A text that has a name in the code, from a line on."""

    line: int
    name: str
    text: str


def _text_of(
    node: ast.expr, line: int, own: Sequence[NamedText], shared: Sequence[NamedText]
) -> str | None:
    """What stands there, or what its name meant at this line; None for what is not written out."""
    if not isinstance(node, ast.Name):
        return _literal(node)
    before = [each.text for each in own if each.name == node.id and each.line <= line]
    anywhere = [each.text for each in shared if each.name == node.id]
    return next(iter([*reversed(before), *anywhere]), None)


def _constants(scope: ast.AST) -> Iterator[NamedText]:
    """Names that are texts there, in their order; those of a function inside are its own."""
    for each in ast.iter_child_nodes(scope):
        if isinstance(each, ast.Assign):
            for target in each.targets:
                yield from _named(target, each.value)
        if not isinstance(each, SCOPES):
            yield from _constants(each)


def _named(target: ast.expr, value: ast.expr) -> Iterator[NamedText]:
    if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
        for one, its_value in zip(target.elts, value.elts, strict=False):
            yield from _named(one, its_value)
    elif isinstance(target, ast.Name) and (text := _literal(value)) is not None:
        yield NamedText(value.lineno, target.id, text)


def _asked(call: ast.Call) -> Iterator[tuple[str, ast.expr]]:
    """The ids that a call names, each with what is its English."""
    function = call.func.id if isinstance(call.func, ast.Name) else ""
    name = _literal(call.args[0]) if call.args else None
    if name is None or "." not in name:
        return
    if function in ONE_TEXT:
        yield name, call.args[1]
    elif function in FORMS:
        yield from (
            (f"{name}.{k.arg}", k.value) for k in call.keywords if k.arg in ("one", "other")
        )


def _literal(node: ast.expr) -> str | None:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else None


# --- in what the course is made of ---------------------------------------------------------------


def _of_faults() -> Iterator[Entry]:
    _load_faults()
    for kind in every_told():
        home: Home = "engine" if kind.__module__.startswith("roslings") else "course"
        for sentence in kind.sentences().values():
            for each in sentence.templates:
                if each.english:
                    yield Entry(each.id, each.english, f"class {kind.__name__}", home)


@cache
def _load_faults() -> None:
    """Import each module that may have some; a class is known when it is loaded."""
    sources = engine_root().glob("packages/*/src/**/*.py")
    for file in (each for each in sources if "faults" in (each.stem, each.parent.name)):
        source = next(parent for parent in file.parents if parent.name == "src")
        parts = file.relative_to(source).with_suffix("").parts
        import_module(".".join(parts).removesuffix(".__init__"))


def _of_labs(course: Path) -> Iterator[Entry]:
    for lab in all_labs():
        where = str((lab.folder / "card.yaml").relative_to(course))
        yield Entry(lab_title_id(lab), lab.outline.title, where, "course")
        yield from _of_grader(lab, course)
        for check, hint in lab.hints.items():
            for number, step in enumerate(hint.steps, 1):
                where = str((lab.folder / "hints.yaml").relative_to(course))
                yield Entry(hint_id(lab.name, check, number), step, where, "course")


def _of_grader(lab: Lab, course: Path) -> Iterator[Entry]:
    """The titles of its checks; a course may be without its graders."""
    found = vars(load_grader(lab.grader)).values() if lab.grader.is_file() else ()
    for function in found:
        if getattr(function, "__name__", "").startswith(PREFIX) or _is_shared(function):
            where = str(lab.grader.relative_to(course))
            yield Entry(title_id(function), english_title(function), where, "course")


def _is_shared(function: object) -> bool:
    """A check that several graders have, under a name of its own."""
    return hasattr(function, "roslings_check") and hasattr(function, "__globals__")


def _of_lessons(course: Path) -> Iterator[Entry]:
    lessons = read_lessons(course)
    for name, english in texts_of(lessons):
        where = {"days": "days/path.yaml", "quizzes": "days/*/quiz.yaml"}
        yield Entry(name, english, where.get(name.partition(".")[0], "glossary/"), "course")
    for category in lessons.glossary.categories:
        yield Entry(category_id(category), category.category, "glossary/", "course")


def _of_drills(course: Path) -> Iterator[Entry]:
    for drill in all_drills(course):
        where = str(drill.where()[0].relative_to(course))
        for name, english in texts_of_drill(drill.name, drill.written_card):
            yield Entry(name, english, where, "course")


# --- a translator's files ------------------------------------------------------------------------


def room_of(name: str) -> str:
    """The file that an id lies in: its first word."""
    return name.partition(".")[0]


def merged(
    wanted: Iterable[Entry], known: Mapping[str, Translation]
) -> tuple[dict[str, tuple[str, str]], list[Translation]]:
    """Each id to its English and its translation so far; and the translations that fit none.

    A text that has a new id, and is the same in English, keeps its translation.
    """
    by_english = {each.english: each.says for each in known.values() if each.says}
    found: dict[str, tuple[str, str]] = {}
    used = set[str]()
    for entry in wanted:
        old = known.get(entry.id)
        same = old.says if old and old.english == entry.english else ""
        found[entry.id] = (entry.english, same or by_english.get(entry.english, ""))
        used.add(entry.english)
    return found, [each for each in known.values() if each.says and each.english not in used]


def unknown(known: Mapping[str, Translation], wanted: Mapping[str, Entry]) -> list[Translation]:
    """The translations whose id no text has."""
    plurals = {name.removesuffix(".other") for name in wanted if name.endswith(".other")}
    return [
        each
        for each in known.values()
        if each.id not in wanted and each.id.rpartition(".")[0] not in plurals
    ]
