"""Which language people read in, and what our texts are in it.

English stands in the code, beside the id that a text keeps for ever; a text is asked for by both.
Each other language is a folder `languages/LANG/` of YAML files. They are of this package and of
whoever offers more by the entry point group `ros2_on_pip.languages`. They hold an id, the English
that was translated, and what it is in that language.

    graph.nothing:
      en: "Nothing runs: no node was seen."
      says: "Nichts läuft: kein Node ist zu sehen."

What stands in braces is filled in, so a translation has the same fields as its English. What has no
translation yet, or one of another English than today's, is said in English. Names of ROS, code, and
the words of cards are never translated.

What is counted has an id for each form of the plural, as CLDR names them: English has `ID.one` and
`ID.other`. A language with others says so in `language.plural`, with the rule of its gettext:

    language.plural:
      en: "one other: n != 1"
      says: "one few many: n==1 ? 0 : n%10>=2 && n%10<=4 && (n%100<10 || n%100>=20) ? 1 : 2"
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2_on_pip.errors import RoslingsError

if TYPE_CHECKING:
    import yaml

VARIABLE = "ROSLINGS_LANGUAGE"
ENGLISH = "en"
FALSE = "en_XA"
"""No language: English with accents, a third longer. It shows what was not asked for by an id."""
GROUP = "ros2_on_pip.languages"
FOLDER = "languages"
NAME = re.compile(r"([A-Za-z]{2,3})(?:[_-]([A-Za-z]{2}))?(?:\.[\w-]+)?")

_chosen: list[str] = []


class BadCatalogue(RoslingsError):
    """A file of translations says something that it may not say."""

    def __init__(self, file: Path, line: int, what: str, mend: str) -> None:
        self.file, self.line = file, line
        super().__init__(f"{file}:{line}: {what}\nNext: {mend}")


# --- what is asked for -------------------------------------------------------------------------


def language() -> str:
    """The language that was chosen here, else that of `ROSLINGS_LANGUAGE`, else English.

    As gettext writes it: `de`, `pt_BR`. What is no name of a language asks for English.
    """
    return _chosen[-1] if _chosen else named(os.environ.get(VARIABLE, ""))


def named(text: str) -> str:
    """A language's name as gettext writes it, of `pt-br` or `pt_BR.UTF-8`; else English."""
    found = NAME.fullmatch(text.strip())
    if not found:
        return ENGLISH
    return "_".join(filter(None, (found[1].lower(), (found[2] or "").upper())))


@contextmanager
def speaking(name: str) -> Iterator[None]:
    """A block whose texts are in this language, whatever the environment says."""
    _chosen.append(named(name))
    try:
        yield
    finally:
        _chosen.pop()


def speak(name: str) -> None:
    """From now on, in this process, texts are in this language."""
    _chosen[:] = [named(name)]


# --- a text ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Text:
    """One that people read. `id` and `english` are written out where it is made: who translates
    finds them there."""

    id: str
    english: str

    def __str__(self) -> str:
        return self.filled()

    def filled(self, **fields: Any) -> str:
        """In the language that is asked for, its fields filled in."""
        return template(self.id, self.english).format(**fields)


def said(id: str, english: str, /, **fields: Any) -> str:
    """The text of this id in the language that is asked for, its fields filled in."""
    return template(id, english).format(**fields)


def template(id: str, english: str, /) -> str:
    """The same, with its fields still in braces. Raises BadCatalogue."""
    wanted = language()
    if wanted == ENGLISH:
        return english
    if wanted == FALSE:
        from ros2_on_pip.false_language import false

        return false(english)
    found = catalogue(wanted).get(id)
    return found.says if found and found.is_of(english) else english


def counted(id: str, number: float, /, *, one: str, other: str, **fields: Any) -> str:
    """The form of a text that fits a number, which is the field `count` in it."""
    return form(id, number, one=one, other=other).format(count=number, **fields)


def form(id: str, number: float, /, *, one: str, other: str) -> str:
    """The same, with its fields still in braces; where a form is missing, the English one."""
    english = {"one": one, "other": other}["one" if number == 1 else "other"]
    if language() in (ENGLISH, FALSE):
        return template(id, english)
    found = catalogue(language())
    own = (found.get(f"{id}.{name}") for name in (category(number), "other"))
    return next((each.says for each in own if each and each.is_of(one, other)), english)


def category(number: float) -> str:
    """Which form of the plural a number takes in the language that is asked for."""
    names, rule = _plural(language())
    return names[min(rule(int(number)), len(names) - 1)]


