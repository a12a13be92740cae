"""Every name of Jazzy's launch packages: it is here, or it is told as ours that it is not."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from ros2_on_pip.launching import elsewhere, jazzy, provided
from ros2_on_pip.launching.places import BadLaunchFile, LaunchFileLine, NotReadHere
from ros2_on_pip.launching.python_file import students_code
from ros2_on_pip.words import NOT_READ_HERE

ROOTS = ("launch", "launch_ros", "launch_xml", "launch_yaml")
HERE = LaunchFileLine(Path(__file__), 1)


@pytest.fixture(autouse=True)
def offered() -> Iterator[None]:
    """As in the launching process, and afterwards as before."""
    provided.offer()
    yield
    sys.meta_path.remove(provided._offer)
    for name in [one for one in sys.modules if one.partition(".")[0] in ROOTS]:
        del sys.modules[name]


def reached(path: str) -> Any:
    """What `launch.actions.Node` is, after the import of its first word alone."""
    root, *parts = path.split(".")
    found = import_module(root)
    for part in parts:
        found = getattr(found, part)
    return found


@pytest.mark.parametrize("module", jazzy.MODULES)
def test_each_module_is_there_by_the_import_of_its_package_alone(module: str) -> None:
    """As in the real packages, which import their parts; what we have none of says so."""
    if module not in provided.modules():
        with pytest.raises(NotReadHere, match="is right in Jazzy, and not in this launch"):
            reached(module)
        return
    assert reached(module) is sys.modules[module]
    for name in jazzy.MODULES[module]:
        if name in provided.modules()[module]:
            assert reached(f"{module}.{name}") is provided.modules()[module][name]
        else:
            with pytest.raises(NotReadHere):
                reached(f"{module}.{name}")


@pytest.mark.parametrize("module", jazzy.MODULES)
def test_each_import_that_works_on_a_robot_works_or_is_no_mistake(module: str) -> None:
    """`from MODULE import NAME`, and `import MODULE`: exit 69 where we do not have it."""
    lines = [f"import {module}", *(f"from {module} import {n}" for n in jazzy.MODULES[module])]
    for line in lines:
        try:
            with students_code(HERE):
                exec(line, {})
        except BadLaunchFile as told:
            assert told.exit_code == NOT_READ_HERE, line
            assert "Mend this line" not in str(told)


def test_we_offer_no_name_that_jazzy_does_not_have() -> None:
    """A launch file that runs here must not fail on a robot."""
    for package, names in provided._packages().items():
        assert set(names) <= set(jazzy.MODULES[package]), package
    assert set(provided.modules()) <= set(jazzy.MODULES)
    exported = {name for names in jazzy.MODULES.values() for name in names}
    assert set(elsewhere.NAMES) <= exported


@pytest.mark.parametrize(
    "line",
    [
        "import launch; launch.actions.LogInf",
        "import launch; launch.actoins",
        "from launch.actions import LogInf",
        "import launch.actoins",
        "import launch; launch.actions.LogInfo.mgs",
        "import launch; launch.events.LogInfo",
    ],
)
def test_a_misspelt_name_is_a_mistake(line: str) -> None:
    """It is told as one, and not as something that only the full ROS has."""
    with pytest.raises(BadLaunchFile) as told, students_code(HERE):
        exec(line, {})
    assert told.value.exit_code == 1


def classes() -> dict[str, type]:
    """Name of each class of ours that a launch file meets."""
    rooms = (
        provided.actions,
        provided.conditions,
        provided.context,
        provided.description,
        provided.events,
        provided.handlers,
        provided.node,
        provided.parameters,
        provided.processes,
        provided.sources,
        provided.substitution,
        provided.substitutions,
    )
    return {name: cls for room in rooms for name, cls in inspect.getmembers(room, inspect.isclass)}


@pytest.mark.parametrize("name", jazzy.ATTRIBUTES)
def test_an_attribute_that_only_jazzys_class_has_is_no_mistake(name: str) -> None:
    """`context.asyncio_loop`, `node.node_name`: exit 69 where ours has none."""
    cls = classes()[name]
    for attribute in jazzy.ATTRIBUTES[name].split():
        if hasattr(cls, attribute):
            continue
        with (
            pytest.raises(NotReadHere, match=f"{attribute} is right in Jazzy"),
            students_code(HERE),
        ):
            getattr(cls, attribute)


def test_a_star_brings_what_the_real_one_brings() -> None:
    """Its parts too, and nothing that a launch file may call so itself."""
    brought: dict[str, Any] = {}
    exec("from launch import *", brought)
    assert {"actions", "substitutions", "events", "LaunchDescription"} <= set(brought)
    assert "event" not in brought
