"""Figures of `ros2`: how long words take, how complete a look is, what `hz` costs.

    python tests/bench/ros2.py [TRIES [PART...]]

PART is `alone`, `plain`, `bare`, `ten`, `bare-ten` or `hz`; by default all. It prints, and asserts
nothing. `plain` is beside one node, and `ten` beside ten, each started by plain `python3` in a
terminal that has sourced setup.bash; with `bare`, in one that has not, where nodes announce
themselves every 3 s.
"""

from __future__ import annotations

import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from ros2_on_pip.domain_lease import leased_domain
from roslings.arena import QUICK_DISCOVERY

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "packages/ros2-on-pip/tests"))

from terminal import Ran, Shell, surroundings

NODES = 10
TOPICS = 3
TRIES = 50
PARTS = ("alone", "plain", "bare", "ten", "bare-ten", "hz")
HZ_WATCH_S = 10.0
SOURCED = {"FASTRTPS_DEFAULT_PROFILES_FILE": str(QUICK_DISCOVERY)}
"""What `source setup.bash` sets for a node that one starts by hand."""

PLAIN = (
    "import sys; sys.argv[1:] = ['--ros-args', '-r', '__node:=' + sys.argv[1]];"
    "from ros2_on_pip.demo_nodes_py.talker import main; main()"
)


def main(tries: int, parts: list[str]) -> None:
    """Print the figures of `parts`."""
    memory_gb = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    print(
        f"{os.cpu_count()} cores, {memory_gb:.0f} GB, Python {platform.python_version()},"
        f" load {os.getloadavg()[0]:.1f}"
    )
    with tempfile.TemporaryDirectory() as home, leased_domain() as domain:
        shell = Shell(surroundings(domain, Path(home)), Path(home))
        if "alone" in parts:
            timed("--help", lambda: shell("--help"))
            timed("topic --help", lambda: shell("topic", "--help"))
            timed("node list, nothing runs", lambda: shell("node", "list"))
        for part, count, settings in (
            ("plain", 1, SOURCED),
            ("bare", 1, {}),
            ("ten", NODES, SOURCED),
            ("bare-ten", NODES, {}),
        ):
            if part in parts:
                beside(shell, count, tries, settings)
        if "hz" in parts:
            measure_hz(shell)


def beside(shell: Shell, count: int, tries: int, settings: dict[str, str]) -> None:
    """Lists and the first message beside `count` nodes."""
    with talkers(shell, count, settings):
        print(f"{count} by plain python3, setup.bash {'' if settings else 'not '}sourced")
        repeated("node list", tries, lambda: shell("node", "list"), count)
        repeated("topic list", tries, lambda: shell("topic", "list"), TOPICS)
        once = ("topic", "echo", "--once", "/chatter")
        repeated("echo --once", tries, lambda: shell(*once), 2)


def timed(title: str, act: Callable[[], object], times: int = 7) -> None:
    """Print the median and the longest of several runs."""
    taken = []
    for _ in range(times):
        began_s = time.perf_counter()
        act()
        taken.append(time.perf_counter() - began_s)
    print(f"{title:34} median {statistics.median(taken):5.2f} s   longest {max(taken):5.2f} s")


@contextmanager
def talkers(shell: Shell, count: int, settings: dict[str, str]) -> Iterator[None]:
    """Talkers of different names, until the block ends."""
    local = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", **settings}
    with ExitStack() as stack:
        running = [
            stack.enter_context(
                shell.program([sys.executable, "-c", PLAIN, f"talker_{n}"], **local)
            )
            for n in range(count)
        ]
        for one in running:
            one.wait_for("Publishing")
        yield


def repeated(title: str, tries: int, act: Callable[[], Ran], lines: int) -> None:
    """How long `act` takes, and how often it prints all its `lines`."""
    whole, taken = 0, []
    for _ in range(tries):
        began_s = time.perf_counter()
        whole += len(act().lines) == lines
        taken.append(time.perf_counter() - began_s)
    print(
        f"  {title:12} complete in {whole} of {tries} tries,"
        f" p50 {statistics.median(taken):.2f} s, max {max(taken):.2f} s",
        flush=True,
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
        count = int(sys.argv[1]) if len(sys.argv) > 1 else TRIES
        main(count, sys.argv[2:] or list(PARTS))
    except subprocess.TimeoutExpired as fault:
        sys.exit(f"a command hangs: {fault.cmd}")
