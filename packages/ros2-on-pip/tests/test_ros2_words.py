"""The command line itself: handing over, unknown words, a bad environment, the Tab key."""

from __future__ import annotations

import itertools
import subprocess
import sys
from pathlib import Path

import pytest
from terminal import Shell, ours

from ros2_on_pip import discovery as direct_node
from ros2_on_pip import surroundings
from ros2_on_pip.cli import COMMANDS
from ros2_on_pip.discovery import Sight
from ros2_on_pip.participants import participants_here
from ros2_on_pip.profiles import QUICK_DISCOVERY
from skips import needs
from sources import code_of

START = code_of("ros2_on_pip") / "start.py"


def test_the_discovery_file_is_the_arenas() -> None:
    """Named twice, because importing the arena takes longer than `ros2 node list` may."""
    assert surroundings.QUICK_DISCOVERY == QUICK_DISCOVERY


def test_the_real_ros2_is_run_where_there_is_one(empty: Shell, tmp_path: Path) -> None:
    """Unchanged: its words, its exit code. Our own launcher on the path is passed over."""
    own, real = tmp_path / "own", tmp_path / "real"
    write_program(own / "ros2", "# roslings\nexit 1")
    write_program(real / "ros2", 'echo "the real one: $*"; exit 5')
    path = f"{own}:{real}:/usr/bin:/bin"
    done = subprocess.run(
        [sys.executable, START, "topic", "echo", "--raw", "/x"],
        env=empty.environment | {"PATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (5, "the real one: topic echo --raw /x\n")


def test_a_ros2cli_that_can_only_be_imported_is_run_too(empty: Shell, tmp_path: Path) -> None:
    """A workspace may hold it without a program on the path."""
    package = tmp_path / "ros2cli"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "cli.py").write_text("import sys\ndef main():\n    print(sys.argv[1:]); return 6\n")
    done = subprocess.run(
        [sys.executable, START, "node", "list"],
        env=empty.environment | {"PATH": "/usr/bin:/bin", "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (6, "['node', 'list']\n")


def write_program(place: Path, line: str) -> None:
    """An executable shell script."""
    place.parent.mkdir()
    place.write_text(f"#!/bin/sh\n{line}\n")
    place.chmod(0o755)


def test_help_names_every_command(empty: Shell) -> None:
    """`ros2` alone says what there is."""
    ran = empty()
    assert ran.code == 0
    assert all(f"    {command}" in ran.out for command in COMMANDS)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("topc", "list"), "there is no command 'topc'. Did you mean topic?"),
        (("security", "stop"), "'ros2 security' is part of the full ros2"),
        (("bag", "list", "--window", "3"), "'ros2 bag list' is part of the full ros2"),
        (("bag", "convert", "x", "y"), "'ros2 bag convert' is part of the full ros2"),
        (("pkg", "depends", "x"), "there is no 'depends' here. There is: create, list"),
        (("node", "lst"), "there is no 'lst' here. Did you mean list?"),
        (("topic", "hz"), "the following arguments are required: topic_name"),
        (("topic", "pub", "/x", "T", "-r", "fast"), "'fast' is no number"),
        (("topic", "pub", "/x", "T", "-r", "0"), "0 is not above zero"),
    ],
)
def test_wrong_words(empty: Shell, words: tuple[str, ...], said: str) -> None:
    """One line with the next step, exit 2."""
    ran = empty(*words)
    assert ran.code == 2
    assert said in ran.err


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("ROS_DOMAIN_ID", "abc", "ROS_DOMAIN_ID is 'abc'"),
        ("ROS_DOMAIN_ID", "300", "ROS_DOMAIN_ID is '300'"),
        ("RMW_IMPLEMENTATION", "rmw_other_cpp", "unset RMW_IMPLEMENTATION"),
    ],
)
def test_a_bad_environment(empty: Shell, name: str, value: str, said: str) -> None:
    """Not a traceback from inside ROS."""
    ran = empty("node", "list", **{name: value})
    assert ran.code == 1
    assert said in ran.err


@pytest.mark.parametrize("name", ["/x-y", "/a//b", "/2nd"])
def test_a_name_that_ros_does_not_allow(empty: Shell, name: str) -> None:
    """Said with the rule."""
    ran = empty("topic", "echo", name)
    assert ran.code == 1
    assert "is no valid name in ROS" in ran.err


