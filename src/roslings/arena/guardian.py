"""Script: start one process, keep it company, and leave nothing of it behind.

    python -I -S guardian.py FD

FD is one end of a stream socket pair; the arena holds the other. It first sends one line of
JSON (`Order`), later a signal's name, `WAITS`, or `STATE`, a line. The guardian answers one line
of JSON an event:

    {"started": PID}                       {"said": TEXT, "at": NS}
    {"exited": STATUS, "at": NS, ...}      {"refused": REASON}
    {"answer": {THREAD: NS}}               to WAITS: ready to run, and no processor free, since
                                           it began
    {"answer": LETTER}                     to STATE: of its main thread, as in proc(5); empty where
                                           it has ended

Where the order says `namespaces`, the process lives in a pid namespace whose first process is
this guardian: when the guardian goes, the kernel ends all that the process started. So it is
where the order says `sandbox`: then this guardian was started inside of it. Elsewhere it adopts
orphans and ends them one by one. When the arena's end of the socket closes,
for whatever reason, everything ends. Times are nanoseconds of the monotonic clock.
"""

from __future__ import annotations

import contextlib
import json
import os
import pty
import select
import signal
import socket
import sys
import termios
import time
from collections import deque

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120
import kernel  # type: ignore[import-not-found]

READ_BYTES = 65536
LATEST_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGQUIT, signal.SIGPIPE, signal.SIGHUP)
GRACE_S = 0.2
TEMPORARY = ("/tmp", "/dev/shm")
LOOK_EVERY_S = 0.2
NEARLY = 0.95
"""The kernel keeps it from reaching its bound, or ends one process only."""


class Order:
    """What to start, where, and how much of its output to pass on.

    The modules of dataclasses and paths would double the time of a guardian's start.
    """

    def __init__(
        self,
        command: list[str],
        environment: dict[str, str],
        folder: str,
        walls: str,
        head_bytes: int,
        tail_bytes: int,
        limits: dict[str, int],
        watch: dict[str, int],
    ) -> None:
        """`watch`: the most of `memory`, in bytes, of `pids`, threads too, and of `files`."""
        self.command, self.environment = command, environment
        self.folder, self.walls = folder, walls
        self.head_bytes, self.tail_bytes = head_bytes, tail_bytes
        self.limits, self.watch = limits, watch


class Spout:
    """Passes on the first bytes of an endless output, and keeps the last ones for the end."""

    def __init__(self, head_bytes: int, tail_bytes: int) -> None:
        self.head_left = head_bytes
        self.tail_bytes = tail_bytes
        self.tail: deque[bytes] = deque()
        self.tail_held = 0
        self.total = 0
        self.dropped = 0

    def take(self, chunk: bytes) -> bytes:
        """The part of `chunk` to pass on at once; the rest is held for the end."""
        self.total += len(chunk)
        now, later = chunk[: self.head_left], chunk[self.head_left :]
        self.head_left -= len(now)
        if later:
            self._hold(later)
        return now

    def _hold(self, chunk: bytes) -> None:
        self.tail.append(chunk)
        self.tail_held += len(chunk)
        while self.tail_held - len(self.tail[0]) >= self.tail_bytes:
            lost = len(self.tail.popleft())
            self.tail_held -= lost
            self.dropped += lost

    def rest(self) -> bytes:
        """The last bytes, when all is over."""
        return b"".join(self.tail)


