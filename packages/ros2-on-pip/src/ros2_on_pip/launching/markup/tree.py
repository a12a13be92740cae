"""An XML or a YAML launch file as a tree of elements, each with its line."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.parsers import expat

from ros2_on_pip.launching.places import BadLaunchFile, LaunchFileLine

ROOT = "launch"


@dataclass
class Element:
    """A tag with its attributes and the elements inside it."""

    tag: str
    place: LaunchFileLine
    attributes: dict[str, Any] = field(default_factory=dict)
    children: list[Element] = field(default_factory=list)

    def inside(self, tag: str) -> list[Element]:
        """The elements of one kind inside it."""
        return [child for child in self.children if child.tag == tag]


def read(file: Path, kind: str) -> Element:
    """The root of the file; `kind` is XML or YAML. Raises BadLaunchFile."""
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as fault:
        raise BadLaunchFile(str(file), f"cannot be read: {fault}") from None
    root = read_yaml(file, text) if kind == "YAML" else read_xml(file, text)
    if root.tag != ROOT:
        raise BadLaunchFile(root.place, f"a launch file starts with {ROOT}, not with {root.tag}")
    return root


def read_xml(file: Path, text: str) -> Element:
    """The root element of XML. Raises BadLaunchFile."""
    top = Element("", LaunchFileLine(file, 0))
    open_ones = [top]
    parser = expat.ParserCreate()

    def begin(tag: str, attributes: dict[str, str]) -> None:
        place = LaunchFileLine(file, parser.CurrentLineNumber)
        element = Element(tag, place, dict(attributes))
        open_ones[-1].children.append(element)
        open_ones.append(element)

    parser.StartElementHandler = begin
    parser.EndElementHandler = lambda _: open_ones.pop()
    try:
        parser.Parse(text, True)
    except expat.ExpatError as fault:
        reason = expat.ErrorString(fault.code)
        raise BadLaunchFile(LaunchFileLine(file, fault.lineno), f"no valid XML: {reason}") from None
    return top.children[0]


def read_yaml(file: Path, text: str) -> Element:
    """The root of YAML. Raises BadLaunchFile."""
    import yaml

    try:
        node = yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as fault:
        line = fault.problem_mark.line + 1 if fault.problem_mark else 1
        raise BadLaunchFile(LaunchFileLine(file, line), f"no valid YAML: {fault.problem}") from None
    elements = _elements(file, node)
    if len(elements) != 1:
        raise BadLaunchFile(file.name, f"the file needs one entry at its top: {ROOT}")
    return elements[0]


def _elements(file: Path, node: Any) -> list[Element]:
    """The elements of a YAML mapping, one for each of its keys."""
    import yaml

    if not isinstance(node, yaml.MappingNode):
        line = node.start_mark.line + 1 if node else 1
        raise BadLaunchFile(LaunchFileLine(file, line), "here a name and a colon are needed")
    return [_element(file, key.value, key.start_mark.line + 1, value) for key, value in node.value]


def _element(file: Path, tag: str, line: int, node: Any) -> Element:
    import yaml

    element = Element(tag, LaunchFileLine(file, line))
    if isinstance(node, yaml.SequenceNode):
        element.children = [one for item in node.value for one in _elements(file, item)]
    elif isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            _take(file, element, key, value)
    return element


def _take(file: Path, element: Element, key: Any, value: Any) -> None:
    """A list of mappings is elements inside; anything else is an attribute."""
    import yaml

    is_list = isinstance(value, yaml.SequenceNode)
    items = value.value if is_list else []
    inside = is_list and key.value == "children"  # `timer: {period: 1.0, children: [...]}`
    if inside or (items and all(isinstance(item, yaml.MappingNode) for item in items)):
        line = key.start_mark.line + 1
        if inside:
            element.children += [one for item in items for one in _elements(file, item)]
        else:
            element.children += [_element(file, key.value, line, item) for item in items]
    else:
        element.attributes[key.value] = _plain(value)


def _plain(node: Any) -> Any:
    import yaml

    loader = yaml.SafeLoader("")
    try:
        value = loader.construct_object(node, deep=True)
    finally:
        loader.dispose()
    return dict(value) if isinstance(value, Mapping) else value
