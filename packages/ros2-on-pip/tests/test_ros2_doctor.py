"""`ros2 doctor`: the report that bug templates ask for, in the form of the real one."""

from __future__ import annotations

import re
import socket

import inside
import pytest
from published import shows
from terminal import Ran, Shell

from ros2_on_pip.report import PARTS, Section
from skips import needs

with_a_doctor = needs("module ros_doctor")
"""It is a package of its own."""

TITLES = [
    "NETWORK CONFIGURATION",
    "PACKAGE VERSIONS",
    "PLATFORM INFORMATION",
    "QOS COMPATIBILITY LIST",
    "RMW MIDDLEWARE",
    "ROS 2 INFORMATION",
    "TOPIC LIST",
]
"""Those of the real one, in its order."""


def titles(ran: Ran) -> list[str]:
    """The sections that were printed."""
    return [line.strip() for line in ran.lines if line.startswith("   ")]


def items(ran: Ran, title: str) -> list[tuple[str, str]]:
    """What a section says."""
    lines = ran.lines[ran.lines.index(f"   {title}") + 1 :]
    end = lines.index("") if "" in lines else len(lines)
    parted = (line.partition(": ") for line in lines[:end])
    return [(name.rstrip(), said) for name, _, said in parted]


@pytest.fixture(scope="module")
def report(workshop: Shell) -> Ran:
    """The whole report, beside nodes that run."""
    return inside.run(workshop, "doctor", "--report")


@shows("doctor", "--report")
def test_the_report_has_the_sections_of_the_real_one(report: Ran, workshop: Shell) -> None:
    """In its order, and `wtf` and `-r` are the same."""
    assert (report.code, report.err) == (0, "")
    assert titles(report) == TITLES == [part.title for part in PARTS]
    assert titles(inside.run(workshop, "wtf", "-r")) == TITLES


def test_a_section_has_the_form_of_the_real_one() -> None:
    """An empty line, the title, and the values in one column, four behind the longest name."""
    section = Section("RMW MIDDLEWARE", (("middleware name", "rmw_x"), ("b", 1)))
    assert section.lines() == [
        "",
        "   RMW MIDDLEWARE",
        "middleware name    : rmw_x",
        "b                  : 1",
    ]


def test_the_report_tells_of_this_computer(report: Ran) -> None:
    """Every network card, the system, the distribution; what is not known is said."""
    network = items(report, "NETWORK CONFIGURATION")
    devices = [said for name, said in network if name == "device"]
    assert devices == [name for _, name in socket.if_nameindex()]
    assert ("system", "Linux") in items(report, "PLATFORM INFORMATION")
    ros = dict(items(report, "ROS 2 INFORMATION"))
    assert ros["distribution name"] == "jazzy"
    assert ros["distribution status"].startswith("not known here")
    assert items(report, "RMW MIDDLEWARE") == [("middleware name", "rmw_fastrtps_cpp")]


def test_the_report_has_every_package(report: Ran, workshop: Shell) -> None:
    """With its version; that of the newest one is not known, and that is said."""
    versions = dict(items(report, "PACKAGE VERSIONS"))
    assert versions.pop("latest").startswith("not known here")
    assert list(versions) == inside.run(workshop, "pkg", "list").lines
    assert re.fullmatch(r"latest=N/A, local=\d+\.\d+\.\d+", versions["std_msgs"])


def test_the_report_tells_of_the_nodes_that_run(report: Ran, workshop: Shell) -> None:
    """Every topic but those of every node, with its counts; every pair, with its quality."""
    listed = items(report, "TOPIC LIST")
    names = [said for name, said in listed if name == "topic"]
    everyones = {"/parameter_events", "/rosout"}
    assert names == [n for n in inside.run(workshop, "topic", "list").lines if n not in everyones]
    assert [name for name, _ in listed[:3]] == ["topic", "publisher count", "subscriber count"]
    info = inside.run(workshop, "topic", "info", names[0]).lines
    assert [line.rpartition(" ")[2] for line in info[1:]] == [said for _, said in listed[1:3]]
    pairs = items(report, "QOS COMPATIBILITY LIST")
    assert pairs
    assert {name for name, _ in pairs} <= {
        "topic [type]",
        "publisher node",
        "subscriber node",
        "compatibility status",
    }


def test_the_report_of_an_empty_network(empty: Shell) -> None:
    """As the real one says it."""
    ran = inside.run(empty, "doctor", "-r", "-ep")
    assert items(ran, "TOPIC LIST") == [
        ("topic", "none"),
        ("publisher count", "0"),
        ("subscriber count", "0"),
    ]
    said = [("compatibility status", "No publisher/subscriber pairs found")]
    assert items(ran, "QOS COMPATIBILITY LIST") == said


@shows("doctor", "--exclude-packages")
@with_a_doctor
def test_the_report_without_packages_and_without_addresses(empty: Shell) -> None:
    """`-ep`, and our own `--redact`."""
    ran = inside.run(empty, "doctor", "--report", "--exclude-packages", "--redact")
    assert titles(ran) == [title for title in TITLES if title != "PACKAGE VERSIONS"]
    addresses = [said for name, said in items(ran, "NETWORK CONFIGURATION") if name == "ether"]
    assert set(addresses) <= {"ADDRESS"}


@shows("doctor", "--report-failed", "--include-warnings")
@with_a_doctor
def test_reports_of_what_failed(empty: Shell) -> None:
    """A warning counts only with `-iw`; then its section follows, and the exit code is 1."""
    ill = Shell(empty.environment | {"ROS_LOCALHOST_ONLY": "1"}, empty.folder)
    words = ("doctor", "--only", "localhost-only", "-rf")
    plain = inside.run(ill, *words)
    assert plain.code == 0
    assert "NETWORK CONFIGURATION" not in plain.out
    counted = inside.run(ill, *words, "--include-warnings")
    assert counted.code == 1
    assert counted.out.startswith(plain.out)
    assert "\n   NETWORK CONFIGURATION\n" in counted.out
    assert "TOPIC LIST" not in counted.out
    well = inside.run(empty, *words, "-iw")
    assert (well.code, "NETWORK CONFIGURATION" in well.out) == (0, False)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("-r", "-rf"), "not allowed with argument"),
        (("-r", "--only", "domain-id"), "--only domain-id does not go with --report"),
        (("-rf", "--json"), "--json does not go with --report-failed"),
        pytest.param(("-rf", "--onyl"), "unrecognized arguments: --onyl", marks=with_a_doctor),
        pytest.param(("--onyl",), "unrecognized arguments: --onyl", marks=with_a_doctor),
    ],
)
def test_words_that_do_not_go_together(empty: Shell, words: tuple[str, ...], said: str) -> None:
    """Exit 2, and one line."""
    ran = inside.run(empty, "doctor", *words)
    assert ran.code == 2
    assert said in ran.err


@with_a_doctor
def test_the_help_has_the_words_of_both(empty: Shell) -> None:
    """The doctor's own, and those of the real one."""
    ran = inside.run(empty, "doctor", "--help")
    assert ran.code == 0
    for word in ("--explain", "--report", "-rf", "-iw", "-ep", "hello"):
        assert word in ran.out
