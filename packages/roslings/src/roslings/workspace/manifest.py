"""Read package.xml: what it says, and what is wrong with it. Nothing is run."""

from __future__ import annotations

import re
from pathlib import Path
from xml.parsers import expat

from catkin_pkg.package import InvalidPackage, parse_package_string
from pydantic import BaseModel

from roslings.workspace.packages import package_name, xml_text

_DEPEND = re.compile(r"<(?:\w+_)?depend\b[^<>]*>\s*([^<>\s]+)\s*</")
_BUILD_TYPE = re.compile(r"<build_type\b[^<>]*>\s*([^<>\s]+)\s*</")


class Manifest(BaseModel):
    """What package.xml says. Name, kind and depends are found in an invalid file as well."""

    name: str
    build_type: str
    declared: list[str]
    problems: list[str]


def read_manifest(folder: Path) -> Manifest:
    """Read `folder/package.xml`. Raises CannotRead."""
    text = xml_text(folder / "package.xml")
    build_type = _BUILD_TYPE.search(text)
    return Manifest(
        name=package_name(folder),
        build_type=build_type[1] if build_type else "",
        declared=sorted(set(_DEPEND.findall(text))),
        problems=_problems(folder / "package.xml"),
    )


def _problems(path: Path) -> list[str]:
    content = path.read_bytes()
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        return [f"package.xml:{line}: this is no UTF-8 text; save the file as UTF-8"]
    return _xml_problems(text) or _package_problems(text)


def _xml_problems(text: str) -> list[str]:
    """The first place where the text is no XML."""
    if "<!DOCTYPE" in text:
        return ["package.xml has a DOCTYPE; remove it"]  # it can blow up a small file
    open_tags: list[tuple[str, int]] = []
    parser = expat.ParserCreate()
    parser.StartElementHandler = lambda tag, _: open_tags.append((tag, parser.CurrentLineNumber))
    parser.EndElementHandler = lambda _: open_tags.pop()
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        return [_xml_problem(error, open_tags)]
    return []


def _xml_problem(error: expat.ExpatError, open_tags: list[tuple[str, int]]) -> str:
    reason = expat.ErrorString(error.code)
    if reason in {"mismatched tag", "no element found"} and open_tags:
        tag, line = open_tags[-1]
        return f"package.xml:{line}: the tag <{tag}> is not closed"
    return f"package.xml:{error.lineno}: {reason}"


def _package_problems(text: str) -> list[str]:
    """What catkin_pkg, the library of ROS's own tools, has to say."""
    try:
        parse_package_string(text, warnings=[]).get_build_type()
    except InvalidPackage as error:
        return [_sentence(line) for line in _lines(error)]
    except (ValueError, AssertionError) as error:  # a format that is no number, and the like
        return [f"package.xml: {error}"]
    return []


def _lines(error: InvalidPackage) -> list[str]:
    lines = (line.strip(" -") for line in str(error.msg).splitlines())
    return [line for line in lines if line and line != "Error(s):"]


def _sentence(line: str) -> str:
    return f"package.xml: {line[0].lower()}{line[1:]}"