def completed(shell: Shell, line: str, folder: Path) -> list[str]:
    """What the Tab key offers at the end of `line`."""
    offer = folder / "offer"
    environment = shell.environment | {
        "_ARGCOMPLETE": "1",
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
        "COMP_TYPE": "9",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(offer),
        "IFS": "\v",
        "_ARGCOMPLETE_IFS": "\v",
    }
    subprocess.run(ours(), env=environment, check=False, timeout=60)
    return sorted(word.strip() for word in offer.read_text().split("\v") if word)


def test_tab_completes_words_and_names(stage: Shell, tmp_path: Path) -> None:
    """Commands, verbs, topics, nodes, packages, types."""
    assert completed(stage, "ros2 to", tmp_path) == ["topic"]
    assert completed(stage, "ros2 topic e", tmp_path) == ["echo"]
    assert completed(stage, "ros2 topic echo /c", tmp_path) == ["/chatter", "/cmd_vel"]
    assert completed(stage, "ros2 param list /tu", tmp_path) == ["/tuner"]
    assert completed(stage, "ros2 run demo_nodes_py t", tmp_path) == ["talker"]
    assert "std_msgs/msg/String" in completed(stage, "ros2 interface show std_msgs/msg/S", tmp_path)


def test_tab_offers_the_type_of_what_was_just_typed(stage: Shell, tmp_path: Path) -> None:
    """Of a service, a topic and an action only the right one, and the fields to fill in."""
    call = "ros2 service call /light s"
    assert completed(stage, call, tmp_path) == ["std_srvs/srv/SetBool"]
    assert completed(stage, "ros2 topic pub /cmd_vel g", tmp_path) == [
        "geometry_msgs/msg/TwistStamped"
    ]
    goal = "ros2 action send_goal /fibonacci t"
    assert completed(stage, goal, tmp_path) == ["test_msgs/action/Fibonacci"]
    assert "data:" in "".join(completed(stage, f"{call}td_srvs/srv/SetBool d", tmp_path))


def test_participants_are_counted(empty: Shell) -> None:
    """As many as there are programs on the domain: what a look waits for."""
    domain = int(empty.environment["ROS_DOMAIN_ID"])
    talker = ("run", "demo_nodes_py", "talker")
    assert not participants_here(domain)
    with empty.start(*talker) as one, empty.start(*talker) as two:
        one.wait_for("Publishing")
        two.wait_for("Publishing")
        assert len(participants_here(domain)) == 2


def sight(*programs: bytes) -> Sight:
    """What is seen where `programs` have said all."""
    return Sight(frozenset(programs), frozenset(programs), endpoints=3, unnamed=0, nodes=1)


def test_one_reading_of_the_kernels_table_is_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    """It lacks a port now and then; the look goes on until the other program has spoken."""
    readings = itertools.cycle([frozenset({7410, 7412}), frozenset({7410})])
    monkeypatch.setattr(direct_node, "participants_here", lambda _: next(readings))
    monkeypatch.setattr(direct_node, "QUIET_S", 0.0)
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    settling = direct_node.Settling(domain=0)
    assert not any(settling.after(sight(b"us")) for _ in range(50))
    assert any(settling.after(sight(b"us", b"them")) for _ in range(50))


def test_where_we_are_late_the_others_are_given_longer(monkeypatch: pytest.MonkeyPatch) -> None:
    """One of them may have to wait for a processor between its first topic and its second."""
    now_s = [100.0]
    monkeypatch.setattr(direct_node.time, "monotonic", lambda: now_s[0])
    monkeypatch.setattr(direct_node, "participants_here", lambda _: frozenset({7410}))
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

    def quiet_s(late_s: float) -> float:
        def sleep(for_s: float) -> None:
            now_s[0] += for_s + late_s

        monkeypatch.setattr(direct_node.time, "sleep", sleep)
        settling, began_s = direct_node.Settling(domain=0), now_s[0]
        while not settling.after(sight(b"us")):
            settling.wait()
        return now_s[0] - began_s

    assert quiet_s(0.0) < 0.15
    assert quiet_s(0.06) > 5 * 0.06


def test_a_program_that_never_answers_is_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The look ends, and says that it may lack something."""
    monkeypatch.setattr(direct_node, "participants_here", lambda _: frozenset({7410, 7412}))
    settling = direct_node.Settling(domain=0)
    looks = [settling.after(sight(b"us")) for _ in range(direct_node.SILENT_LOOKS)]
    assert looks.index(True) == direct_node.SILENT_LOOKS - 1
    assert "1 program on this computer did not answer" in capsys.readouterr().err


@needs("module ros_doctor")
def test_the_doctor_answers(empty: Shell) -> None:
    """Its own words and options."""
    ran = empty("doctor", "--list")
    assert ran.code == 0
    assert "domain" in ran.out
