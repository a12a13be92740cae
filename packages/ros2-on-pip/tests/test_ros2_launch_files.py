"""Launch files in all three languages: the graph, the parameters and the events that come of each.

What is expected here is what Jazzy's launch 3.4 and launch_ros 0.26 document and do.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from launch_shop import package
from terminal import HERE, Ran, Shell

FILES = HERE / "launch_files"
TOLD = re.compile(r"^\[(?P<name>\S+)\] told (?P<said>\{.*\})$")
Told = dict[str, Any]


@dataclass(frozen=True)
class Expected:
    """What a launch file brings about."""

    nodes: list[Told] = field(default_factory=list)
    logs: list[str] = field(default_factory=list)
    says: tuple[str, ...] = ()
    never: tuple[str, ...] = ()
    code: int = 0


def node(name: str, *words: str, topic: str = "", mood: str = "", **parameters: Any) -> Told:
    """What the node `name` tells; its topic is in its namespace where nothing else is said."""
    space = name.rpartition("/")[0]
    said = {
        "node": name,
        "topic": topic or f"{space}/topic",
        "parameters": parameters,
        "words": list(words),
        "mood": mood,
    }
    return {key: value for key, value in said.items() if value}


GROUPED = {"color": "red", "speed": 2.5, "use_sim_time": True}
FROM_FILE = {"everyone": 1, "side": "left"}
HERE_TEXT = str(FILES)

CASES = {
    "arguments.launch.py": Expected(
        [node("/teller", rate=2.5, text="2.5", literal="7", joined="left_wheel")]
    ),
    "arguments.launch.py rate:=4 side:=right": Expected(
        [node("/teller", rate=4, text="4", literal="7", joined="right_wheel")]
    ),
    "parameters.launch.py": Expected(
        [
            node(
                "/left/wheels",
                **FROM_FILE,
                speed=0.5,
                on=True,
                mixed=[1.0, 2.5],
                names=["a", "b"],
                **{"pid.p": 1.0, "pid.limits": [1, 2]},
            )
        ]
    ),
    "names.launch.py": Expected(
        [
            node("/head/left/ear", "one", "two words", topic="/news"),
            node("/tail/teller"),
            node("/teller"),
        ]
    ),
    "groups.launch.py": Expected(
        [
            node("/outer/first", topic="/news", **GROUPED),
            node("/outer/inner/second", topic="/news", **GROUPED),
            node("/away/third", topic="/news", **GROUPED),
            node("/fourth", color="blue"),
        ]
    ),
    "includes.launch.py": Expected(
        [node("/one"), node("/xml/two"), node("/yaml/three"), node("/xml/four")]
    ),
    "conditions.launch.py": Expected(logs=["it is on", "it is slow", "it is not two", "it is one"]),
    "conditions.launch.py on:=False speed:=2.0": Expected(
        logs=["it is off", "it is fast", "it is two"]
    ),
    "environment.launch.py": Expected(
        [
            node("/one", mood="calm"),
            node("/two", mood="gay"),
            node("/three", mood="calmer"),
            node("/four", mood="calm sea"),
            node("/five"),
        ],
        ["mood: none"],
    ),
    "events.launch.py": Expected(
        [node("/first"), node("/last")],
        ["it has started", "it says spawned", "exit code 0", "all done", "end: idle"],
    ),
    "shutdown.launch.py": Expected(
        [node("/needed")],
        says=(
            r"^\[INFO\] \[teller-1\]: sending signal 'SIGINT' to process\[teller-1\]$",
            r"^\[INFO\] \[teller-1\]: process has finished cleanly",
            r"^\[INFO\] \[launch\]: process\[\S+\] was required: shutting down launched system$",
        ),
        never=("SIGTERM",),
    ),
    "timers.launch.py": Expected(logs=["first", "second"], says=("sending signal 'SIGINT'",)),
    "opaque.launch.py": Expected([node("/robot0"), node("/robot1")]),
    "opaque.launch.py count:=1": Expected([node("/robot0")]),
    "respawn.launch.py": Expected(
        [node("/teller", "die")] * 3,
        code=1,
        says=(r"^\[ERROR\] \[teller-1\]: process has died \[pid \d+, exit code 3, cmd '.*die",),
        never=("teller-2",),
    ),
    "substitutions.launch.py": Expected(
        logs=[
            "SHARE/config/a.yaml",
            "at once SHARE",
            "prefix PREFIX",
            "3.142",
            "from a command",
            f"{HERE_TEXT}/substitutions.launch.py",
            "a note",
            "yes",
        ]
    ),
    "asked_once.launch.py": Expected(
        [node("/client")],
        says=(r"^\[INFO\] \[teller-1\]: sending signal 'SIGINT' to process\[teller-1\]$",),
        never=("was required",),
    ),
    "beside.launch.py": Expected([node("/one"), node("/two")]),
    "joystick.launch.py": Expected(
        [node("/left/wheels", topic="/left/news", **FROM_FILE, speed=0.1, dead=0.3)]
    ),
    "output.launch.py": Expected(
        [node("/logs"), node("/shows")],
        says=(r"^\[teller-2\] printed$", "^.INFO. .other_name-3.: process started"),
        never=(r"\[teller-1\] printed", r"\[other_name-3\] told"),
    ),
    "submodules.launch.py": Expected([node("/deep/teller", depth=3.0)], ["5 more names"]),
    "twice.launch.xml": Expected(
        [
            node("/left/wheels", **FROM_FILE, speed=0.1),
            node(
                "/right/wheels",
                topic="/right/right_news",
                everyone=1,
                side="right",
                speed=0.8,
                label="12",
                sizes=[2, 3],
            ),
        ]
    ),
    "twice.launch.xml first:=left second:=left/deep": Expected(
        [
            node("/left/wheels", **FROM_FILE, speed=0.1),
            node(
                "/left/deep/wheels",
                topic="/left/deep/left/deep_news",
                everyone=1,
                speed=0.8,
                label="12",
                sizes=[2, 3],
            ),
        ]
    ),
    "events.launch.xml": Expected(
        [node("/needed", "a b", "c d")],
        ["a moment later"],
        says=(r"^\[echo-1\] two words no mood$", "sending signal 'SIGINT' to process"),
    ),
    "includes.launch.xml": Expected([node("/python"), node("/yaml/yaml")], ["who stays set"]),
    "parameters.launch.yaml": Expected(
        [
            node(
                "/left/wheels",
                mood="calm",
                **FROM_FILE,
                speed=3,
                text="3",
                active=True,
                sizes=[1, 2],
                **{"pid.p": 1.5},
            )
        ]
    ),
    "groups.launch.yaml": Expected(
        [node("/outer/red", topic="/news", mood="calm", speed=2.5), node("/blue")],
        ["1.0 is 1: true"],
    ),
}


@pytest.fixture
def mine(empty: Shell, tmp_path: Path) -> Shell:
    """A terminal with the package `mine`, which has the executable `teller`."""
    return package(empty, tmp_path)


def tellings(ran: Ran) -> list[Told]:
    """What the nodes told, in the order of their names on the screen."""
    found = [match for match in map(TOLD.match, ran.lines) if match]
    return [json.loads(match["said"]) for match in sorted(found, key=lambda one: one["name"])]


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_what_comes_of_a_launch_file(mine: Shell, tmp_path: Path, case: str) -> None:
    """Nodes with their parameters and topics; the lines of the launch file itself, in order."""
    name, *arguments = case.split()
    expected = CASES[case]
    ran = mine("launch", str(FILES / name), *arguments)
    print(ran.out)
    if expected.nodes:
        ends = [one for one in tellings(ran) if one.get("words") != ["stay"]]
        assert ends == expected.nodes
    logs = [line.partition("[launch.user]: ")[2].strip() for line in ran.lines]
    share = str(tmp_path / "share" / "mine")
    wanted = [one.replace("SHARE", share).replace("PREFIX", str(tmp_path)) for one in expected.logs]
    assert [line for line in logs if line] == wanted
    for pattern in expected.says:
        assert any(re.search(pattern, line) for line in ran.lines), pattern
    assert not [line for line in ran.lines for never in expected.never if re.search(never, line)]
    assert (ran.code, ran.err) == (expected.code, "")


def test_there_are_twenty_launch_files() -> None:
    """Each stands in a case, or is included by one that does."""
    named = {case.split()[0] for case in CASES}
    included = {"inner.launch.py", "inner.launch.xml", "inner.launch.yaml"}
    assert {file.name for file in FILES.glob("*.launch.*")} == named | included
    assert len(named) >= 20
