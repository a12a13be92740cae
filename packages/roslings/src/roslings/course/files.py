"""Read one YAML file of the course into a model; name file and line of whatever is wrong."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from ros2_on_pip.errors import RoslingsError

if TYPE_CHECKING:
    import yaml
    from pydantic import BaseModel

Model = TypeVar("Model", bound="BaseModel")
Asked = TypeVar("Asked")
Location = tuple[int | str, ...]


class CourseError(RoslingsError):
    """The course's own files are at fault, not the student."""


class NoSuchLab(CourseError):
    """The lab that was asked for does not exist."""


class NoSolution(CourseError):
    """This edition has no solutions."""

    def __init__(self, lab: str) -> None:
        super().__init__(
            f"This is the students' edition: the solution of {lab!r} is not in it.\n"
            "See a solution graded: ./roslings check example --solution\n"
            f"Or begin your own: ./roslings start {lab}"
        )


class BadCourseFile(CourseError):
    """A file of the course says something that it may not say."""

    def __init__(self, path: Path, line: int, problem: str) -> None:
        self.path, self.line, self.problem = path, line, problem
        super().__init__(f"{path}:{line}: {problem}")


@cache
def loader() -> type[yaml.SafeLoader]:
    """A card is read several times in one grading; in C that takes a tenth of the time."""
    import yaml

    found: type[yaml.SafeLoader] = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    return found


def read_yaml(path: Path, model: type[Model]) -> Model:
    """Read `path` as `model`.

    Raises BadCourseFile with the line where the first mistake stands.
    """
    from pydantic import ValidationError

    try:
        return model.model_validate(read_tree(path))
    except ValidationError as error:
        first = error.errors()[0]
        problem = f"{'.'.join(map(str, first['loc']))}: {first['msg']}"
        raise BadCourseFile(path, line_in(path, first["loc"]), problem) from error


def read_tree(path: Path) -> Any:
    """What YAML reads from `path`, in no model yet. Raises BadCourseFile."""
    import yaml

    try:
        return yaml.load(text_of(path), Loader=loader())
    except yaml.YAMLError as error:
        raise _bad_yaml(path, error) from error


def line_in(path: Path, location: Location) -> int:
    """The line in which a value of a YAML file begins."""
    import yaml

    return _line_of(yaml.compose(text_of(path), Loader=loader()), location)


def text_of(path: Path) -> str:
    """What stands in a file of the course. Raises BadCourseFile."""
    try:
        return path.read_text("utf-8")
    except FileNotFoundError:
        raise BadCourseFile(path, 1, "this file is missing") from None
    except UnicodeDecodeError as error:
        raise BadCourseFile(path, 1, "this is not UTF-8 text") from error


def _bad_yaml(path: Path, error: yaml.YAMLError) -> BadCourseFile:
    mark = getattr(error, "problem_mark", None)
    problem = getattr(error, "problem", None) or str(error)
    return BadCourseFile(path, mark.line + 1 if mark else 1, problem)


def _line_of(tree: yaml.Node | None, location: Location) -> int:
    """The line of the deepest part of `location` that the file really has."""
    line = 1
    node = tree
    for step in location:
        if node is None:
            break
        line = node.start_mark.line + 1
        node = child_of(node, step)
    return node.start_mark.line + 1 if node is not None else line


def child_of(node: yaml.Node, step: int | str) -> yaml.Node | None:
    """The part of a YAML tree that one step leads to; None where there is none."""
    import yaml

    if isinstance(node, yaml.MappingNode):
        return next((value for key, value in node.value if key.value == str(step)), None)
    if isinstance(node, yaml.SequenceNode) and isinstance(step, int) and step < len(node.value):
        child: yaml.Node = node.value[step]
        return child
    return None


def written(value: Asked | None, where: str) -> Asked:
    """What the card says. Raises CourseError where it says nothing and a check asks."""
    if value is None:
        raise CourseError(f"the card says nothing of this for {where}")
    return value
