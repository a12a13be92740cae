"""Figures of `ros2`: how long words take, how complete a look is, what `hz` costs.

    python tests/bench/ros2.py [TRIES]

It prints, and asserts nothing. The nodes are started by our own `ros2 run`, and once more in plain
Python, without our discovery file.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from roslings.arena.lease import leased_domain

sys.path.insert(0, str(Path(__file__).parents[1] / "ros2"))

from terminal import Shell, ours, surroundings

NODES = 10
TOPICS = 3
HZ_WATCH_S = 10.0
PLAIN = (
    "import sys; sys.argv[1:] = ['--ros-args', '-r', '__node:=' + sys.argv[1]];"
    "from roslings.ros2.demo_nodes_py.talker import main; main()"
)


def main(tries: int) -> None:
    """Print all figures."""
    print(f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    with tempfile.TemporaryDirectory() as home, leased_domain() as domain:
        shell = Shell(surroundings(domain, Path(home)), Path(home))
        timed("--help", lambda: shell("--help"))
        timed("topic --help", lambda: shell("topic", "--help"))
        timed("node list, nothing runs", lambda: shell("node", "list"))
        with talkers(shell, 1):
            timed("node list, 1 node", lambda: shell("node", "list"))
            timed(
                "first topic echo message (1 Hz)",
                lambda: shell("topic", "echo", "--once", "/chatter"),
            )
        measure_hz(shell)
        for title, plain in (("started by ros2 run", False), ("started by plain python", True)):
            with talkers(shell, NODES, plain):
                print(f"{NODES} nodes {title}")
                completeness(shell, "node", NODES, tries)
                completeness(shell, "topic", TOPICS, tries)


def timed(title: str, act: Callable[[], object], times: int = 7) -> None:
    """Print the median and the longest of several runs."""
    taken = []
    for _ in range(times):
        began_s = time.perf_counter()
        act()
        taken.append(time.perf_counter() - began_s)
    print(f"{title:34} median {statistics.median(taken):5.2f} s   longest {max(taken):5.2f} s")


@contextmanager
def talkers(shell: Shell, count: int, plain: bool = False) -> Iterator[None]:
    """Talkers of different names, until the block ends."""
    with ExitStack() as stack:
        for number in range(count):
            name = f"talker_{number}"
            command = (
                [sys.executable, "-c", PLAIN, name]
                if plain
                else ours("run", "demo_nodes_py", "talker", "--ros-args", "-r", f"__node:={name}")
            )
            local = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
            stack.enter_context(shell.program(command, **local)).wait_for("Publishing")
        yield


def completeness(shell: Shell, what: str, expected: int, tries: int) -> None:
    """How often a list had everything in it."""
    whole, taken = 0, []
    for _ in range(tries):
        began_s = time.perf_counter()
        whole += len(shell(what, "list").lines) == expected
        taken.append(time.perf_counter() - began_s)
    print(
        f"  {what} list: complete in {whole} of {tries} tries,"
        f" median {statistics.median(taken):.2f} s, longest {max(taken):.2f} s"
    )


def measure_hz(shell: Shell) -> None:
    """The first line of `hz` at 200 Hz, and its CPU time afterwards."""
    words = ("topic", "pub", "-r", "200", "-p", "0", "/fast", "std_msgs/msg/String", "{data: x}")
    with shell.start(*words) as pub:
        pub.wait_for("beginning loop")
        began_s = time.perf_counter()
        with shell.start("topic", "hz", "/fast") as hz:
            hz.wait_for("average rate")
            print(f"{'first topic hz line (200 Hz)':34} {time.perf_counter() - began_s:12.2f} s")
            before_s = cpu_s(hz.process.pid)
            time.sleep(HZ_WATCH_S)
            used = (cpu_s(hz.process.pid) - before_s) / HZ_WATCH_S
            print(f"topic hz at 200 Hz uses {used:.0%} of a core; its last lines:")
            print("\n".join(f"    {line}" for line in hz.lines[-3:]))


def cpu_s(pid: int) -> float:
    """CPU seconds that a process has used: fields 14 and 15 of /proc/PID/stat."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    try:
        main(int(sys.argv[1]) if len(sys.argv) > 1 else 50)
    except subprocess.TimeoutExpired as fault:
        sys.exit(f"a command hangs: {fault.cmd}")
