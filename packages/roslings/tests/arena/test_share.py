"""Neighbours: what a sandbox gets of the processors, and whose time a wait is."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path

import pytest
from in_sandbox import bounded, run

from roslings.arena import Launch, Process, Sandbox, cgroup
from skips import needs

LAST_IN_LINE = 19
"""The lowest priority that there is: sched(7)."""
LONGER_THAN_TOO_MANY_MAY_S = 5.0

BUSY = """
    import os, signal, time

    def busy(count):
        for _ in range(count):
            if os.fork() == 0:
                while True:
                    pass

    def priorities():
        return {{os.getpriority(os.PRIO_PROCESS, int(pid)) for pid in os.listdir("/proc")
                if pid.isdigit() and int(pid) > 1}}

    busy({count})
    until = time.monotonic() + {seconds}
    while priorities() != {{{last}}} and time.monotonic() < until:
        time.sleep(0.05)
    print(*priorities())
    print(open("/proc/self/autogroup").read() if os.path.exists("/proc/self/autogroup") else "")
    os.kill(-1, signal.SIGKILL)
"""


def without_groups(sandbox: Sandbox, **bounds: int) -> Sandbox:
    """As where nobody has handed a control group to the grader."""
    return replace(bounded(sandbox, **bounds), trees=())


def test_too_many_busy_threads_go_behind_all_others(sandbox: Sandbox) -> None:
    """Each of them, and their session; that is written down."""
    source = BUSY.format(count=5, seconds=60, last=LAST_IN_LINE)
    seen = run(without_groups(sandbox, busy=4), source)
    words = [line.text for line in seen.lines]
    assert words[0] == str(LAST_IN_LINE)
    assert not words[1] or words[1].endswith(f"nice {LAST_IN_LINE}")
    assert seen.most_busy > 4
    assert seen.bounds_met == []


@pytest.mark.parametrize(("count", "most"), [(3, 4), (5, 0)])
def test_who_is_not_held_back_keeps_the_priority(sandbox: Sandbox, count: int, most: int) -> None:
    """A few, also where they are busy for long; and too many, where this wall is taken away."""
    source = BUSY.format(count=count, seconds=LONGER_THAN_TOO_MANY_MAY_S, last=LAST_IN_LINE)
    seen = run(without_groups(sandbox, busy=most), source)
    assert seen.lines[0].text == "0"
    assert seen.most_busy == 0


def test_nobody_counts_where_the_kernel_gives_each_group_its_share(sandbox: Sandbox) -> None:
    """By the group's controller; elsewhere somebody does."""
    source = BUSY.format(count=5, seconds=LONGER_THAN_TOO_MANY_MAY_S, last=LAST_IN_LINE)
    seen = run(bounded(sandbox, busy=4), source)
    assert (seen.most_busy == 0) == cgroup.shares_processors(sandbox.trees)


ONE_BY_ONE = """
    import os, time
    while True:
        child = os.fork()
        if child == 0:
            while time.process_time() < 0.2:
                pass
            os._exit(0)
        os.waitpid(child, 0)
"""
TOGETHER = """
    import os
    for _ in range(3):
        os.fork()
    while True:
        pass
"""
LEFT_TO_OTHERS = """
    import os, time
    while True:
        if os.fork() == 0:
            if os.fork() == 0:
                while time.process_time() < 0.2:
                    pass
            os._exit(0)
        os.wait()
        time.sleep(0.1)
"""


@pytest.mark.parametrize("source", [ONE_BY_ONE, TOGETHER, LEFT_TO_OTHERS])
def test_time_of_the_processor_is_counted_for_all_together(sandbox: Sandbox, source: str) -> None:
    """Of many that are busy at once, one after the other, or that nobody waits for."""
    assert run(bounded(sandbox, cpu_s=2), source).bounds_met == ["cpu_s"]


# --- a wait in one's own time ------------------------------------------------------------------

TAKES_S = 1.0
NEIGHBOURS = 6
ONE_PROCESSOR = "import os; os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})"
WORKS = f"{ONE_PROCESSOR}\nimport time\nwhile time.process_time() < {TAKES_S}:\n    pass"


@contextmanager
def neighbours(count: int) -> Iterator[None]:
    """Processes that are always busy, on the processor of the one that works."""
    busy = [sys.executable, "-I", "-S", "-c", f"{ONE_PROCESSOR}\nwhile True:\n    pass"]
    with ExitStack() as stack:
        for _ in range(count):
            process = stack.enter_context(subprocess.Popen(busy))
            stack.callback(process.kill)
        yield


def launched(source: str, folder: Path) -> Process:
    """Python without anything around it."""
    command = [sys.executable, "-I", "-S", "-c", textwrap.dedent(source)]
    return Process("it", Launch(command, {"PATH": os.defpath}, folder, namespaces=False))


@needs("schedstat")
def test_neighbours_do_not_shorten_a_wait(tmp_path: Path) -> None:
    """It takes several times as long as it may, and gets that time.

    It may take twice as long as its work does: what a host takes from its guest, and what comes
    from the disk, is time of the process's own.
    """
    with neighbours(NEIGHBOURS), launched(WORKS, tmp_path) as process:
        assert not process.wait_ended(TAKES_S)
        assert process.wait_ended_in_own_time(2 * TAKES_S, most_s=60 * TAKES_S)
    assert process.seen.status == 0


def test_neighbours_do_not_make_it_endless(tmp_path: Path) -> None:
    """So much is given for them, and no more."""
    with neighbours(NEIGHBOURS), launched("while True:\n    pass", tmp_path) as process:
        assert not process.wait_ended_in_own_time(0.2, most_s=0.2)


def test_who_only_sleeps_waits_for_nobody(tmp_path: Path) -> None:
    """Beside busy neighbours, too."""
    source = f"{ONE_PROCESSOR}\nimport time\ntime.sleep(1000)"
    with neighbours(NEIGHBOURS), launched(source, tmp_path) as process:
        assert not process.wait_ended_in_own_time(0.5, most_s=1000)
