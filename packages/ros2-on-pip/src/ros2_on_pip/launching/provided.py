"""The import names of Jazzy's `launch` and `launch_ros`, in the launching process alone.

Python asks the finder of this module last, so where a real package is installed, that one is taken.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from pathlib import Path
from tempfile import TemporaryDirectory
from types import ModuleType
from typing import Any

from ros2_on_pip.launching import (
    actions,
    conditions,
    context,
    description,
    elsewhere,
    events,
    handlers,
    jazzy,
    node,
    parameters,
    processes,
    sources,
    substitution,
    substitutions,
)
from ros2_on_pip.launching.places import NotReadHere, calling_place
from ros2_on_pip.launching.reading import description_in
from ros2_on_pip.launching.screen import LaunchOutput

Names = Mapping[str, Any]

LAUNCH: Names = {
    "Action": description.Action,
    "Condition": conditions.Condition,
    "Event": events.Event,
    "EventHandler": handlers.EventHandler,
    "LaunchContext": context.LaunchContext,
    "LaunchDescription": description.LaunchDescription,
    "LaunchDescriptionEntity": description.Entity,
    "LaunchDescriptionSource": sources.AnyLaunchDescriptionSource,
    "SomeSubstitutionsType": substitution.SomeSubstitutionsType,
    "Substitution": substitution.Substitution,
}
ACTIONS = (
    "AppendEnvironmentVariable",
    "DeclareLaunchArgument",
    "EmitEvent",
    "GroupAction",
    "LogInfo",
    "OpaqueFunction",
    "RegisterEventHandler",
    "SetEnvironmentVariable",
    "SetLaunchConfiguration",
    "Shutdown",
    "TimerAction",
    "UnregisterEventHandler",
    "UnsetEnvironmentVariable",
    "UnsetLaunchConfiguration",
)
ROS_ACTIONS = (
    "PushRosNamespace",
    "SetParameter",
    "SetParametersFromFile",
    "SetRemap",
    "SetUseSimTime",
)
SUBSTITUTIONS = (
    "AndSubstitution",
    "AnonName",
    "Command",
    "EnvironmentVariable",
    "EqualsSubstitution",
    "FileContent",
    "FindExecutable",
    "IfElseSubstitution",
    "LaunchConfiguration",
    "LaunchLogDir",
    "LocalSubstitution",
    "NotEqualsSubstitution",
    "NotSubstitution",
    "OrSubstitution",
    "PathJoinSubstitution",
    "PathSubstitution",
    "PythonExpression",
    "ThisLaunchFile",
    "ThisLaunchFileDir",
)
CONDITIONS = (
    "IfCondition",
    "LaunchConfigurationEquals",
    "LaunchConfigurationNotEquals",
    "UnlessCondition",
)
HANDLERS = (
    "OnExecutionComplete",
    "OnProcessExit",
    "OnProcessIO",
    "OnProcessStart",
    "OnShutdown",
)


def _from(module: ModuleType, names: Sequence[str]) -> dict[str, Any]:
    return {name: getattr(module, name) for name in names}


@cache
def modules() -> dict[str, Names]:
    """Name of a module of Jazzy's to what of it a launch file can import from it here.

    A module of which we have nothing is left out, except where others lie in it.
    """
    offered = {module: _ours(module, names) for module, names in jazzy.MODULES.items()}
    return {m: names for m, names in offered.items() if names or _holds_another(m, offered)}


def _ours(module: str, names: Sequence[str]) -> Names:
    """What we have of `names`; a module apart has what its package exports."""
    home = module if module in _packages() else module.rpartition(".")[0]
    here = _packages().get(home, {})
    return {name: here[name] for name in names if name in here}


def _holds_another(module: str, offered: Mapping[str, Names]) -> bool:
    return any(names and other.startswith(f"{module}.") for other, names in offered.items())


@cache
def _packages() -> dict[str, Names]:
    """Name of a package to all that we have of it."""
    described = {
        "Parameter": parameters.Parameter,
        "ParameterFile": parameters.ParameterFile,
        "ParameterValue": parameters.ParameterValue,
    }
    return {
        "launch": LAUNCH,
        "launch.actions": _from(actions, ACTIONS)
        | {
            "ExecuteProcess": processes.ExecuteProcess,
            "IncludeLaunchDescription": sources.IncludeLaunchDescription,
        },
        "launch.conditions": _from(conditions, CONDITIONS),
        "launch.event_handlers": _from(handlers, HANDLERS),
        "launch.events": {
            "ExecutionComplete": events.ExecutionComplete,
            "Shutdown": events.Shutdown,
        },
        "launch.events.process": _from(events, ("ProcessExited", "ProcessIO", "ProcessStarted")),
        "launch.launch_description_sources": _from(
            sources, ("AnyLaunchDescriptionSource", "PythonLaunchDescriptionSource")
        )
        | {"FrontendLaunchDescriptionSource": sources.AnyLaunchDescriptionSource},
        "launch.substitutions": _from(substitutions, SUBSTITUTIONS)
        | {
            "SubstitutionFailure": substitution.SubstitutionFailure,
            "TextSubstitution": substitution.TextSubstitution,
        },
        "launch.utilities": {
            "normalize_to_list_of_substitutions": _normalized,
            "perform_substitutions": substitution.performed,
        },
        "launch_ros.actions": _from(actions, ROS_ACTIONS)
        | {"Node": node.Node, "PushROSNamespace": actions.PushRosNamespace},
        "launch_ros.descriptions": described,
        "launch_ros.parameter_descriptions": described,
        "launch_ros.substitutions": _from(
            substitutions, ("ExecutableInPackage", "FindPackagePrefix", "FindPackageShare")
        )
        | {"FindPackage": substitutions.FindPackagePrefix},
        "launch_xml.launch_description_sources": _from(sources, ("XMLLaunchDescriptionSource",)),
        "launch_yaml.launch_description_sources": _from(sources, ("YAMLLaunchDescriptionSource",)),
    }


def _normalized(parts: Any) -> substitution.Parts:
    return substitution.parts_of(parts, "a text")


@cache
def _room() -> TemporaryDirectory[str]:
    """It goes when the program ends."""
    return TemporaryDirectory(prefix="roslings_launch_")


def _around_by_hand() -> context.Around:
    return context.Around(LaunchOutput(), Path(_room().name), description_in)


context.LaunchContext.by_hand = _around_by_hand


class ProvidedModuleFinder(MetaPathFinder, Loader):
    """Finds our modules where nobody else has found one of that name."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Where the module comes from; None for those that are not ours."""
        return ModuleSpec(fullname, self, is_package=True) if fullname in modules() else None

    def exec_module(self, module: ModuleType) -> None:
        """Put the names into the module; what is not there yet is found when it is asked for."""
        name = module.__name__
        vars(module).update(modules()[name])
        vars(module)["__getattr__"] = _found_in(name)
        vars(module)["__all__"] = [*modules()[name], *_inside(name)]


def _inside(package: str) -> list[str]:
    """The packages that lie in `package` itself."""
    parted = (name.rpartition(".") for name in jazzy.PACKAGES if name in modules())
    return [name for outer, _, name in parted if outer == package]


def _found_in(module: str) -> Callable[[str], Any]:
    """What is asked of `module` later: the real one imports its parts, and ours does it then."""

    def found(name: str) -> Any:
        if f"{module}.{name}" in modules():
            return import_module(f"{module}.{name}")
        if jazzy.has(module, name) or name in elsewhere.NAMES:
            raise NotReadHere(calling_place(), f"'{name}'", elsewhere.instead_of(module, name))
        raise AttributeError(f"module '{module}' has no attribute '{name}'", name=name)

    return found


_offer = ProvidedModuleFinder()


def offer() -> None:
    """From now on launch files can import them."""
    elsewhere.know(modules())
    if _offer not in sys.meta_path:
        sys.meta_path.append(_offer)
