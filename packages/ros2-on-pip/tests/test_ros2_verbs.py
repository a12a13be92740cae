"""Verbs and options that ask for one thing and end: services, parameters, packages, multicast."""

from __future__ import annotations

import re
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import inside
import pytest
from published import LOOK, shows
from terminal import HERE, Shell, surroundings

from skips import skip_without

pytestmark = pytest.mark.slow

ALONE = HERE / "loopback_only.py"
BEHIND_A_WALL = HERE / "nodes" / "behind_a_wall.py"


@shows("daemon start")
@shows("daemon stop")
@shows("daemon status")
@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("daemon start", "No daemon is started"),
        ("daemon start --debug", "No daemon is started"),
        ("daemon stop", "The daemon is not running"),
        ("daemon status", "The daemon is not running"),
    ],
)
def test_there_is_no_daemon_to_start(empty: Shell, words: str, said: str) -> None:
    """It is said why, and is no error: a book's commands go on."""
    ran = inside.run(empty, *words.split())
    assert ran.code == 0
    assert ran.out.startswith(f"{said}: ros2 needs none here")


@pytest.mark.parametrize(
    ("words", "code"), [("list", 0), ("types", 0), ("load /x a b -p c:=d", 1), ("unload /x 1", 1)]
)
def test_python_has_no_components(empty: Shell, words: str, code: int) -> None:
    """It is said what they are."""
    ran = inside.run(empty, "component", *words.split())
    assert (ran.code, ran.out) == (code, "")
    assert "Nodes in Python are no components" in ran.err


@shows("action type", *LOOK)
def test_action_type(stage: Shell) -> None:
    """The type, or a near miss and exit 1 as the real tool."""
    assert inside.run(stage, "action", "type", "/fibonacci").out == "test_msgs/action/Fibonacci\n"
    ran = inside.run(stage, "action", "type", "/fibonaci")
    assert (ran.code, ran.out) == (1, "")
    assert "Did you mean /fibonacci?" in ran.err


@shows("service info", *LOOK)
def test_service_info(stage: Shell) -> None:
    """Type and counts; a near miss where the name is wrong."""
    ran = inside.run(stage, "service", "info", "/light")
    assert ran.out == "Type: std_srvs/srv/SetBool\nClients count: 0\nServices count: 1\n"
    lost = inside.run(stage, "service", "info", "/ligth")
    assert lost.code == 1
    assert "Unknown service '/ligth'. Did you mean /light?" in lost.err


@shows("service call", "--stdin", "--rate")
@shows("action send_goal", "--stdin", "--feedback")
def test_values_from_standard_input(stage: Shell) -> None:
    """Of a call and of a goal; typed besides, they are refused."""
    call = ("service", "call", "/light", "std_srvs/srv/SetBool")
    assert "message='on'" in inside.run(stage, *call, "--stdin", stdin="{data: true}").out
    goal = ("action", "send_goal", "/fibonacci", "test_msgs/action/Fibonacci")
    ran = inside.run(stage, *goal, "--stdin", stdin="order: 3\n")
    assert "     order: 3\n" in ran.out
    assert "- 2\n\nGoal finished with status: SUCCEEDED" in ran.out
    both = inside.run(stage, *call, "{data: true}", "--stdin")
    assert both.code == 2
    assert "not allowed with argument" in both.err


def test_action_info_counts_only(stage: Shell) -> None:
    """`-c` leaves the nodes out."""
    ran = inside.run(stage, "action", "info", "/fibonacci", "-c")
    assert ran.out == "Action: /fibonacci\nAction clients: 0\nAction servers: 1\n"


def test_lifecycle_nodes_that_are_hidden(workshop: Shell) -> None:
    """Only with `-a`."""
    assert inside.run(workshop, "lifecycle", "nodes").out == ""
    assert inside.run(workshop, "lifecycle", "nodes", "-a").out == "/_valve\n"


@shows("param get", "--hide-type")
@pytest.mark.parametrize(
    ("words", "out"),
    [
        ("/maker names", "String values are: ['a', 'b']\n"),
        ("/maker names --hide-type", "['a', 'b']\n"),
        ("/maker pid.p", "Double value is: 1.0\n"),
    ],
)
def test_param_get_as_the_real_tool_prints_it(workshop: Shell, words: str, out: str) -> None:
    """A list is a list."""
    ran = inside.run(workshop, "param", "get", *words.split())
    assert (ran.code, ran.out) == (0, out)


