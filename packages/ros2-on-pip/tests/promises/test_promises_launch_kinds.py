"""Each argument of each public constructor takes the kinds of values that Jazzy's takes."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
from launched import Launch, actions, base, conditions, handlers, logged, ros, subs

from ros2_on_pip.launching import jazzy, provided
from ros2_on_pip.launching.places import BadLaunchFile

Given = subs.LaunchConfiguration

SAMPLES: dict[str, Any] = {
    "text": "a",
    "number": "1",
    "path": Path("a"),
    "substitution": Given("x"),
    "parts": ["a", Given("x")],
    "texts": ["a", "b"],
    "nested": ["a", ["b"]],
    "int": 1,
    "float": 1.5,
    "truth": True,
    "none": None,
    "action": actions.LogInfo(msg="a"),
    "actions": [actions.LogInfo(msg="a")],
    "pairs": {"a": "b"},
    "function": lambda *_: None,
}
"""A value of each kind that somebody may try."""

TEXT = {"text", "number", "path", "substitution", "parts", "texts"}
NONE = {"none"}
TRUTH = {"truth", "substitution", "parts"}
SECONDS = {"float", "number", "substitution", "parts"}
WORDS = {"parts", "texts", "nested", "pairs"}
ACTIONS = {"actions"}
ANSWER = {"action", "actions", "function", "none"}
FUNCTION = {"function"}
PAIRS = {"pairs", "none"}
NUMBER = {"int", "float", "truth"}
SIZED = {"text", "number", "texts", "parts", "nested", "actions", "pairs"}
VALUE = {"text", "number", "int", "float", "truth", "substitution", "parts", "texts"}
NOTHING: set[str] = set()
ANY = set(SAMPLES)

OF_PACKAGE = {"package": TEXT}
OF_SIDES = {"left": TEXT, "right": TEXT}
OF_NAME = {"name": TEXT}
OF_FILE = {"launch_file_path": TEXT}
OF_PAIR = {"name": TEXT, "value": TEXT}
ON_PROCESS = {"target_action": FUNCTION | NONE, "handle_once": ANY}

TAKEN: dict[str, dict[str, set[str]]] = {
    "launch.LaunchDescription": {"initial_entities": ACTIONS | NONE, "deprecated_reason": ANY},
    "launch.EventHandler": {
        "matcher": ANY,
        "entities": {"action", "actions", "none"},
        "handle_once": ANY,
    },
    "launch.actions.AppendEnvironmentVariable": {**OF_PAIR, "prepend": TRUTH, "separator": TEXT},
    "launch.actions.DeclareLaunchArgument": {
        "name": ANY,
        "default_value": TEXT | NONE,
        "description": ANY,
        "choices": SIZED | NONE,
    },
    "launch.actions.EmitEvent": {"event": NOTHING},
    "launch.actions.ExecuteProcess": {
        "cmd": WORDS,
        "name": TEXT | NONE,
        "prefix": TEXT | NONE,
        "cwd": TEXT | NONE,
        "env": PAIRS,
        "additional_env": PAIRS,
        "shell": ANY,
        "output": TEXT | {"pairs"},
        "emulate_tty": ANY,
        "log_cmd": ANY,
        "cached_output": ANY,
        "output_format": ANY,
        "on_exit": ANSWER,
        "respawn": TRUTH,
        "respawn_delay": NUMBER | NONE,
        "respawn_max_retries": NUMBER,
        "sigterm_timeout": TEXT,
        "sigkill_timeout": TEXT,
    },
    "launch.actions.GroupAction": {
        "actions": ACTIONS,
        "scoped": ANY,
        "forwarding": ANY,
        "launch_configurations": PAIRS,
    },
    "launch.actions.IncludeLaunchDescription": {
        "launch_description_source": TEXT,
        "launch_arguments": NONE,
    },
    "launch.actions.LogInfo": {"msg": TEXT, "condition": NONE},
    "launch.actions.OpaqueFunction": {
        "function": FUNCTION,
        "args": SIZED | NONE,
        "kwargs": PAIRS,
    },
    "launch.actions.RegisterEventHandler": {"event_handler": NOTHING},
    "launch.actions.SetEnvironmentVariable": OF_PAIR,
    "launch.actions.SetLaunchConfiguration": OF_PAIR,
    "launch.actions.Shutdown": {"reason": ANY},
    "launch.actions.TimerAction": {
        "period": SECONDS,
        "actions": ACTIONS,
        "cancel_on_shutdown": TRUTH,
    },
    "launch.actions.UnregisterEventHandler": {"event_handler": NOTHING},
    "launch.actions.UnsetEnvironmentVariable": OF_NAME,
    "launch.actions.UnsetLaunchConfiguration": OF_NAME,
    "launch.conditions.IfCondition": {"predicate_expression": TEXT},
    "launch.conditions.UnlessCondition": {"predicate_expression": TEXT},
    "launch.conditions.LaunchConfigurationEquals": {
        "launch_configuration_name": ANY,
        "expected_value": TEXT | NONE,
    },
    "launch.conditions.LaunchConfigurationNotEquals": {
        "launch_configuration_name": ANY,
        "expected_value": TEXT | NONE,
    },
    "launch.event_handlers.OnExecutionComplete": {
        **ON_PROCESS,
        "target_action": {"action", "function", "none"},
        "on_completion": ANSWER,
    },
    "launch.event_handlers.OnProcessExit": {**ON_PROCESS, "on_exit": ANSWER},
    "launch.event_handlers.OnProcessIO": {
        **ON_PROCESS,
        "on_stdin": FUNCTION | NONE,
        "on_stdout": FUNCTION | NONE,
        "on_stderr": FUNCTION | NONE,
    },
    "launch.event_handlers.OnProcessStart": {**ON_PROCESS, "on_start": ANSWER},
    "launch.event_handlers.OnShutdown": {"on_shutdown": ANSWER, "handle_once": ANY},
    "launch.launch_description_sources.AnyLaunchDescriptionSource": OF_FILE,
    "launch.launch_description_sources.PythonLaunchDescriptionSource": OF_FILE,
    "launch_xml.launch_description_sources.XMLLaunchDescriptionSource": OF_FILE,
    "launch_yaml.launch_description_sources.YAMLLaunchDescriptionSource": OF_FILE,
    "launch.substitutions.AndSubstitution": OF_SIDES,
    "launch.substitutions.AnonName": OF_NAME,
    "launch.substitutions.Command": {"command": TEXT, "on_stderr": TEXT},
    "launch.substitutions.EnvironmentVariable": {**OF_NAME, "default_value": TEXT | NONE},
    "launch.substitutions.EqualsSubstitution": {"left": ANY, "right": ANY},
    "launch.substitutions.FileContent": {"path": TEXT},
    "launch.substitutions.FindExecutable": OF_NAME,
    "launch.substitutions.IfElseSubstitution": {
        "condition": TEXT,
        "if_value": TEXT,
        "else_value": TEXT,
    },
    "launch.substitutions.LaunchConfiguration": {"variable_name": TEXT, "default": ANY},
    "launch.substitutions.LocalSubstitution": {
        "expression": {"text", "number"},
        "description": ANY,
    },
    "launch.substitutions.NotEqualsSubstitution": {"left": ANY, "right": ANY},
    "launch.substitutions.NotSubstitution": {"value": TEXT},
    "launch.substitutions.OrSubstitution": OF_SIDES,
    "launch.substitutions.PathJoinSubstitution": {"substitutions": WORDS},
    "launch.substitutions.PathSubstitution": {"path": TEXT},
    "launch.substitutions.PythonExpression": {"expression": TEXT, "python_modules": TEXT},
    "launch.substitutions.TextSubstitution": {"text": {"text", "number"}},
    "launch_ros.actions.Node": {
        "executable": TEXT,
        "package": TEXT | NONE,
        "name": TEXT | NONE,
        "namespace": TEXT | NONE,
        "exec_name": TEXT | NONE,
        "parameters": {"parts", "texts", "nested", "none"},
        "arguments": WORDS | NONE,
        "ros_arguments": {"parts", "texts", "nested", "none"},
        "remappings": NONE,
    },
    "launch_ros.actions.PushRosNamespace": {"namespace": TEXT},
    "launch_ros.actions.SetParameter": OF_NAME,
    "launch_ros.actions.SetParametersFromFile": {"filename": TEXT},
    "launch_ros.actions.SetRemap": {"src": TEXT, "dst": TEXT},
    "launch_ros.actions.SetUseSimTime": {"value": TRUTH},
    "launch_ros.descriptions.Parameter": {**OF_NAME, "value": VALUE},
    "launch_ros.descriptions.ParameterFile": {"param_file": TEXT, "allow_substs": {"truth"}},
    "launch_ros.descriptions.ParameterValue": {"value": VALUE, "value_type": NONE},
    "launch_ros.substitutions.ExecutableInPackage": {"executable": TEXT, **OF_PACKAGE},
    "launch_ros.substitutions.FindPackagePrefix": OF_PACKAGE,
    "launch_ros.substitutions.FindPackageShare": OF_PACKAGE,
}
"""A class to its arguments, and the samples that each takes; every other one is refused."""

ASIDE = {
    "launch_ros.actions.SetParameter.value": "test_what_is_no_value_of_a_parameter has its kinds.",
    "launch_ros.descriptions.Parameter.value_type": "As that of ParameterValue, which takes it.",
    "launch_ros.descriptions.Parameter.description": "It is not in the file that was read.",
}
"""Arguments that stand elsewhere."""

NEEDED: dict[str, Any] = {
    "actions": [],
    "cmd": ["a"],
    "command": "a",
    "condition": "true",
    "else_value": "b",
    "executable": "a",
    "expression": "a",
    "function": len,
    "launch_description_source": "a",
    "launch_configuration_name": "a",
    "left": "a",
    "matcher": len,
    "msg": "a",
    "name": "a",
    "on_completion": None,
    "on_exit": None,
    "on_shutdown": None,
    "on_start": None,
    "expected_value": "a",
    "package": "a",
    "param_file": "a",
    "period": 1.0,
    "right": "a",
    "src": "a",
    "dst": "a",
    "value": "a",
    "variable_name": "a",
}
"""What a constructor gets where it must be given something else, too."""

BUILT_OF_NOTHING = (base.Action, base.Condition, base.Event, base.Substitution)


def public_classes() -> dict[str, type]:
    """What a launch file makes itself; of several names of one class, that of the table."""
    names: dict[type, list[str]] = {}
    for package in jazzy.PACKAGES:
        for name, value in provided.modules().get(package, {}).items():
            if inspect.isclass(value):
                names.setdefault(value, []).append(f"{package}.{name}")
    return {next((n for n in found if n in TAKEN), found[0]): cls for cls, found in names.items()}


def own_arguments(cls: type) -> dict[str, inspect.Parameter]:
    """Those that stand in the constructor of the class, and not in that of its base."""
    kinds = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    parameters = inspect.signature(cls).parameters
    return {name: one for name, one in parameters.items() if one.kind in kinds}


CLASSES = {
    name: cls
    for name, cls in public_classes().items()
    if not issubclass(cls, base.Event | base.LaunchContext | Exception)
    and cls not in BUILT_OF_NOTHING
    and own_arguments(cls)
}


def test_each_argument_of_each_constructor_is_in_the_table() -> None:
    """And nothing is in it that is not there."""
    there = {
        f"{name}.{argument}" for name, cls in CLASSES.items() for argument in own_arguments(cls)
    }
    listed = {f"{name}.{argument}" for name, row in TAKEN.items() for argument in row}
    inherited = {"launch.actions.LogInfo.condition"}
    assert there - listed - set(ASIDE) == set()
    assert (listed | set(ASIDE)) - there - inherited == set()


def made(cls: Callable[..., Any], argument: str, value: Any) -> Any:
    """An object with this argument, and with what it needs besides."""
    needed = {
        name: NEEDED[name]
        for name, one in own_arguments(cls).items()  # type: ignore[arg-type]  # a class
        if name != argument and (one.default is one.empty or name in ("executable", "else_value"))
    }
    return cls(**needed, **{argument: value})


ROWS = [(name, argument) for name, row in TAKEN.items() for argument in row]


@pytest.mark.parametrize(("name", "argument"), ROWS)
def test_each_argument_takes_the_kinds_that_jazzys_takes(name: str, argument: str) -> None:
    """And refuses the others when the object is made."""
    taken, wrong = TAKEN[name][argument], []
    for kind, value in SAMPLES.items():
        try:
            made(CLASSES[name], argument, value)
        except (TypeError, ValueError, RuntimeError) as fault:
            wrong += [f"{kind} is refused: {fault}"] if kind in taken else []
        else:
            wrong += [] if kind in taken else [f"{kind} is taken"]
    assert wrong == []


REFUSED: Mapping[str, Callable[[], Any]] = {
    "choices that are none": lambda: actions.DeclareLaunchArgument("a", choices=[]),
    "a default that is no choice": lambda: actions.DeclareLaunchArgument(
        "a", default_value="c", choices=["a", "b"]
    ),
    "no text of two": lambda: subs.IfElseSubstitution("true"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_makes_no_sense_is_a_runtime_error(case: str) -> None:
    """When the object is made."""
    with pytest.raises(RuntimeError):
        REFUSED[case]()


def test_a_default_with_a_substitution_is_looked_at_later(launch: Launch) -> None:
    """As are those in a list; a default among the choices is none of ours."""
    actions.DeclareLaunchArgument("a", default_value="b", choices=["a", "b"])
    for default in (Given("x"), ["c"]):
        late = actions.DeclareLaunchArgument("a", default_value=default, choices=["a", "b"])
        launch.context.launch_configurations = {"x": "c"}
        with pytest.raises(BadLaunchFile, match='"c" is not valid'):
            launch.visit(late)


NO_LISTS: Mapping[str, Callable[[Any], Any]] = {
    "a description": lambda one: base.LaunchDescription(one),
    "a group": lambda one: actions.GroupAction(one),
    "a timer": lambda one: actions.TimerAction(period=1.0, actions=one),
    "a function": lambda one: actions.OpaqueFunction(function=lambda context: one),
}


@pytest.mark.parametrize("case", NO_LISTS)
def test_one_action_is_no_list_of_actions(
    launch: Launch, capsys: pytest.CaptureFixture[str], case: str
) -> None:
    """At the latest when it is carried out; a list of one is."""
    with pytest.raises((TypeError, BadLaunchFile), match=r"Put \[ and \] around it"):
        launch.visit(NO_LISTS[case](actions.LogInfo(msg="no")))
    launch.run(NO_LISTS[case]([actions.LogInfo(msg="yes")]))
    assert logged(capsys) == ["yes"]


def test_a_text_can_only_be_made_of_texts(launch: Launch) -> None:
    """What a function has set, and what an event brings along, may be something else."""
    launch.context.launch_configurations["count"] = 5
    assert Given("count").perform(launch.context) == 5
    with pytest.raises(BadLaunchFile, match="a text is needed"):
        launch.visit(actions.LogInfo(msg=Given("count")))
    number = subs.LocalSubstitution("event.returncode")
    end = handlers.OnProcessExit(on_exit=[actions.LogInfo(msg=number)])
    code = launch.run(actions.RegisterEventHandler(end), actions.ExecuteProcess(cmd=["true"]))
    assert code == 1


@pytest.mark.parametrize("pair", [["a", "b"], "ab", ("a",), ("a", "b", "c"), ("a", 5)])
def test_other_names_are_pairs(pair: Any) -> None:
    """Each a tuple; a list of two is none."""
    ros.Node(executable="a", remappings=[("a", "b"), (["a"], Given("x"))])
    ros.Node(executable="a", remappings={"a": "b"}.items())
    with pytest.raises(TypeError):
        ros.Node(executable="a", remappings=[pair])


def test_a_condition_that_is_none_is_refused() -> None:
    """The true one is taken."""
    actions.LogInfo(msg="a", condition=conditions.IfCondition("true"))
    with pytest.raises(TypeError, match="condition must be IfCondition"):
        actions.LogInfo(msg="a", condition=lambda context: True)
