"""What the kernel tells of threads is read right, and quiet is told from work."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from roslings.lockstep.asleep import SystemCall, Watch, by_function, stands_in
from roslings.lockstep.quiet import (
    Gone,
    NoAccount,
    Stat,
    Thread,
    ThreadAccount,
    longest_run_s,
    ran_ns_of,
    slices_of,
    used_s_of,
)

LONG_S = 120.0
STAT = (
    b"25861 (sleep) S 25859 25859 19295 0 -1 4194304 130 0 0 0 0 0 0 0 20 0 1 0 291875 2990080 411 "
    b"18446744073709551615 93850525982720 93850526000649 140720563706960 0 0 0 0 6 0 1 0 0 17 1 0 "
    b"0 0 0 0 93850526014736 93850526016000 93850939260928 140720563710683 140720563710691 "
    b"140720563710691 140720563711977 0\n"
)
ASLEEP = "230 0x0 0x0 0x7ffc0f365a60 0x7ffc0f365aa0 0x0 0x0 0x7ffc0f365a48 0x7fcb09f81503\n"
SELECTS = "23 0x0 0x0 0x0 0x0 0x7ffe3c0 0x0 0x7ffe3a8 0x7f11\n"
SELECTS_FILES = "23 0x5 0x7ffe 0x0 0x0 0x7ffe3c0 0x0 0x7ffe3a8 0x7f11\n"
RATE = "202 0x7f0c 0x189 0x0 0x7f0c9a 0x0 0xffffffff 0x7f0c98 0x7f0d\n"
LOCK = "202 0x7f0c 0x189 0x0 0x0 0x0 0xffffffff 0x7f0c98 0x7f0d\n"
SAYS_SO = "print('there', flush=True); "
SLEEPS = SAYS_SO + "import time\nwhile True: time.sleep(0.2)"
WAITS = SAYS_SO + "import threading; threading.Event().wait()"
WORKS = SAYS_SO + "\nwhile True: pass"
FORKS = (
    "import subprocess, sys; "
    "subprocess.run([sys.executable, '-c', \"print('there', flush=True)\\nwhile True: pass\"])"
)
LEAVES = SAYS_SO + "import sys; sys.stdin.readline()"


@contextmanager
def program(text: str) -> Iterator[subprocess.Popen[bytes]]:
    """A process that has said that it is there; its children go with it."""
    words = [sys.executable, "-c", text]
    pipe = subprocess.PIPE
    with subprocess.Popen(words, stdin=pipe, stdout=pipe, start_new_session=True) as process:
        assert process.stdout
        assert process.stdout.readline() == b"there\n"
        try:
            yield process
        finally:
            os.killpg(process.pid, 9)


def until(holds: Callable[[], bool]) -> bool:
    """Whether it holds at last; how long a start takes nobody knows."""
    ends_s = time.monotonic() + LONG_S
    while not (held := holds()) and time.monotonic() < ends_s:
        time.sleep(0.01)
    return held


def test_a_threads_state_stands_behind_its_name() -> None:
    """Name, state and number of threads, of a real line."""
    assert Stat.of(STAT) == Stat("sleep", "S", 1)


@pytest.mark.parametrize("name", ["a b", ") R (", "(R)", "S) R 1"])
def test_a_name_may_hold_anything(name: str) -> None:
    """A student's thread may have any name of 15 bytes."""
    assert Stat.of(STAT.replace(b"sleep", name.encode())) == Stat(name, "S", 1)


def test_time_slices_are_the_third_number() -> None:
    """After the time on a processor and the time of waiting for one."""
    assert slices_of(b"1518928 449062 17\n") == 17
    assert ran_ns_of(b"1518928 449062 17\n") == 1518928


def test_the_longest_run_is_that_of_one_thread() -> None:
    """One that is new began at nothing; one that has ended counts no more."""
    assert longest_run_s({1: 5, 2: 10**9}, {1: 10**9, 2: 3 * 10**9, 3: 10**9}) == 2.0
    assert longest_run_s({1: 5}, {}) == 0.0


def test_what_a_process_has_used_is_in_ticks() -> None:
    """Its own time, that of the kernel for it, and both of its children that have ended."""
    text = STAT.replace(b" 130 0 0 0 0 0 0 0 ", b" 130 7 7 7 100 20 3 1 ")
    assert used_s_of(text) == pytest.approx(124 / os.sysconf("SC_CLK_TCK"))
    assert used_s_of(STAT) == 0.0


@pytest.mark.parametrize(
    ("text", "machine", "stands"),
    [
        (ASLEEP, "x86_64", "sleeps"),
        (SELECTS, "x86_64", "sleeps"),
        (SELECTS_FILES, "x86_64", "elsewhere"),
        (RATE, "x86_64", "waits with a time-out"),
        (LOCK, "x86_64", "elsewhere"),
        (ASLEEP.replace("230", "115"), "aarch64", "sleeps"),
        (RATE.replace("202", "98"), "aarch64", "waits with a time-out"),
        (ASLEEP, "aarch64", "elsewhere"),
        (ASLEEP, "riscv64", "unknown"),
    ],
)
def test_where_a_thread_stands(text: str, machine: str, stands: str) -> None:
    """A sleep is named, a wait with a time-out is another thing."""
    call = SystemCall.of(text)
    assert call
    assert call.stands(machine) == stands