@shows("param list", "--filter", "--param-prefixes", "--param-type")
def test_param_list_of_some(workshop: Shell) -> None:
    """By a pattern, by a prefix, with types; nodes that have none of them are left out."""
    assert inside.run(workshop, "param", "list", "--filter", "pid|na").lines == [
        "/maker:",
        "  names",
        "  pid.i",
        "  pid.p",
    ]
    some = inside.run(workshop, "param", "list", "/maker", "--param-prefixes", "pid")
    assert some.lines == ["  pid.i", "  pid.p"]
    typed = inside.run(workshop, "param", "list", "/maker", "--filter", "names", "--param-type")
    assert typed.lines == ["  names (type: string array)"]
    wrong = inside.run(workshop, "param", "list", "--filter", "[")
    assert wrong.code == 1
    assert "is no regular expression" in wrong.err


@shows("param delete")
def test_param_delete(workshop: Shell) -> None:
    """One with dynamic typing goes; another stays; of a third there is a near miss."""
    gone = inside.run(workshop, "param", "delete", "/maker", "spare")
    assert (gone.code, gone.out) == (0, "Deleted parameter successfully\n")
    assert "  spare" not in inside.run(workshop, "param", "list", "/maker").lines
    kept = inside.run(workshop, "param", "delete", "/maker", "pid.p")
    assert kept.code == 1
    assert kept.err.startswith("Deleting parameter failed: Static parameter cannot be undeclared")
    assert "Did you mean names?" in inside.run(workshop, "param", "delete", "/maker", "name").err


@shows("param load", "--no-use-wildcard")
def test_param_load_without_what_is_for_all_nodes(workshop: Shell, tmp_path: Path) -> None:
    """What stands below `/**` is loaded, or left out."""
    file = tmp_path / "both.yaml"
    file.write_text(
        "/**:\n  ros__parameters: {pid: {i: 0.25}}\n/maker:\n  ros__parameters: {pid: {p: 1.0}}\n"
    )
    load = ("param", "load", "/maker", str(file))
    assert inside.run(workshop, *load).lines == [
        "Set parameter pid.i successful",
        "Set parameter pid.p successful",
    ]
    assert inside.run(workshop, *load, "--no-use-wildcard").lines == [
        "Set parameter pid.p successful"
    ]


def test_param_load_takes_what_is_for_this_node_last(workshop: Shell, tmp_path: Path) -> None:
    """Wherever it stands in the file, as the real tool does."""
    file = tmp_path / "turned.yaml"
    file.write_text(
        "/maker:\n  ros__parameters: {pid: {p: 1.0}}\n/**:\n  ros__parameters: {pid: {p: 9.0}}\n"
    )
    assert inside.run(workshop, "param", "load", "/maker", str(file)).code == 0
    assert inside.run(workshop, "param", "get", "/maker", "pid.p", "--hide-type").out == "1.0\n"


@shows("param get", "--timeout")
@shows("param set", "--timeout")
@shows("param describe", "--timeout")
@shows("param dump", "--timeout")
@shows("param load", "--timeout")
@shows("param delete", "--timeout")
def test_param_waits_for_a_node(empty: Shell, tmp_path: Path) -> None:
    """With `--timeout` it may come later; without it, it must be there."""
    file = tmp_path / "talker.yaml"
    file.write_text("talker:\n  ros__parameters: {use_sim_time: false}\n")
    asked = {
        ("get", "/talker", "use_sim_time"): "Boolean value is: False",
        ("set", "/talker", "use_sim_time", "false"): "Set parameter successful",
        ("describe", "/talker", "use_sim_time"): "Parameter name: use_sim_time",
        ("dump", "/talker"): "/talker:",
        ("load", "/talker", str(file)): "Set parameter use_sim_time successful",
        ("delete", "/talker", "use_sim_time"): "cannot be undeclared",
    }
    assert "Node not found: '/talker'" in inside.run(empty, "param", "dump", "/talker").err
    with ExitStack() as stack:
        waiting = [
            (stack.enter_context(empty.start("param", *words, "--timeout", "600")), said)
            for words, said in asked.items()
        ]
        stack.enter_context(empty.start("run", "demo_nodes_py", "talker"))
        for running, said in waiting:
            running.wait_for(re.escape(said))


