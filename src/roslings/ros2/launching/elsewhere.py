"""What Jazzy's launch files can say, and ours cannot: right there, and not read here.

From the names under which Jazzy's packages `launch` and `launch_ros` expose their actions and
substitutions, and from what the actions' `parse` takes.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

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
    "launch_testing": "pytest, and nodes that it starts",
    "launch_testing_ros": "pytest, and nodes that it starts",
    "launch_param_builder": "parameters=[{...}] of Node",
    "moveit_configs_utils": "",
    "nav2_common": "",
    "nav2_common.launch": "",
}
"""A module that Jazzy has, to what to use here."""

ELEMENTS = {
    "append_env": "",
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
}  # fmt: skip
"""A tag that Jazzy has, to what to use here."""

SUBSTITUTIONS = {
    "all": "$(and A B)",
    "any": "$(or A B)",
    "for-var": "",
    "index": "",
    "param": "$(var NAME)",
}
"""A `$(...)` that Jazzy has, to what to use here."""


_offered: dict[str, Mapping[str, Any]] = {}


def know(modules: Mapping[str, Mapping[str, Any]]) -> None:
    """What launch files can import here: name of a module to what is in it."""
    _offered.update(modules)


def home_of(name: str) -> str | None:
    """The module that a launch file imports `name` from."""
    homes = [module for module, names in _offered.items() if name in names]
    return min(homes, key=lambda module: (module.count("."), module)) if homes else None


def known_names() -> list[str]:
    """Every name that a launch file can import."""
    return sorted({name for names in _offered.values() for name in names})


def known_modules() -> list[str]:
    """Every module that is offered to launch files."""
    return list(_offered)


def names_in(module: str) -> list[str]:
    """What can be imported from `module`."""
    return list(_offered.get(module, ()))