@pytest.mark.parametrize("text", ["running\n", "-1 0x7ffe 0x7f11\n", ""])
def test_a_thread_that_runs_stands_nowhere(text: str) -> None:
    """Nor one that the kernel holds outside of a call."""
    assert SystemCall.of(text) is None


def test_who_waits_is_quiet() -> None:
    """However long one looks."""
    with program(WAITS) as process, ThreadAccount([process.pid], ours=False) as account:
        account.check()
        assert account.is_quiet_within(LONG_S)
        assert account.look().busy == ()
        assert account.is_quiet_within(0.0), "two looks are taken, however late the first one is"


def test_who_works_is_not() -> None:
    """It is named."""
    with program(WORKS) as process, ThreadAccount([process.pid], ours=False) as account:
        account.check()
        assert not account.is_quiet_within(0.3)
        assert account.look().busy


def test_who_works_has_a_processor_and_who_waits_has_none() -> None:
    """However busy the machine is: nobody's waiting for a processor is in it."""
    with program(WORKS) as process, ThreadAccount([process.pid], ours=False) as account:
        account.check()
        before, used_s = account.ran_ns(), account.used_s()
        assert until(lambda: longest_run_s(before, account.ran_ns()) > 0.01)
        assert until(lambda: account.used_s() > used_s)
    with program(WAITS) as process, ThreadAccount([process.pid], ours=False) as account:
        assert account.is_quiet_within(LONG_S)
        before, used_s = account.ran_ns(), account.used_s()
        assert account.is_quiet_within(LONG_S)
        assert longest_run_s(before, account.ran_ns()) < 0.05
        assert account.used_s() - used_s < 0.05


def test_a_child_at_work_counts() -> None:
    """A launch file's nodes are its children."""
    with program(FORKS) as process, ThreadAccount([process.pid], ours=False) as account:
        assert not account.is_quiet_within(0.3)


def test_who_has_ended_is_gone() -> None:
    """Also in the middle of a watch."""
    with program(LEAVES) as process, ThreadAccount([process.pid], ours=False) as account:
        assert account.is_quiet_within(LONG_S)
        assert process.stdin
        process.stdin.close()

        def is_gone() -> bool:
            try:
                account.is_quiet_within(0.1)
            except Gone as gone:
                return gone.pid == process.pid
            return False

        assert until(is_gone)


def test_without_proc_there_is_no_account(tmp_path: Path) -> None:
    """As on macOS: the caller takes real time, and says so."""
    with ThreadAccount([os.getpid()], tmp_path) as account, pytest.raises(NoAccount) as error:
        account.check()
    assert str(error.value).startswith("The nodes cannot be watched step by step here: there is no")


def test_hidden_processes_are_no_account(tmp_path: Path) -> None:
    """As where /proc is mounted with hidepid: a process lives, and is not to be seen."""
    (tmp_path / "self").mkdir()
    (tmp_path / "self/stat").write_bytes(STAT)
    with (
        ThreadAccount([os.getpid()], tmp_path) as account,
        pytest.raises(NoAccount, match="hidepid"),
    ):
        account.check()


def test_a_kernel_that_counts_no_slices_is_no_account(tmp_path: Path) -> None:
    """It writes zeros."""
    pid = os.getpid()
    (tmp_path / "self").symlink_to(str(pid))
    task = tmp_path / f"{pid}/task/{pid}1"
    task.mkdir(parents=True)
    for folder in (task, tmp_path / str(pid)):
        (folder / "stat").write_bytes(STAT)
    (task / "schedstat").write_bytes(b"0 0 0\n")
    with (
        ThreadAccount([pid], tmp_path, ours=False) as account,
        pytest.raises(NoAccount, match="schedst"),
    ):
        account.check()


def test_who_sleeps_is_named() -> None:
    """By its process and its thread, when it was seen again."""
    with program(SLEEPS) as process, ThreadAccount([process.pid], ours=False) as account:
        watch = Watch(account)
        account.check()

        def is_named() -> bool:
            watch.look()
            return bool(watch.sleepers)

        assert until(is_named)
        (sleeper,) = watch.sleepers
        assert sleeper.pid == process.pid
        assert "its main thread" in sleeper.words
        assert "sleeps on the wall clock" in sleeper.words


def test_who_waits_for_an_event_is_not_named() -> None:
    """Its call is that of all the middleware's threads."""
    with program(WAITS) as process, ThreadAccount([process.pid], ours=False) as account:
        assert account.is_quiet_within(LONG_S)
        watch = Watch(account)
        for _ in range(5):
            watch.look()
        assert watch.sleepers == ()


def test_the_function_tells_the_same_where_the_call_is_hidden() -> None:
    """Ubuntu's kernel tells the call only to whoever began the process."""
    with program(SLEEPS) as process:
        thread = Thread(Path(f"/proc/{process.pid}/task/{process.pid}"))
        assert until(lambda: stands_in(thread) == "sleeps")
        assert until(lambda: by_function(thread) == "sleeps")
        thread.close()