@shows("interface list", "--only-msgs", "--only-srvs", "--only-actions")
@shows("interface package", "--only-msgs", "--only-srvs", "--only-actions")
@shows("interface packages", "--only-msgs", "--only-srvs", "--only-actions")
@shows("interface show", "--all-comments", "--no-comments")
@shows("interface proto", "--no-quotes")
@pytest.mark.parametrize(
    ("words", "there", "not_there"),
    [
        ("list --only-msgs", "    std_msgs/msg/String\n", "std_srvs/srv/SetBool"),
        ("list --only-srvs", "    std_srvs/srv/SetBool\n", "std_msgs/msg/String"),
        ("list --only-actions", "    test_msgs/action/Fibonacci\n", "std_msgs/msg/String"),
        ("package test_msgs", "test_msgs/action/Fibonacci\n", "std_msgs"),
        ("package test_msgs --only-msgs", "test_msgs/msg/Strings\n", "/srv/"),
        ("package test_msgs --only-srvs", "test_msgs/srv/Empty\n", "/msg/"),
        ("package test_msgs --only-actions", "test_msgs/action/Fibonacci\n", "/msg/"),
        ("packages", "std_msgs\n", "rclpy"),
        ("packages --only-msgs", "std_msgs\n", "std_srvs\n"),
        ("packages --only-srvs", "std_srvs\n", "std_msgs\n"),
        ("packages --only-actions", "test_msgs\n", "std_msgs\n"),
        ("show geometry_msgs/msg/Twist", "Vector3  linear\n", "\t# "),
        ("show geometry_msgs/msg/Twist --all-comments", "\t# ", "no such line"),
        ("show geometry_msgs/msg/Twist --no-comments", "Vector3  linear\n", "#"),
        ("proto geometry_msgs/msg/Vector3", '"x: 0.0\n', "no such line"),
        ("proto geometry_msgs/msg/Vector3 --no-quotes", "x: 0.0\n", '"'),
    ],
)
def test_interface_words(empty: Shell, words: str, there: str, not_there: str) -> None:
    """What is listed and shown, and what an option leaves out."""
    ran = inside.run(empty, "interface", *words.split())
    assert ran.code == 0
    assert there in ran.out
    assert not_there not in ran.out


@shows("pkg list")
@shows("pkg xml", "--tag")
@shows("pkg prefix", "--share")
def test_pkg_looks(empty: Shell) -> None:
    """The manifest, one of its tags, and where a package lies."""
    whole = inside.run(empty, "pkg", "xml", "std_msgs").out
    assert whole.startswith("<package ")
    assert "<name>std_msgs</name>" in whole
    assert inside.run(empty, "pkg", "xml", "std_msgs", "--tag", "name").out == "std_msgs\n"
    wrong = inside.run(empty, "pkg", "xml", "std_msgs", "-t", "nam")
    assert wrong.code == 1
    assert "has no <nam>. Did you mean name?" in wrong.err
    assert "has no package.xml" in inside.run(empty, "pkg", "xml", "demo_nodes_py").err
    prefix = inside.run(empty, "pkg", "prefix", "std_msgs").out.strip()
    share = inside.run(empty, "pkg", "prefix", "std_msgs", "--share").out.strip()
    assert share == f"{prefix}/share/std_msgs"
    assert "std_msgs" in inside.run(empty, "pkg", "list").lines


@shows("pkg executables", "--full-path")
@shows("run", "--prefix")
def test_executables_and_what_stands_before_them(empty: Shell) -> None:
    """The path of each; `--prefix` puts another program in front."""
    places = inside.run(empty, "pkg", "executables", "demo_nodes_py", "--full-path").lines
    assert [Path(place).name for place in places] == ["listener.py", "talker.py"]
    ran = empty("run", "--prefix", "echo before", "demo_nodes_py", "talker", "x")
    assert ran.out.startswith("before ")
    assert ran.out.endswith("talker.py x\n")


@shows(
    "pkg create",
    "--package-format",
    "--description",
    "--license",
    "--destination-directory",
    "--build-type",
    "--dependencies",
    "--maintainer-email",
    "--maintainer-name",
    "--node-name",
    "--library-name",
)
def test_pkg_create_with_every_option(empty: Shell, tmp_path: Path) -> None:
    """Each of them shows in what is made; without `--build-type` it asks for it."""
    ran = inside.run(
        empty,
        "pkg",
        "create",
        "wheels",
        "--build-type",
        "ament_python",
        "--package-format",
        "2",
        "--description",
        "Turns them",
        "--license",
        "MIT",
        "--dependencies",
        "rclpy",
        "--maintainer-email",
        "ada@example.com",
        "--maintainer-name",
        "Ada",
        "--node-name",
        "turn",
        "--library-name",
        "axle",
        "--destination-directory",
        str(tmp_path),
    )
    assert ran.code == 0
    manifest = (tmp_path / "wheels" / "package.xml").read_text()
    for piece in (
        'format="2"',
        "<description>Turns them</description>",
        "<license>MIT</license>",
        'email="ada@example.com">Ada</maintainer>',
        "<depend>rclpy</depend>",
        "<build_type>ament_python</build_type>",
    ):
        assert piece in manifest
    assert (tmp_path / "wheels" / "wheels" / "turn.py").is_file()
    assert (tmp_path / "wheels" / "axle").is_dir() or (tmp_path / "wheels/wheels/axle").is_dir()
    assert "--build-type" in inside.run(empty, "pkg", "create", "other").err


