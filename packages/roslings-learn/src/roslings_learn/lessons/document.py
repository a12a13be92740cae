"""One YAML file of the lessons, read into a model, that still knows on which line each part is."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

import yaml
from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic_core import ErrorDetails

from ros2_on_pip.errors import RoslingsError
from roslings.course.files import child_of, loader

Location = tuple[int | str, ...]


class DocumentPart(BaseModel):
    """A part of a file; an unknown word in it is a mistake, not a comment."""

    model_config = ConfigDict(frozen=True, extra="forbid", str_strip_whitespace=True)


Model = TypeVar("Model", bound=BaseModel)


@dataclass(frozen=True, order=True)
class DocumentProblem:
    """One mistake in a file: where it is, what it is, how to mend it."""

    path: Path
    line: int
    what: str
    mend: str

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.what}\n    Mend: {self.mend}"


class BadLessons(RoslingsError):
    """Files of the lessons say what they may not say. Carries every problem found."""

    def __init__(self, problems: list[DocumentProblem]) -> None:
        self.problems = tuple(sorted(set(problems)))
        super().__init__("\n".join(str(problem) for problem in self.problems))


@dataclass(frozen=True)
class Document(Generic[Model]):
    """A file that could be read: its content, and the line of each part."""

    path: Path
    content: Model
    tree: yaml.Node

    def line(self, *location: int | str) -> int:
        """The line, counted from 1, of the deepest part of `location` that is there."""
        return line_of(self.tree, location)

    def line_with(self, text: str) -> int:
        """The line of the first value that holds `text`; 1 where none does."""
        return next(
            (node.start_mark.line + 1 for node in _texts(self.tree) if text in node.value), 1
        )

    def problem(self, what: str, mend: str, *location: int | str) -> DocumentProblem:
        """A problem at a place of this file."""
        return DocumentProblem(self.path, self.line(*location), what, mend)


def read(path: Path, model: type[Model]) -> Document[Model]:
    """Read `path` as `model`. Raises BadLessons with all that is wrong with its form."""
    tree = _compose(path)
    twins = list(_doubled_keys(path, tree))
    if twins:
        raise BadLessons(twins)
    try:
        content = model.model_validate(_values(path, tree))
    except ValidationError as error:
        raise BadLessons([_as_problem(path, tree, each) for each in error.errors()]) from error
    return Document(path, content, tree)


def _compose(path: Path) -> yaml.Node:
    try:
        tree = _composed(path.read_text("utf-8"))
    except FileNotFoundError:
        mend = "Write the file, or bring it back with git."
        raise BadLessons([DocumentProblem(path, 1, "This file is missing.", mend)]) from None
    except UnicodeDecodeError as error:
        mend = "Save it as UTF-8 in your editor."
        raise BadLessons([DocumentProblem(path, 1, "This is not UTF-8 text.", mend)]) from error
    except yaml.YAMLError as error:
        raise BadLessons([_as_yaml_problem(path, error)]) from error
    if tree is None:
        raise BadLessons(
            [DocumentProblem(path, 1, "This file is empty.", "Write its first entry.")]
        )
    return tree


def _composed(text: str) -> yaml.Node | None:
    """Read in C, which takes a tenth of the time. What is wrong is told by the reader in Python.

    Raises yaml.YAMLError.
    """
    try:
        return yaml.compose(text, Loader=loader())
    except yaml.YAMLError:
        return yaml.compose(text, Loader=yaml.SafeLoader)


def _values(path: Path, tree: yaml.Node) -> Any:
    try:
        return yaml.SafeLoader("").construct_document(tree)
    except yaml.YAMLError as error:
        raise BadLessons([_as_yaml_problem(path, error)]) from error


def _as_yaml_problem(path: Path, error: yaml.YAMLError) -> DocumentProblem:
    said = getattr(error, "problem", None) or "it cannot be read"
    mend = "Look at this line and the one above. A text with ': ' in it needs quotes round it."
    return DocumentProblem(path, _line_of_mark(error), f"This is not YAML: {said}.", mend)


def _line_of_mark(error: yaml.YAMLError) -> int:
    """A quote that is never closed is found at the end of the file; its begin is of more use."""
    unclosed = "quoted scalar" in (getattr(error, "context", None) or "")
    mark = getattr(error, "context_mark" if unclosed else "problem_mark", None)
    return mark.line + 1 if mark else 1


def _doubled_keys(path: Path, node: yaml.Node) -> Iterator[DocumentProblem]:
    """YAML's reader takes the last of two equal keys and says nothing."""
    if isinstance(node, yaml.MappingNode):
        seen = set[str]()
        for key, value in node.value:
            if key.value in seen:
                line = key.start_mark.line + 1
                yield DocumentProblem(
                    path, line, f"The key '{key.value}' is there twice.", "Delete one."
                )
            seen.add(key.value)
            yield from _doubled_keys(path, value)
    elif isinstance(node, yaml.SequenceNode):
        for child in node.value:
            yield from _doubled_keys(path, child)


def _texts(node: yaml.Node) -> Iterator[yaml.ScalarNode]:
    if isinstance(node, yaml.ScalarNode):
        yield node
    elif isinstance(node, yaml.MappingNode):
        for _, value in node.value:
            yield from _texts(value)
    elif isinstance(node, yaml.SequenceNode):
        for child in node.value:
            yield from _texts(child)


def _as_problem(path: Path, tree: yaml.Node, error: ErrorDetails) -> DocumentProblem:
    place = error["loc"]
    name = str(place[-1]) if place else "the file"
    line = line_of(tree, place)
    if error["type"] == "missing":
        return DocumentProblem(
            path, line, f"'{name}' is missing.", f"Add a line '{name}: ...' here."
        )
    if error["type"] == "extra_forbidden":
        mend = "Correct its spelling, or delete the line."
        return DocumentProblem(path, line, f"'{name}' is not a word of this file.", mend)
    if " | " in error["msg"]:  # our own words: what, and how to mend it
        what, _, mend = error["msg"].removeprefix("Value error, ").partition(" | ")
        return DocumentProblem(path, line, what, mend)
    return DocumentProblem(path, line, f"'{name}': {error['msg']}.", "Write a value of this kind.")


def line_of(tree: yaml.Node, location: Location) -> int:
    """The line of the deepest part of `location` that the file has.

    A step that the file does not have is passed over: pydantic names kinds of questions too.
    """
    node = tree
    for step in location:
        node = child_of(node, step) or node
    return node.start_mark.line + 1


def nearest(wanted: str, known: list[str], kind: str) -> str:
    """The mend for an id that does not exist."""
    near = difflib.get_close_matches(wanted, known, n=1)
    return f"Did you mean '{near[0]}'?" if near else f"Use the id of a {kind} that exists."