@cache
def _plural(name: str) -> tuple[list[str], Callable[[int], int]]:
    """The names of a language's forms, and which of them a number takes. Raises BadCatalogue."""
    from gettext import c2py  # the reader of the rules in .po files

    own = catalogue(name).get(PLURAL.id) if name != ENGLISH else None
    text = own.says if own and own.says else PLURAL.english
    names, _, rule = text.partition(":")
    try:
        return names.split(), c2py(rule)
    except ValueError as error:
        assert own  # the English one can be read
        mend = "Write the names of its forms, a colon, and the rule of its .po files."
        raise BadCatalogue(own.file, own.line, f"{PLURAL.id!r}: {error}.", mend) from error


def fields_of(text: str) -> frozenset[str] | None:
    """The names in braces; None for a text that is no template, such as one with code in it."""
    try:
        return frozenset(_fields(text))
    except ValueError:
        return None


def _fields(text: str) -> Iterator[str]:
    from string import Formatter  # what is said in English needs none

    for _, name, form, _ in Formatter().parse(text):
        if name is not None:
            yield name
        yield from _fields(form) if form and "{" in form else ()


def _fit(says: str, english: str) -> bool:
    """Whether a translation can be filled in as its English."""
    fields = fields_of(english)
    return fields is None or fields_of(says) == fields


PLURAL = Text("language.plural", "one other: n != 1")
"""The forms of the plural, as CLDR names them, and the rule that gives a number's place in them."""


# --- the files of a language -------------------------------------------------------------------


@dataclass(frozen=True)
class Translation:
    """One entry of a file."""

    id: str
    english: str
    """What was translated. Where the code says something else by now, the translation is not
    believed: who translates looks at it again."""
    says: str
    """Empty: not translated yet."""
    file: Path
    line: int

    def is_of(self, *english: str) -> bool:
        """Whether it is there, and is a translation of this English: of today's, not of before."""
        return bool(self.says) and self.english in english


@cache
def catalogue(name: str) -> dict[str, Translation]:
    """All entries of a language by their ids. Raises BadCatalogue."""
    from importlib.util import find_spec

    found: dict[str, Translation] = {}
    if find_spec("yaml") is None:  # nothing is installed yet: who speaks then does so in English
        return found
    for file in (file for folder in folders() for file in sorted((folder / name).glob("*.yaml"))):
        for each in read(file):
            if twin := found.get(each.id):
                mend = f"Delete one; the other stands in {twin.file}:{twin.line}."
                raise BadCatalogue(file, each.line, f"{each.id!r} is there twice.", mend)
            found[each.id] = each
    return found


def folders() -> Iterator[Path]:
    """Every folder that may hold languages."""
    from importlib.metadata import entry_points  # takes long to load, and English needs none

    yield Path(__file__).with_name(FOLDER)
    for point in entry_points(group=GROUP):
        offered: Callable[[], Iterator[Path]] = point.load()
        yield from offered()


def read(file: Path) -> Iterator[Translation]:
    """The entries of one file. Raises BadCatalogue."""
    import yaml  # English needs none

    tree = _composed(file)
    if tree is None:
        return
    if not isinstance(tree, yaml.MappingNode):
        raise BadCatalogue(file, 1, "This is no list of ids.", "Write ID: {en: ..., says: ...}.")
    for key, entry in tree.value:
        yield _checked(_entry(file, key, entry))


def _composed(file: Path) -> yaml.Node | None:
    import yaml

    try:
        return yaml.compose(file.read_text("utf-8"), Loader=yaml.SafeLoader)
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        mark = getattr(error, "problem_mark", None)
        what = getattr(error, "problem", None) or "it is not UTF-8 text"
        mend = "Look at this line and the one above. A text with ': ' in it needs quotes round it."
        raise BadCatalogue(file, mark.line + 1 if mark else 1, f"{what}.", mend) from error


def _entry(file: Path, key: yaml.Node, entry: yaml.Node) -> Translation:
    line = key.start_mark.line + 1
    pairs = entry.value if isinstance(entry.value, list) else []
    words = {word.value: value.value for word, value in pairs if isinstance(value.value, str)}
    if set(words) != {"en", "says"} or len(pairs) != len(words):
        what = f"{key.value!r} has not just 'en' and 'says'."
        raise BadCatalogue(file, line, what, "Give each entry the two texts, and nothing else.")
    return Translation(key.value, words["en"], words["says"], file, line)


def _checked(entry: Translation) -> Translation:
    """The entry, if its translation can be filled in as its English. Raises BadCatalogue."""
    if not entry.says or _fit(entry.says, entry.english):
        return entry
    wanted, found = fields_of(entry.english) or frozenset(), fields_of(entry.says)
    if found is None:
        what = f"{entry.id!r}: its braces do not close."
        raise BadCatalogue(entry.file, entry.line, what, "Write each field as {name}.")
    what = f"{entry.id!r} has the fields {_listed(found)}; its English has {_listed(wanted)}."
    raise BadCatalogue(entry.file, entry.line, what, "Copy what stands in braces as it is.")


def _listed(fields: frozenset[str]) -> str:
    return ", ".join(f"{{{name}}}" for name in sorted(fields)) or "none"
