"""Where launch descriptions come from: files in Python, XML and YAML, and what includes them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching.actions import MissingArgument, SetLaunchConfiguration
from ros2_on_pip.launching.arguments import required_arguments_of
from ros2_on_pip.launching.description import Action, Entity, LaunchDescription
from ros2_on_pip.launching.places import BadLaunchFile
from ros2_on_pip.launching.substitution import (
    SomeSubstitutionsType,
    SubstitutionFailure,
    described,
    parts_of,
    performed,
)

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext


class AnyLaunchDescriptionSource:
    """A launch file in any language."""

    kind = ""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        self.location = parts_of(launch_file_path, f"the file of {type(self).__name__}")

    def path(self, context: LaunchContext) -> Path:
        """The file. Raises SubstitutionFailure where there is none."""
        file = Path(performed(context, self.location)).absolute()
        if not file.is_file():
            raise SubstitutionFailure(
                f"there is no launch file {file}. A file of a package must be installed: add it to"
                " data_files in setup.py, and build again"
            )
        return file

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """What the file asks for. Raises BadLaunchFile, SubstitutionFailure."""
        found: LaunchDescription = context.description_in(self.path(context), self.kind)
        return found

    def describe(self) -> str:
        """The file."""
        return described(self.location)


class PythonLaunchDescriptionSource(AnyLaunchDescriptionSource):
    """A launch file in Python."""

    kind = "Python"


class XMLLaunchDescriptionSource(AnyLaunchDescriptionSource):
    """A launch file in XML."""

    kind = "XML"


class YAMLLaunchDescriptionSource(AnyLaunchDescriptionSource):
    """A launch file in YAML."""

    kind = "YAML"


class IncludeLaunchDescription(Action):
    """Carry out another launch file; its arguments stay set afterwards, as in Jazzy."""

    def __init__(
        self,
        launch_description_source: Any,
        *,
        launch_arguments: Iterable[tuple[Any, Any]] | Mapping[Any, Any] | None = None,
        **others: Any,
    ) -> None:
        super().__init__(**others)
        source = launch_description_source
        if isinstance(source, AnyLaunchDescriptionSource):
            self.source = source
        else:
            self.source = AnyLaunchDescriptionSource(source)
        given = launch_arguments or ()
        if isinstance(given, Mapping):
            raise TypeError("launch_arguments takes pairs: launch_arguments={...}.items()")
        self.launch_arguments = [SetLaunchConfiguration(name, value) for name, value in given]

    def execute(self, context: LaunchContext) -> Iterable[Entity]:
        """Set the arguments, then carry out the file."""
        file = self.source.path(context)
        description = self.source.get_launch_description(context)
        self._require_arguments(context, description)
        yield from self.launch_arguments
        with context.reading(file):
            yield description

    def _require_arguments(self, context: LaunchContext, description: LaunchDescription) -> None:
        """Raises BadLaunchFile before anything is set, or carried out.

        A configuration of the surroundings is not enough, in Jazzy neither.
        """
        given = [performed(context, each.name) for each in self.launch_arguments]
        for argument in required_arguments_of(description):
            if argument.name not in given:
                around = argument.name in context.launch_configurations
                missing = MissingArgument(argument.name, argument.description, around)
                raise BadLaunchFile(argument.place, str(missing))

    def inner(self) -> list[Entity]:
        """The arguments that it sets."""
        return list(self.launch_arguments)

    def details(self) -> str:
        """The file."""
        return self.source.describe()
