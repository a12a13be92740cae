"""The import names of Jazzy's `launch` and `launch_ros`, in the launching process alone.

Python asks the finder of this module last, so where a real package is installed, that one is taken.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from roslings.ros2.launching import (
    actions,
    conditions,
    context,
    description,
    elsewhere,
    events,
    handlers,
    node,
    parameters,
    processes,
    sources,
    substitution,
    substitutions,
)
from roslings.ros2.launching.places import NotReadHere, calling_place

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
    "AppendEnvironmentVariable", "DeclareLaunchArgument", "EmitEvent", "GroupAction", "LogInfo",
    "OpaqueFunction", "RegisterEventHandler", "SetEnvironmentVariable", "SetLaunchConfiguration",
    "Shutdown", "TimerAction", "UnregisterEventHandler", "UnsetEnvironmentVariable",
    "UnsetLaunchConfiguration",
)  # fmt: skip
ROS_ACTIONS = (
    "PushRosNamespace", "SetParameter", "SetParametersFromFile", "SetRemap", "SetUseSimTime",
)  # fmt: skip
SUBSTITUTIONS = (
    "AndSubstitution", "AnonName", "Command", "EnvironmentVariable", "EqualsSubstitution",
    "FileContent", "FindExecutable", "IfElseSubstitution", "LaunchConfiguration", "LaunchLogDir",
    "LocalSubstitution", "NotEqualsSubstitution", "NotSubstitution", "OrSubstitution",
    "PathJoinSubstitution", "PythonExpression", "ThisLaunchFile", "ThisLaunchFileDir",
)  # fmt: skip
CONDITIONS = (
    "IfCondition", "LaunchConfigurationEquals", "LaunchConfigurationNotEquals", "UnlessCondition",
)  # fmt: skip
HANDLERS = (
    "OnExecutionComplete", "OnProcessExit", "OnProcessIO", "OnProcessStart", "OnShutdown",
)  # fmt: skip


def _from(module: ModuleType, names: Sequence[str]) -> dict[str, Any]:
    return {name: getattr(module, name) for name in names}


@cache
def modules() -> dict[str, Names]:
    """Name of a module to what a launch file can import from it."""
    described = {
        "Parameter": parameters.Parameter,
        "ParameterFile": parameters.ParameterFile,
        "ParameterValue": parameters.ParameterValue,
    }
    packages: dict[str, Names] = {
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
        "launch_ros.actions": _from(actions, ROS_ACTIONS)
        | {"Node": node.Node, "PushROSNamespace": actions.PushRosNamespace},
        "launch_ros.descriptions": described,
        "launch_ros.substitutions": _from(
            substitutions, ("ExecutableInPackage", "FindPackagePrefix", "FindPackageShare")
        )
        | {"FindPackage": substitutions.FindPackagePrefix},
        "launch_xml.launch_description_sources": _from(sources, ("XMLLaunchDescriptionSource",)),
        "launch_yaml.launch_description_sources": _from(sources, ("YAMLLaunchDescriptionSource",)),
    }
    whole: dict[str, Names] = {
        "launch.utilities": {
            "normalize_to_list_of_substitutions": _normalized,
            "perform_substitutions": substitution.performed,
        },
        "launch_ros": {},
        "launch_ros.parameter_descriptions": described,
        "launch_xml": {},
        "launch_yaml": {},
    }
    return packages | whole | _single(packages)


def _normalized(parts: Any) -> substitution.Parts:
    return substitution.parts_of(parts, "a text")


def _single(packages: Mapping[str, Names]) -> dict[str, Names]:
    """The module that each class has to itself: `launch.actions.timer_action`."""
    found: dict[str, Names] = {}
    for package, names in packages.items():
        for name, value in names.items():
            found.setdefault(f"{package}.{snake(name)}", {name: value})
    return found


def snake(name: str) -> str:
    """`TimerAction` as `timer_action`."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


class Offer(MetaPathFinder, Loader):
    """Finds our modules where nobody else has found one of that name."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Where the module comes from; None for those that are not ours."""
        return ModuleSpec(fullname, self, is_package=True) if fullname in modules() else None

    def exec_module(self, module: ModuleType) -> None:
        """Put the names into the module, those of the real one that are missing too."""
        vars(module).update(modules()[module.__name__])
        vars(module)["__getattr__"] = _missing_from(module.__name__)


def _missing_from(module: str) -> Callable[[str], Any]:
    def missing(name: str) -> Any:
        if name in elsewhere.NAMES:
            raise NotReadHere(calling_place(), f"'{name}'", elsewhere.NAMES[name])
        raise AttributeError(f"module '{module}' has no attribute '{name}'", name=name)

    return missing


_offer = Offer()


def offer() -> None:
    """From now on launch files can import them."""
    elsewhere.know(modules())
    if _offer not in sys.meta_path:
        sys.meta_path.append(_offer)