@shows("topic info")
@shows("topic type", *LOOK)
@shows("service type", *LOOK)
@shows("service find")
@pytest.mark.parametrize(
    ("words", "right"),
    [
        ("topic info chatter", "/chatter"),
        ("topic type chatter", "/chatter"),
        ("service type light", "/light"),
        ("service info light", "/light"),
        ("action type fibonacci", "/fibonacci"),
        ("topic find std_msgs/String", "std_msgs/msg/String"),
        ("service find std_srvs/SetBool", "std_srvs/srv/SetBool"),
        ("interface show geometry_msgs/Twist", "geometry_msgs/msg/Twist"),
        ("interface proto geometry_msgs/Twist", "geometry_msgs/msg/Twist"),
    ],
)
def test_a_habit_that_breaks_on_a_robot_is_told(stage: Shell, words: str, right: str) -> None:
    """It works here, and one line says how to write it."""
    typed = words.split()[-1]
    ran = inside.run(stage, *words.split())
    whole = inside.run(stage, *words.split()[:-1], right)
    assert (ran.code, ran.out) == (0, whole.out)
    assert ran.err == f"NOTE: write {right}. On a robot, ros2 does not take '{typed}' here.\n"
    assert (whole.code, whole.err) == (0, "")


def behind_a_wall(home: Path, *words: str) -> str:
    """What `nodes/behind_a_wall.py` prints, in a network where only loopback exists."""
    skip_without("namespaces")
    done = subprocess.run(
        [sys.executable, ALONE, sys.executable, BEHIND_A_WALL, *words],
        cwd=home,
        text=True,
        env=surroundings(0, home),
        capture_output=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@shows("multicast send", "--group", "--port")
@shows("multicast receive", "--group", "--port")
@pytest.mark.parametrize("where", [(), ("--group", "225.0.0.7", "--port", "49152")])
def test_multicast_from_one_terminal_to_another(tmp_path: Path, where: tuple[str, ...]) -> None:
    """As the real tool prints it, on the usual group and on another one."""
    out = behind_a_wall(tmp_path, "pair", *where, "--", *where)
    assert re.fullmatch(
        r"Waiting for UDP multicast datagram\.\.\.\n"
        r"Received from [\d.]+:\d+: 'Hello World!'\nSending one UDP multicast datagram\.\.\.\n",
        out,
    )


@shows("multicast send", "--ttl")
@shows("wtf hello", "--ttl", "--topic", "--once")
@pytest.mark.parametrize(
    ("words", "ttl"),
    [
        ("multicast send", 1),
        ("multicast send --ttl 5", 5),
        ("wtf hello --once", 1),
        ("wtf hello --once --ttl 3 --topic /hi", 3),
    ],
)
def test_how_far_a_datagram_may_go(tmp_path: Path, words: str, ttl: int) -> None:
    """By default not beyond the nearest network."""
    assert behind_a_wall(tmp_path, "ttl", *words.split()) == f"ttl {ttl}\n"


@shows("wtf hello", "--emit-period", "--print-period")
def test_hello_prints_tables(tmp_path: Path) -> None:
    """How often it prints, and how many were said in that time."""
    slow = ("--emit-period", "0.2", "--print-period", "0.1", "--topic", "/hi")
    out = behind_a_wall(tmp_path, "tables", *slow)
    assert out.startswith(
        "MULTIMACHINE COMMUNICATION SUMMARY\nTopic: /hi, Published Msg Count: 1\n"
        "Subscribed from:\n                Hostname             Msg Count /0.1s\n"
        "Multicast Group/Port: 225.0.0.1/49150, Sent Msg Count: 1\nReceived from:\n"
    )
    quick = ("--emit-period", "0.01", "--print-period", "2")
    counts = re.findall(r"Published Msg Count: (\d+)", behind_a_wall(tmp_path, "tables", *quick))
    assert max(map(int, counts)) > 1


@pytest.mark.parametrize(("option", "value"), [("--group", "10.0.0.1"), ("--port", "70000")])
def test_multicast_to_where_it_cannot_go(empty: Shell, option: str, value: str) -> None:
    """Said before anything is sent."""
    ran = inside.run(empty, "multicast", "send", option, value)
    assert ran.code == 2
    assert f"{value} is no" in ran.err
