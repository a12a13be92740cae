"""What Jazzy's launch files can say, and ours cannot: what to use here instead.

`jazzy.py` has all names; here stand those for which something can be used.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ros2_on_pip.launching import jazzy

EACH_NODE = "a Node(...) for each node"
LIFECYCLE = "Node(...), and in a terminal ros2 lifecycle set NODE configure"
END = "Shutdown() of launch.actions, which ends all"
GROUP = "GroupAction(...), which keeps inside what is set inside"
LOOP = "a for loop of Python that makes a list of actions"
LOG = "LogInfo(msg=...)"

NAMES = {
    "ComposableNode": EACH_NODE,
    "ComposableNodeContainer": EACH_NODE,
    "ComposableLifecycleNode": EACH_NODE,
    "LoadComposableNodes": EACH_NODE,
    "LifecycleNode": LIFECYCLE,
    "LifecycleTransition": LIFECYCLE,
    "ChangeState": LIFECYCLE,
    "OnStateTransition": LIFECYCLE,
    "RosTimer": "TimerAction(period=..., actions=[...])",
    "ROSTimer": "TimerAction(period=..., actions=[...])",
    "SetROSLogDir": "SetEnvironmentVariable('ROS_LOG_DIR', ...)",
    "ExecuteLocal": "ExecuteProcess(cmd=[...])",
    "Executable": "ExecuteProcess(cmd=[...])",
    "OpaqueCoroutine": "OpaqueFunction(function=...)",
    "ForEach": LOOP,
    "ForLoop": LOOP,
    "ForEachVar": LOOP,
    "ForLoopIndex": LOOP,
    "PushEnvironment": GROUP,
    "PopEnvironment": GROUP,
    "ResetEnvironment": GROUP,
    "ReplaceEnvironmentVariables": GROUP,
    "PushLaunchConfigurations": GROUP,
    "PopLaunchConfigurations": GROUP,
    "ResetLaunchConfigurations": GROUP,
    "ShutdownProcess": END,
    "SignalProcess": END,
    "OnIncludeLaunchDescription": "OpaqueFunction(function=...) behind the include",
    "LaunchService": "the command ros2 launch",
    "LaunchIntrospector": "ros2 launch --print",
    "Log": LOG,
    "LogDebug": LOG,
    "LogWarning": LOG,
    "LogError": LOG,
    "AllSubstitution": "AndSubstitution(left, right)",
    "AnySubstitution": "OrSubstitution(left, right)",
}
"""A name that Jazzy has, to what to use here."""

MODULES = {
    "launch.logging": LOG,
    "launch.frontend": "a launch file in Python, XML or YAML",
    "launch_ros.event_handlers": LIFECYCLE,
    "launch_ros.events": LIFECYCLE,
    "launch_testing": "pytest, and nodes that it starts",
    "launch_testing_ros": "pytest, and nodes that it starts",
    "launch_param_builder": "parameters=[{...}] of Node",
    "moveit_configs_utils": "",
    "nav2_common": "",
    "nav2_common.launch": "",
}
"""A module that Jazzy has, to what to use here."""

ELEMENTS = {
    "for": "a launch file in Python with a for loop",
    "for_each": "a launch file in Python with a for loop",
    "lifecycle_node": "node, and in a terminal ros2 lifecycle set NODE configure",
    "lifecycle_transition": "in a terminal ros2 lifecycle set NODE TRANSITION",
    "load_composable_node": "node",
    "node_container": "node",
    "composable_node": "node",
    "pop_env": "group",
    "push_env": "group",
    "reset_env": "group",
    "pop_vars": "group",
    "push_vars": "group",
    "reset": "group",
    "ros_timer": "timer",
    "set_ros_log_dir": "set_env with the name ROS_LOG_DIR",
}
"""A tag that Jazzy has, to what to use here."""

SUBSTITUTIONS = {
    "all": "$(and A B)",
    "any": "$(or A B)",
    "for-var": "",
    "index": "",
    "param": "$(var NAME)",
}
"""A `$(...)` that Jazzy has, to what to use here."""


def instead_of(module: str, name: str = "") -> str:
    """What to use in place of `name` of `module`, or of all that is in `module`."""
    outer = module
    while outer and outer not in MODULES and name not in NAMES:
        outer = outer.rpartition(".")[0]
    return NAMES.get(name) or MODULES.get(f"{module}.{name}") or MODULES.get(outer, "")


_offered: dict[str, Mapping[str, Any]] = {}


def know(modules: Mapping[str, Mapping[str, Any]]) -> None:
    """What launch files can import here: name of a module to what is in it."""
    _offered.update(modules)


def home_of(name: str) -> str | None:
    """The module that a launch file imports `name` from, in a launch file of Jazzy."""
    homes = [module for module, names in (_offered | jazzy.MODULES).items() if name in names]
    return min(homes, key=lambda module: (module.count("."), module)) if homes else None


def known_names() -> list[str]:
    """Every name that a launch file can import."""
    return sorted({name for names in _offered.values() for name in names})


def known_modules() -> list[str]:
    """Every module that a launch file can import, here or with the full ROS."""
    return [*jazzy.MODULES, *MODULES]


def names_in(module: str) -> list[str]:
    """What can be imported from `module`."""
    return list(_offered.get(module, ()))
