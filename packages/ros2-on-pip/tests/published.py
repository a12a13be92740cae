"""Every verb and option of the published command line of Jazzy (ros2cli 0.32), and who shows it.

Bag, launch and component have words of their own here. `-h` is everywhere.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

Test = TypeVar("Test", bound=Callable[..., object])

DIRECT = ("--spin-time", "--use-sim-time")
LOOK = (*DIRECT, "--no-daemon")
QOS = (
    "--qos-profile",
    "--qos-depth",
    "--qos-history",
    "--qos-reliability",
    "--qos-durability",
    "--qos-liveliness",
    "--qos-liveliness-lease-duration-seconds",
)
SHAPE = (
    "--csv",
    "--full-length",
    "--truncate-length",
    "--no-arr",
    "--no-str",
    "--flow-style",
)
OF_NODE = (*LOOK, "--include-hidden-nodes")
KINDS = ("--only-msgs", "--only-srvs", "--only-actions")

PUBLISHED: dict[str, tuple[str, ...]] = {
    "action info": (*LOOK, "--show-types", "--count"),
    "action list": (*LOOK, "--show-types", "--count-actions"),
    "action send_goal": ("--stdin", "--feedback"),
    "action type": LOOK,
    "daemon start": ("--debug",),
    "daemon status": (),
    "daemon stop": (),
    "doctor": ("--report", "--report-failed", "--exclude-packages", "--include-warnings"),
    "interface list": KINDS,
    "interface package": KINDS,
    "interface packages": KINDS,
    "interface proto": ("--no-quotes",),
    "interface show": ("--all-comments", "--no-comments"),
    "lifecycle get": OF_NODE,
    "lifecycle list": (*OF_NODE, "--all"),
    "lifecycle nodes": (*LOOK, "--all", "--count-nodes"),
    "lifecycle set": OF_NODE,
    "multicast receive": ("--group", "--port"),
    "multicast send": ("--group", "--port", "--ttl"),
    "node info": (*LOOK, "--include-hidden"),
    "node list": (*LOOK, "--all", "--count-nodes"),
    "param delete": (*OF_NODE, "--timeout"),
    "param describe": (*OF_NODE, "--timeout"),
    "param dump": (*OF_NODE, "--timeout"),
    "param get": (*OF_NODE, "--timeout", "--hide-type"),
    "param list": (*OF_NODE, "--filter", "--param-prefixes", "--param-type"),
    "param load": (*OF_NODE, "--timeout", "--no-use-wildcard"),
    "param set": (*OF_NODE, "--timeout"),
    "pkg create": (
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
    ),
    "pkg executables": ("--full-path",),
    "pkg list": (),
    "pkg prefix": ("--share",),
    "pkg xml": ("--tag",),
    "run": ("--prefix",),
    "service": ("--include-hidden-services",),
    "service call": ("--stdin", "--rate"),
    "service echo": (*SHAPE, *QOS),
    "service find": ("--count-services", "--include-hidden-services"),
    "service info": LOOK,
    "service list": (*LOOK, "--show-types", "--count-services", "--include-hidden-services"),
    "service type": LOOK,
    "topic": ("--include-hidden-topics",),
    "topic bw": (*DIRECT, "--window"),
    "topic delay": (*DIRECT, "--window"),
    "topic echo": (
        *LOOK,
        *QOS,
        *SHAPE,
        "--field",
        "--filter",
        "--include-message-info",
        "--no-lost-messages",
        "--once",
        "--raw",
        "--timeout",
    ),
    "topic find": (*LOOK, "--count-topics", "--include-hidden-topics"),
    "topic hz": (*DIRECT, "--window", "--filter", "--wall-time"),
    "topic info": (*LOOK, "--verbose"),
    "topic list": (
        *LOOK,
        "--show-types",
        "--count-topics",
        "--include-hidden-topics",
        "--verbose",
    ),
    "topic pub": (
        *DIRECT,
        *QOS,
        "--stdin",
        "--rate",
        "--print",
        "--once",
        "--times",
        "--wait-matching-subscriptions",
        "--max-wait-time-secs",
        "--keep-alive",
        "--node-name",
    ),
    "topic type": LOOK,
    "wtf hello": ("--topic", "--emit-period", "--print-period", "--ttl", "--once"),
}

SHORT: dict[str, str] = {
    "action info": "-t -c -s",
    "action list": "-t -c -s",
    "action send_goal": "-f",
    "daemon start": "-d",
    "doctor": "-r -rf -ep -iw",
    "interface list": "-m -s -a",
    "interface package": "-m -s -a",
    "interface packages": "-m -s -a",
    "lifecycle list": "-a -s",
    "lifecycle nodes": "-a -c -s",
    "node list": "-a -c -s",
    "pkg create": "--package_format",
    "pkg xml": "-t",
    "service call": "-r",
    "service echo": "-f -l",
    "service find": "-c",
    "service list": "-t -c -s",
    "topic bw": "-w -s",
    "topic delay": "-w -s",
    "topic echo": "-i -f -l -s",
    "topic find": "-c -s",
    "topic hz": "-w -s",
    "topic info": "-v -s",
    "topic list": "-t -c -v -s",
    "topic pub": "-r -p -1 -t -w -n -s",
    "wtf hello": "-t -ep -pp -1",
}
"""The other forms of a verb's options; of those that are not here, `-s` alone where it looks."""

SHOWN: set[tuple[str, str]] = set()
"""Verb and option that some test shows; a verb's own showing has an empty option."""


def shows(verb: str, *options: str) -> Callable[[Test], Test]:
    """Marks a test that shows what `options` of `verb` change in the output, and the verb."""
    SHOWN.add((verb, ""))
    SHOWN.update((verb, option) for option in options)

    def same(test: Test) -> Test:
        return test

    return same