class Guardian:
    """One process, from start to end."""

    def __init__(self, channel: socket.socket, order: Order) -> None:
        self.channel = channel
        self.order = order
        self.spout = Spout(order.head_bytes, order.tail_bytes)
        self.waker, waked = socket.socketpair()
        for end in (self.waker, waked):
            end.setblocking(False)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        signal.set_wakeup_fd(waked.fileno())
        self.waked = waked
        self.pid, self.terminal = start(order)
        self.exited: dict[str, object] | None = None
        self.bounds_met: list[str] = []
        self.looked_s = 0.0

    def run(self) -> None:
        """Watch until the process ended or the arena let go; then end whatever is left."""
        self.tell({"started": self.pid})
        while self.exited is None and self.turn():
            pass
        self.drain()
        left = self.count_others()
        self.end_all()
        self.drain()
        self.tell_rest()
        self.tell(
            {
                **(self.exited or {"exited": None}),
                "left_behind": left,
                "output_bytes": self.spout.total,
                "dropped_bytes": self.spout.dropped,
                "bounds_met": self.bounds_met,
            }
        )

    def turn(self) -> bool:
        """One round: output, orders, ended children. False when the arena let go."""
        sources: list[int | socket.socket] = [self.terminal, self.channel, self.waker]
        again_s = LOOK_EVERY_S if self.order.watch else None
        ready, _, _ = select.select(sources, [], [], again_s)
        if self.order.watch and time.monotonic() - self.looked_s >= LOOK_EVERY_S:
            self.insist_on_bounds()
        if self.terminal in ready:
            self.read_terminal()
        if self.waker in ready:
            self.waker.recv(4096)
            self.reap()
        return self.channel not in ready or self.obey()

    def insist_on_bounds(self) -> None:
        """End everything when it takes too much: what meets a bound does no honest work."""
        self.looked_s = time.monotonic()
        others = descendants()
        taken = {
            "memory": sum(map(memory_of, others)),
            "pids": sum(map(tasks_of, others)),
            "files": sum(map(files_in, {self.order.environment.get("HOME", "/tmp"), *TEMPORARY})),
        }
        met = [name for name, most in self.order.watch.items() if taken[name] >= most * NEARLY]
        if met:
            self.bounds_met = met
            kill_all(others)

    def read_terminal(self) -> bool:
        """Pass on what the process wrote. False when nobody holds the terminal any more."""
        try:
            chunk = os.read(self.terminal, READ_BYTES)
        except OSError:  # EIO: the last holder of the other side closed it
            time.sleep(0.001)
            return False
        self.say(self.spout.take(chunk))
        return True

    def say(self, chunk: bytes) -> None:
        """Pass on bytes as Latin-1 text, which keeps each of them."""
        if chunk:
            self.tell({"said": chunk.decode("latin-1"), "at": time.monotonic_ns()})

    def tell_rest(self) -> None:
        """The end of a long output, after a line that says how much is missing."""
        if self.spout.dropped:
            self.say(f"\n[... {self.spout.dropped} bytes not kept ...]\n".encode())
        self.say(self.spout.rest())

    def obey(self) -> bool:
        """Pass a signal on to the process. False when the arena closed its end."""
        orders = self.channel.recv(4096)
        for name in orders.decode().split():
            if name == "WAITS":
                self.tell({"answer": waits()})
            elif name == "STATE":
                self.tell({"answer": state(self.pid)})
            elif self.exited is None:
                os.kill(self.pid, signal.Signals[name])
        return bool(orders)

    def reap(self) -> None:
        """Collect ended children: the process itself, and orphans that came to us."""
        while True:
            try:
                pid, status, usage = os.wait4(-1, os.WNOHANG)
            except ChildProcessError:
                return
            if pid == 0:
                return
            if pid == self.pid:
                self.exited = {
                    "exited": os.waitstatus_to_exitcode(status),
                    "at": time.monotonic_ns(),
                    "cpu_s": usage.ru_utime + usage.ru_stime,
                    "peak_memory_bytes": usage.ru_maxrss * 1024,
                }

    def drain(self) -> None:
        """Read what is still in the terminal, without waiting for more."""
        while select.select([self.terminal], [], [], 0)[0] and self.read_terminal():
            pass

    def count_others(self) -> int:
        """How many processes of its own outlived the process."""
        self.reap()
        return len(descendants()) - (self.exited is None)

    def end_all(self) -> None:
        """Kill whatever is left, until nothing is left."""
        while others := descendants():
            kill_all(others)
            select.select([self.waker], [], [], GRACE_S)
            self.reap()

    def tell(self, event: dict[str, object]) -> None:
        """Send one event; an arena that is gone needs no answer."""
        try:
            self.channel.sendall(json.dumps(event).encode() + b"\n")
        except OSError:
            self.exited = self.exited or {"exited": None}


def start(order: Order) -> tuple[int, int]:
    """Start the process on a terminal of its own; returns its pid and our side of it.

    A terminal, because a program that writes into a pipe holds its lines back. It returns when
    the program has taken over, for until then a signal would meet our own dispositions.
    """
    taken_over, ours = os.pipe()
    pid, terminal = pty.fork()
    if pid == 0:
        become(order)
    os.close(ours)
    os.read(taken_over, 1)  # the child's copy of the other end closes when it becomes the program
    os.close(taken_over)
    return pid, terminal


def become(order: Order) -> None:
    """In the child: be the ordered command, with the signals that a fresh terminal gives."""
    try:
        make_plain_terminal(sys.stdout.fileno())
        for number in LATEST_SIGNALS:
            signal.signal(number, signal.SIG_DFL)
        signal.set_wakeup_fd(-1)
        signal.pthread_sigmask(signal.SIG_SETMASK, [])
        limit(order.limits)
        os.chdir(order.folder)
        os.execvpe(order.command[0], order.command, order.environment)
    except OSError as error:
        os.write(2, f"{order.command[0]}: {error.strerror}\n".encode())
    finally:
        os._exit(127)


def limit(limits: dict[str, int]) -> None:
    """Bound what the process may take: names as in the module `resource`, e.g. RLIMIT_FSIZE."""
    import resource

    for name, value in limits.items():
        resource.setrlimit(getattr(resource, name), (value, value))


