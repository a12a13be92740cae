"""What differed from the real `ros2` and was not meant: one row each, with what the real one does.

Found by 453 commands beside the real one on the same nodes.
"""

from __future__ import annotations

import re
from itertools import product
from pathlib import Path
from typing import Any

import inside
import pytest
from published import shows
from terminal import Ran, Shell

from ros2_on_pip.qos import mismatches

pytestmark = pytest.mark.slow

STRING = "std_msgs/msg/String"
NO_FIELDS = "The passed value needs to be a dictionary in YAML format"

LISTING = "rcl_interfaces/srv/ListParameters"
ONCE = ("topic", "pub", "--once", "-w", "0")

ROWS: dict[tuple[str, ...], tuple[int, str, str]] = {
    ("param", "get", "/maker", "unset"): (1, "", "Parameter not set"),
    ("param", "get", "/maker", "unset", "--hide-type"): (1, "", "Parameter not set"),
    (*ONCE, "/x", STRING, "--keep-alive", "0"): (2, "", "0 is not above zero"),
    (*ONCE, "/x", STRING, "null"): (1, "", NO_FIELDS),
    (*ONCE, "/x", STRING, ""): (1, "", NO_FIELDS),
    (*ONCE, "/x", "geometry_msgs/msg/Twist", "{linear: null}"): (
        1,
        "",
        "Failed to populate field: linear: it needs {x: ..., y: ..., z: ...}",
    ),
    ("service", "call", "/maker/list_parameters", LISTING, "null"): (1, "", NO_FIELDS),
    ("daemon", "start", "-d"): (0, "No daemon is started", ""),
    ("interface", "show", ""): (2, "", "the passed value is empty"),
    ("node", "info", "maker"): (0, "/maker\n", "NOTE: write /maker. On a robot, ros2 does not"),
    ("topic", "list", "-a"): (0, "/rosout\n", "NOTE: write --include-hidden-topics. On a robot"),
    ("service", "find", "-a", "std_srvs/srv/SetBool"): (
        0,
        "",
        "NOTE: write --include-hidden-services. On a robot, ros2 does not take '-a' here.",
    ),
}
"""Words to the exit code, and what stands in the output and on stderr."""


@shows("daemon start", "--debug")
@pytest.mark.parametrize("words", ROWS, ids=" ".join)
def test_it_is_as_the_real_one_has_it(workshop: Shell, words: tuple[str, ...]) -> None:
    """The exit code, and the words."""
    code, out, err = ROWS[words]
    ran = inside.run(workshop, *words)
    assert ran.code == code
    assert out in ran.out
    assert err in ran.err
    assert bool(ran.err) == bool(err)


@pytest.mark.parametrize(
    ("typed", "code", "said"),
    [
        (f"{STRING}\n", 0, "string data\n"),
        (f"  {STRING}  \nstd_msgs/msg/Bool\n", 0, "string data\n"),
        ("std_msgs/msg/Strin\n", 1, "Did you mean std_msgs/msg/String?"),
        ("", 2, "the passed value is empty"),
        ("\n", 2, "the passed value is empty"),
    ],
)
def test_a_type_from_another_command(workshop: Shell, typed: str, code: int, said: str) -> None:
    """`ros2 topic type /x | ros2 interface show -`."""
    ran = inside.run(workshop, "interface", "show", "-", stdin=typed)
    assert ran.code == code
    assert said in ran.out + ran.err


def test_the_type_of_a_topic_is_piped_into_show(workshop: Shell) -> None:
    """By two commands, one after the other."""
    first = inside.run(workshop, "topic", "type", "/flag")
    shown = inside.run(workshop, "interface", "show", first.out.strip())
    assert shown.code == 0
    assert inside.run(workshop, "interface", "show", "-", stdin=first.out).out == shown.out


def test_buffering_as_python_has_it(empty: Shell) -> None:
    """The option stands before the command; the words are the same."""
    plain = empty("interface", "packages")
    buffered = empty("--use-python-default-buffering", "interface", "packages")
    assert (buffered.code, buffered.out) == (0, plain.out)


def malformed(ran: Ran) -> bool:
    """The launch argument was told as malformed, with its exit code."""
    said = "malformed launch argument 'need=1', expected format '<name>:=<value>'"
    return ran.code == 1 and said in ran.err


def test_a_launch_argument_without_its_colon(empty: Shell, tmp_path: Path) -> None:
    """Behind a file, where a package's file would stand, and behind another argument."""
    (tmp_path / "a.launch.xml").write_text("<launch/>")
    assert malformed(empty("launch", "a.launch.xml", "need=1"))
    assert malformed(empty("launch", "./a.launch.xml", "a:=b", "need=1"))
    assert "Package 'no.launch.xml' not found" in empty("launch", "no.launch.xml", "need=1").err


def profiles() -> list[Any]:
    """Profiles that differ in one policy, or in several."""
    from rclpy.duration import Duration
    from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

    choices = product(
        (ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT),
        (DurabilityPolicy.VOLATILE, DurabilityPolicy.TRANSIENT_LOCAL),
        (LivelinessPolicy.AUTOMATIC, LivelinessPolicy.MANUAL_BY_TOPIC),
        (Duration(), Duration(seconds=1), Duration(seconds=5)),
        (Duration(), Duration(seconds=1), Duration(seconds=5)),
    )
    return [
        QoSProfile(
            depth=1,
            reliability=reliability,
            durability=durability,
            liveliness=liveliness,
            deadline=deadline,
            liveliness_lease_duration=lease,
        )
        for reliability, durability, liveliness, deadline, lease in choices
    ]


def test_all_that_cannot_match_is_known() -> None:
    """Each policy that the middleware compares, in each pair: a word where it refuses."""
    from rclpy.qos import QoSCompatibility, qos_check_compatible

    every = profiles()
    for offered, asked in product(every, every):
        refused = qos_check_compatible(offered, asked)[0] == QoSCompatibility.ERROR
        assert bool(mismatches(asked, offered)) == refused, (offered, asked)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--qos-liveliness-lease-duration-seconds", "5"), "LIVELINESS"),
        (("--qos-liveliness", "manual_by_topic"), "liveliness AUTOMATIC, and MANUAL_BY_TOPIC is"),
    ],
)
def test_echo_says_that_liveliness_does_not_match(
    workshop: Shell, words: tuple[str, ...], said: str
) -> None:
    """At once, and does not wait in silence."""
    ran = inside.run(workshop, "topic", "echo", "/flag", *words, "--timeout", "0.1")
    assert re.search(rf"^WARNING: No message can come from node \w+: .*{said}", ran.err, re.M)
