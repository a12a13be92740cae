"""The kernel's account of some processes: whether anything in them runs, or has run.

A set of processes is quiet when two looks in a row find two things. Each thread is asleep (state
S), and none has had a time slice in between. A message that was sent wakes its receiver at once, so
whoever looks after that finds it at work. Quiet means that it has done all that the message led to.
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.rates import NS_PER_S

PROC = Path("/proc")
CAP_S = 10.0
"""rclpy's MultiThreadedExecutor may submit one waiting task again and again for 2 s of its own."""
PAUSE_S = 0.0001
"""After a look that found somebody at work: else we take the processor that the nodes need."""
ENDED = frozenset("ZX")
RESTS = ENDED | {"S"}
"""States of a thread that does nothing: at its end, or asleep."""

LOOKS_AFTER_THE_END = 3
LONGEST_TEXT = 4096
"""Of one of the kernel's files about a thread."""

Slices = dict[int, int]
"""How often each thread has got a processor, by its number."""
RanNs = dict[int, int]
"""For how long each thread has had a processor, by its number."""
USER_TIME = 11
"""Of the fields behind a process's name in proc_pid_stat(5); three more of a kind follow."""
TICKS_PER_S = os.sysconf("SC_CLK_TCK")


class NoAccount(Exception):
    """The kernel tells nothing here: take real time instead, and say so."""

    def __init__(self, lack: str) -> None:
        super().__init__(
            f"The nodes cannot be watched step by step here: {lack}. They are judged in real time."
        )


class Gone(Exception):
    """A process ended while the world was with it."""

    def __init__(self, pid: int) -> None:
        self.pid = pid
        super().__init__(f"The process {pid} has ended.")


class NeverQuiet(Exception):
    """Something ran on and on: no time can pass in lockstep with it."""

    def __init__(self, waited_s: float, busy: Sequence[str]) -> None:
        self.busy = tuple(busy)
        """The threads that ran at the last look, by their names."""
        who = ", ".join(busy) or "a thread"
        super().__init__(
            f"After {waited_s:.1f} s something still runs in your nodes: {who}. "
            "Look for a loop that never waits, such as `while` with `spin_once(timeout_sec=0)`."
        )


@dataclass(frozen=True)
class Stat:
    """What /proc/PID/task/TID/stat tells of a thread."""

    name: str
    state: str
    threads: int
    """So many its process has."""

    @classmethod
    def of(cls, text: bytes) -> Stat:
        """The name may hold anything, brackets and blanks too: the last bracket ends it."""
        before, _, after = text.rpartition(b")")
        fields = after.split(maxsplit=18)
        name = before.partition(b"(")[2].decode(errors="replace")
        return cls(name, fields[0].decode(), int(fields[17]))


def slices_of(text: bytes) -> int:
    """The third number of schedstat: how often the thread has got a processor."""
    return int(text.split()[2])


def ran_ns_of(text: bytes) -> int:
    """The first number of schedstat: for how long the thread has had a processor."""
    return int(text.split()[0])


def longest_run_s(before: RanNs, now: RanNs) -> float:
    """Of all threads, the longest time for which one had a processor meanwhile, in seconds."""
    return max((ran - before.get(each, 0) for each, ran in now.items()), default=0) / NS_PER_S


def fields_of_stat(text: bytes) -> list[bytes]:
    """Of a process's stat, what stands behind its name, in which any brackets may be."""
    return text.rpartition(b")")[2].split()


def used_s_of(text: bytes) -> float:
    """Of a process's stat: what it and its children that have ended have used of processors."""
    fields = fields_of_stat(text)
    return sum(map(int, fields[USER_TIME : USER_TIME + 4])) / TICKS_PER_S


class Thread:
    """One thread, by files that stay open: to open them for each look takes ten times as long.

    Each method raises ProcessLookupError or FileNotFoundError where it has ended.
    """

    def __init__(self, folder: Path) -> None:
        self.folder, self.number = folder, int(folder.name)
        self._files: dict[str, int] = {}

    def close(self) -> None:
        """Nothing can be asked any more."""
        while self._files:
            os.close(self._files.popitem()[1])

    def read(self, name: str) -> bytes:
        """One of the kernel's files about it. Raises OSError, too, where it may not be read."""
        if name not in self._files:
            self._files[name] = os.open(self.folder / name, os.O_RDONLY | os.O_CLOEXEC)
        return os.pread(self._files[name], LONGEST_TEXT, 0)

    def stat(self) -> Stat:
        """Its name and state."""
        return Stat.of(self.read("stat"))

    def slices(self) -> int:
        """How often it has got a processor."""
        return slices_of(self.read("schedstat"))

    def ran_ns(self) -> int:
        """For how long it has had a processor."""
        return ran_ns_of(self.read("schedstat"))

    def children(self) -> list[int]:
        """Processes that it has begun. A kernel without CONFIG_PROC_CHILDREN tells none."""
        try:
            return [int(word) for word in self.read("children").split()]
        except (FileNotFoundError, ProcessLookupError):
            return []


@dataclass(frozen=True)
class ThreadSnapshot:
    """All threads at one moment."""

    slices: Slices
    busy: tuple[str, ...]
    """Names of those that do not rest."""