def make_plain_terminal(descriptor: int) -> None:
    """No translation of line ends and no echo: what is written is what is read."""
    attributes = termios.tcgetattr(descriptor)
    attributes[1] &= ~termios.OPOST
    attributes[3] &= ~(termios.ECHO | termios.ECHONL)
    termios.tcsetattr(descriptor, termios.TCSANOW, attributes)


def descendants() -> list[int]:
    """Every living process that descends from this one."""
    parents = {pid: parent for pid, parent in living()}
    found: list[int] = []
    fresh = {os.getpid()}
    while fresh := {pid for pid, parent in parents.items() if parent in fresh}:
        found.extend(fresh)
    return found


def waits() -> dict[str, int]:
    """For each thread that we guard: nanoseconds in which it was ready and no processor was free.

    The second number of schedstat (Linux, Documentation/scheduler/sched-stats.rst). Empty where
    the kernel keeps no such account.
    """
    found = {}
    for pid in descendants():
        with contextlib.suppress(OSError, IndexError, ValueError):
            for thread in os.listdir(f"/proc/{pid}/task"):  # noqa: PTH208
                found[thread] = int(read(f"/proc/{pid}/task/{thread}/schedstat").split()[1])
    return found


def state(pid: int) -> str:
    """What the main thread of a process does: R runs or could, S sleeps; empty where it is gone."""
    try:
        return stat_of(pid)[0].decode()
    except OSError:
        return ""


def living() -> list[tuple[int, int]]:
    """Pid and parent's pid of every process that is no zombie, as /proc has them."""
    pairs = []
    for name in os.listdir("/proc"):  # noqa: PTH208
        if name.isdigit():
            try:
                letter, parent, *_ = stat_of(int(name))
            except OSError:
                continue
            if letter != b"Z":
                pairs.append((int(name), int(parent)))
    return pairs


def stat_of(pid: int) -> list[bytes]:
    """What proc(5) has in /proc/PID/stat after the name: state, parent's pid, and more.

    Raises OSError where the process is gone.
    """
    return read(f"/proc/{pid}/stat").rpartition(b")")[2].split()


def read(path: str) -> bytes:
    """The whole of a file of /proc. Raises OSError."""
    with open(path, "rb") as file:  # noqa: PTH123
        return file.read()


def memory_of(pid: int) -> int:
    """Resident bytes of a process: proc_pid_statm(5)."""
    try:
        pages = int(read(f"/proc/{pid}/statm").split()[1])
    except (OSError, IndexError):
        return 0
    return pages * os.sysconf("SC_PAGE_SIZE")


def files_in(folder: str) -> int:
    """How many files the file system of a folder holds."""
    try:
        system = os.statvfs(folder)
    except OSError:
        return 0
    return system.f_files - system.f_ffree


def tasks_of(pid: int) -> int:
    """The threads of a process."""
    try:
        return len(os.listdir(f"/proc/{pid}/task"))  # noqa: PTH208
    except OSError:
        return 0


def kill_all(pids: list[int]) -> None:
    """End processes; the first one of a namespace ends all others at once, born ones too."""
    if os.getpid() == 1:
        kill(-1)
    for pid in pids:
        kill(pid)


def kill(pid: int) -> None:
    """End a process that may be gone already."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)


def enter_namespaces() -> None:
    """Take a pid, ipc and mount namespace; return in the new namespace's first process."""
    uid, gid = os.getuid(), os.getgid()
    flags = kernel.CLONE_NEWUSER | kernel.CLONE_NEWPID | kernel.CLONE_NEWIPC | kernel.CLONE_NEWNS
    kernel.unshare(flags)
    kernel.map_identity(uid, gid)
    first = os.fork()
    if first:
        wait_and_follow(first)
    kernel.die_with_parent()
    kernel.keep_mounts_private()
    kernel.mount_private("proc", "/proc")
    kernel.mount_private("tmpfs", "/dev/shm")


def wait_and_follow(pid: int) -> None:
    """Outside the namespace: stay until its first process ended, and end as it did."""
    _, status = os.waitpid(pid, 0)
    os._exit(os.waitstatus_to_exitcode(status) & 0xFF)


def main(descriptor: int) -> None:
    """Take the order, go where it says, and guard."""
    kernel.die_with_parent()
    channel = socket.socket(fileno=descriptor)
    channel.set_inheritable(False)
    with channel.makefile("r", encoding="utf-8") as orders:
        order = Order(**json.loads(orders.readline()))
    for number in LATEST_SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    try:
        if order.walls == "namespaces":
            enter_namespaces()
        elif order.walls == "sandbox":
            kernel.be_unreadable()
        else:
            kernel.adopt_orphans()
        Guardian(channel, order).run()
    except OSError as error:
        channel.sendall(json.dumps({"refused": str(error)}).encode() + b"\n")


if __name__ == "__main__":
    main(int(sys.argv[1]))
