"""Prints how long a launch takes until its last node is there, over the sum of its nodes' starts.

    python tests/bench/launch.py [TRIES [NODES]]

The same nodes, from a launch file in each language, and one after the other by hand. Each node
writes a line when it is complete; the time runs to the last of these lines. It asserts nothing.
"""

from __future__ import annotations

import os
import platform
import statistics
import sys
import tempfile
import time
from pathlib import Path

from ros2_on_pip.domain_lease import leased_domain

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "packages/ros2-on-pip/tests"))

from launch_shop import package, written
from terminal import Shell, surroundings

TRIES, NODES = 20, 3
READY = "told"
FILES = {
    "a.launch.py": """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="mine", executable="teller", name=f"n{number}", arguments=["stay"])
        for number in range(COUNT)
    ])
""",
    "a.launch.xml": "<launch>EACH</launch>",
    "a.launch.yaml": "launch:\nEACH",
}
EACH = {
    "a.launch.py": "",
    "a.launch.xml": '<node pkg="mine" exec="teller" name="nNUMBER" args="stay"/>',
    "a.launch.yaml": "- node: {pkg: mine, exec: teller, name: nNUMBER, args: stay}\n",
}


def main(tries: int, count: int) -> None:
    """A line a language."""
    print(
        f"{os.cpu_count()} cores, Python {platform.python_version()},"
        f" load {os.getloadavg()[0]:.1f}, {count} nodes, {tries} tries"
    )
    with tempfile.TemporaryDirectory() as home, leased_domain() as domain:
        shell = package(Shell(surroundings(domain, Path(home)), Path(home)), Path(home))
        for name, text in FILES.items():
            each = "".join(EACH[name].replace("NUMBER", str(n)) for n in range(count))
            written(Path(home), name, text.replace("COUNT", str(count)).replace("EACH", each))
        times: dict[str, list[float]] = {name: [] for name in FILES}
        alone: list[float] = []
        for _ in range(tries):  # in turn: a busy computer makes all of them slow
            alone.append(sum(node_s(shell) for _ in range(count)))
            for name, taken in times.items():
                taken.append(launch_s(shell, name, count))
    base = statistics.median(alone)
    print(f"{'the nodes, one by one':24}{base:7.2f} s   1.00")
    for name, found in times.items():
        middle = statistics.median(found)
        print(
            f"{'ros2 launch ' + name:24}{middle:7.2f} s{middle / base:7.2f}"
            f"   (least {min(found):.2f} s, most {max(found):.2f} s)"
        )


def launch_s(shell: Shell, name: str, count: int) -> float:
    """From the start of `ros2 launch` to the line of its last node."""
    began_s = time.perf_counter()
    with shell.start("launch", name) as launch:
        launch.wait_for(READY, times=count)
        taken_s = time.perf_counter() - began_s
        launch.interrupt()
    return taken_s


def node_s(shell: Shell) -> float:
    """From the start of the program alone to its line."""
    program = str(shell.folder / "lib" / "mine" / "teller")
    began_s = time.perf_counter()
    with shell.program([program, "stay"]) as node:
        node.wait_for(READY)
        taken_s = time.perf_counter() - began_s
        node.interrupt()
    return taken_s


if __name__ == "__main__":
    given = [int(word) for word in sys.argv[1:]]
    main(*[*given, *(TRIES, NODES)[len(given) :]])