class ThreadAccount:
    """Of these processes and all their children; of our own other threads, too, with `ours`.

    Those of the middleware in this process take part in what is said. A context manager: leaving
    the block closes the kernel's files.
    """

    def __init__(self, pids: Sequence[int], proc: Path = PROC, ours: bool = True) -> None:
        self.pids, self.proc, self.ours = tuple(pids), proc, ours
        self._threads: dict[int, list[Thread]] = {}
        """By process, as they were when their number was last another."""

    def __enter__(self) -> ThreadAccount:
        return self

    def __exit__(self, *error: object) -> None:
        for pid in tuple(self._threads):
            self._forget(pid)

    def check(self) -> None:
        """Raises NoAccount where the kernel tells nothing of them, and Gone where one has ended."""
        if not os.access(self.proc / "self" / "stat", os.R_OK):
            raise NoAccount(f"there is no {self.proc}")
        for pid in self.pids:
            if not _lives(pid):
                raise Gone(pid)
            if not os.access(self.proc / str(pid) / "stat", os.R_OK):
                raise NoAccount(f"{self.proc} hides other processes (hidepid)")
        slices = self.look().slices
        if not all(slices.get(pid) for pid in self.pids):
            raise NoAccount("the kernel counts no time slices (schedstat)")

    def look(self, whole: bool = True) -> ThreadSnapshot:
        """Once, at all threads; else no further than to the first that runs."""
        if not self._threads:
            self._find_processes()
        slices: Slices = {}
        busy: list[str] = []
        for pid in self._threads:
            busy += self._look_at(pid, slices, whole)
            if busy and not whole:
                break
        return ThreadSnapshot(slices, tuple(busy))

    def threads_of_nodes(self) -> Iterator[tuple[int, Thread]]:
        """Each thread and its process, ours left out."""
        for pid, threads in self._threads.items():
            if pid != os.getpid():
                yield from ((pid, each) for each in threads)

    def ran_ns(self) -> RanNs:
        """Of the nodes' threads, so far: a busy machine makes it no more."""
        found: RanNs = {}
        for _, thread in self.threads_of_nodes():
            with suppress(FileNotFoundError, ProcessLookupError):
                found[thread.number] = thread.ran_ns()
        return found

    def used_s(self) -> float:
        """Of processors, by all processes of the nodes, so far. A thread that has ended counts."""
        return sum(self._used_s(pid) for pid in self._threads if pid != os.getpid())

    def _used_s(self, pid: int) -> float:
        with suppress(FileNotFoundError, ProcessLookupError):
            return used_s_of((self.proc / str(pid) / "stat").read_bytes())
        return 0.0

    def is_quiet_within(self, within_s: float) -> bool:
        """Wait for quiet, so long at most. Raises Gone where one of the processes has ended.

        Whoever was asleep at the last look is looked at once more. On a busy machine the time may
        be over before a second look.
        """
        ends_s = time.monotonic() + within_s
        last: Slices | None = None
        looks_left = LOOKS_AFTER_THE_END
        while True:
            now = self.look(whole=False)
            if now.busy:
                last = None
            elif now.slices == last:
                if self._knows_all_children():
                    return True
                self._find_processes()
                last = None
            else:
                last = now.slices
            if time.monotonic() >= ends_s:
                if last is None or not looks_left:
                    return False
                looks_left -= 1
            if now.busy:
                time.sleep(PAUSE_S)

    def _look_at(self, pid: int, slices: Slices, whole: bool) -> list[str]:
        """At one process: who runs. One that has fewer or more threads now counts as running."""
        busy: list[str] = []
        count = 0
        try:
            for thread in self._threads[pid]:
                slices[thread.number] = thread.slices()
                stat = thread.stat()
                count = self._count(pid, thread, stat)
                if stat.state not in RESTS:
                    busy.append(stat.name)
                    if not whole:
                        return busy
        except (FileNotFoundError, ProcessLookupError):
            count = 0
        if count != len(self._threads[pid]) + (pid == os.getpid()):
            self._list_threads(pid)
            busy.append(f"a thread that has just begun or ended in process {pid}")
        return busy

    def _count(self, pid: int, thread: Thread, stat: Stat) -> int:
        """So many threads there are. A process at its end stays until somebody asks after it."""
        if thread.number == pid and stat.state in ENDED and pid in self.pids:
            raise Gone(pid)
        return stat.threads

    def _knows_all_children(self) -> bool:
        """None was born since they were looked for."""
        return all(
            child in self._threads
            for _, thread in self.threads_of_nodes()
            for child in thread.children()
        )

    def _find_processes(self) -> None:
        """All that are alive. Raises Gone."""
        for pid in tuple(self._threads):
            self._forget(pid)
        for pid in self.pids:
            self._find(pid)
        if self.ours:
            self._list_threads(os.getpid())

    def _find(self, pid: int) -> None:
        """A process and its children."""
        self._list_threads(pid)
        for thread in self._threads[pid]:
            for child in thread.children():
                self._find(child)

    def _forget(self, pid: int) -> None:
        for thread in self._threads.pop(pid, ()):
            thread.close()

    def _list_threads(self, pid: int) -> None:
        """Its place among the processes stays. Raises Gone where it is one of those asked for."""
        for thread in self._threads.get(pid, ()):
            thread.close()
        self._threads[pid] = self._found_threads(pid)
        if pid in self.pids and not self._runs(pid):
            raise Gone(pid)

    def _found_threads(self, pid: int) -> list[Thread]:
        me = threading.get_native_id()
        with suppress(FileNotFoundError, ProcessLookupError):
            folders = [*(self.proc / str(pid) / "task").iterdir()]
            return [Thread(each) for each in folders if int(each.name) != me]
        return []

    def _runs(self, pid: int) -> bool:
        with suppress(FileNotFoundError, ProcessLookupError):
            state = Stat.of((self.proc / str(pid) / "stat").read_bytes()).state
            return state not in ENDED
        return False


def _lives(pid: int) -> bool:
    """Whether there is such a process, whatever /proc shows of it."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True
