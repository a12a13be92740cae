"""An XML or a YAML launch file as a tree of entities, each with its line."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.parsers import expat

from roslings.exits import NOT_READ_HERE
from roslings.ros2.launch.entity import BadLaunchFile, Entity
from roslings.ros2.problem import Problem

ROOT = "launch"
LISTS = (ROOT, "group")
"""In YAML these hold a list of elements; the others hold attributes."""


class PythonLaunchFile(Problem):
    """Only the full installation runs these."""

    exit_code = NOT_READ_HERE

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"{path.name} is a Python launch file. It needs the full ros2 on Ubuntu 24.04:"
            " sudo apt install ros-jazzy-ros-base\nLaunch files in XML and YAML run here."
        )


def read_launch_file(path: Path) -> Entity:
    """The root of the file. Raises BadLaunchFile, PythonLaunchFile."""
    if path.suffix == ".py":
        raise PythonLaunchFile(path)
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as fault:
        raise BadLaunchFile(str(path), f"cannot be read: {fault}") from None
    root = read_yaml(path, text) if path.suffix in (".yaml", ".yml") else read_xml(path, text)
    if root.tag != ROOT:
        raise BadLaunchFile(root.place, f"a launch file starts with {ROOT}, not with {root.tag}")
    return root


def read_xml(path: Path, text: str) -> Entity:
    """The root element of XML. Raises BadLaunchFile."""
    top = Entity("", path, 0)
    open_ones = [top]
    parser = expat.ParserCreate()

    def begin(tag: str, attributes: dict[str, str]) -> None:
        entity = Entity(tag.replace("-", "_"), path, parser.CurrentLineNumber, dict(attributes))
        open_ones[-1].children.append(entity)
        open_ones.append(entity)

    parser.StartElementHandler = begin
    parser.EndElementHandler = lambda _: open_ones.pop()
    try:
        parser.Parse(text, True)
    except expat.ExpatError as fault:
        reason = expat.ErrorString(fault.code)
        raise BadLaunchFile(
            f"{path.name}, line {fault.lineno}", f"no valid XML: {reason}"
        ) from None
    return top.children[0]


def read_yaml(path: Path, text: str) -> Entity:
    """The root of YAML. Raises BadLaunchFile."""
    import yaml

    try:
        node = yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as fault:
        line = fault.problem_mark.line + 1 if fault.problem_mark else 1
        raise BadLaunchFile(
            f"{path.name}, line {line}", f"no valid YAML: {fault.problem}"
        ) from None
    entities = _elements(path, node)
    if len(entities) != 1:
        raise BadLaunchFile(path.name, f"the file needs one entry at its top: {ROOT}")
    return entities[0]


def _elements(path: Path, node: Any) -> list[Entity]:
    """The elements of a YAML mapping, one for each of its keys."""
    import yaml

    if not isinstance(node, yaml.MappingNode):
        line = node.start_mark.line + 1 if node else 1
        raise BadLaunchFile(f"{path.name}, line {line}", "here a name and a colon are needed")
    return [_element(path, key.value, key.start_mark.line + 1, value) for key, value in node.value]


def _element(path: Path, tag: str, line: int, node: Any) -> Entity:
    import yaml

    entity = Entity(tag.replace("-", "_"), path, line)
    if isinstance(node, yaml.SequenceNode):
        entity.children = [one for item in node.value for one in _elements(path, item)]
    elif isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            _take(path, entity, key, value)
    return entity


def _take(path: Path, entity: Entity, key: Any, value: Any) -> None:
    """A list of mappings is elements inside; anything else is an attribute."""
    import yaml

    items = value.value if isinstance(value, yaml.SequenceNode) else []
    if items and all(isinstance(item, yaml.MappingNode) for item in items):
        line = key.start_mark.line + 1
        entity.children += [_element(path, key.value, line, item) for item in items]
    else:
        entity.attributes[key.value] = _plain(value)


def _plain(node: Any) -> Any:
    import yaml

    loader = yaml.SafeLoader("")
    try:
        value = loader.construct_object(node, deep=True)
    finally:
        loader.dispose()
    return dict(value) if isinstance(value, Mapping) else value
