"""A launch file in Python, XML or YAML becomes a launch description."""

from __future__ import annotations

from pathlib import Path

from ros2_on_pip.launching.description import LaunchDescription
from ros2_on_pip.launching.markup import description_of
from ros2_on_pip.launching.places import BadLaunchFile
from ros2_on_pip.launching.python_file import described_by

MARKUP = {".xml": "XML", ".yaml": "YAML", ".yml": "YAML"}


def description_in(file: Path, kind: str) -> LaunchDescription:
    """What a launch file asks for; its ending says the language where `kind` does not.

    Raises BadLaunchFile, NotReadHere.
    """
    if not file.is_file():
        raise BadLaunchFile(str(file), "there is no such launch file")
    kind = kind or ("Python" if file.suffix == ".py" else MARKUP.get(file.suffix, "XML"))
    if kind == "Python":
        return described_by(file)
    return description_of(file, kind)
