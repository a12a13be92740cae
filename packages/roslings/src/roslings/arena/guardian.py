"""A process's whole life: start one other, keep it company, and leave nothing of it behind.

    python -I -S -c "import guardian; guardian.main(FD)"

FD is one end of a stream socket pair; the arena holds the other. It first sends the number of bytes
of a `StartOrder` on a line, and the bytes, of `marshal`. Later it sends a line each: a signal's
name, `WAITS`, `OWN_WAITS`, `WORKED`, `STATE`, `COMMANDS` or `KILL:PID`. The guardian answers one
line of JSON an event:

    {"started": PID}                       {"said": TEXT, "at": NS}
    {"exited": STATUS, "at": NS, ...}      {"refused": REASON}
    {"answer": {THREAD: NS}, "to": ...}    to WAITS: ready to run, and no processor free, since
                                           it began; to OWN_WAITS: without its children
    {"answer": S, "to": "WORKED"}          to WORKED: seconds of a processor that it has used, and
                                           all that it started
    {"answer": LETTER, "to": "STATE"}      to STATE: of its main thread, as in proc(5); empty where
                                           it has ended
    {"answer": {PID: COMMAND}, "to": ...}  to COMMANDS: all that descend from it, with the words
                                           of each command behind one another, NUL between them

Where the order says `namespaces`, the process lives in a pid namespace whose first process is this
guardian. When the guardian goes, the kernel ends all that the process started. So it is where the
order says `sandbox`: then this guardian was started inside of it. Elsewhere it adopts orphans and
ends them one by one; where the order names a `user`, the process is that user. When the arena's end
of the socket closes, for whatever reason, everything ends. Times are nanoseconds of the monotonic
clock.

A grading starts five of these, and most of what one takes is Python's start: so it imports little.
The modules of json, sockets, contexts, dataclasses and paths would double it.
"""

from __future__ import annotations

import _signal as signal  # type: ignore[import-not-found]  # `signal` itself doubles our imports
import errno
import marshal
import os
import pty
import select
import sys
import termios
import time

import kernel  # type: ignore[import-not-found]
import refusals  # type: ignore[import-not-found]

READ_BYTES = 65536
LATEST_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGQUIT, signal.SIGPIPE, signal.SIGHUP)
GRACE_S = 0.2
TEMPORARY = ("/tmp", "/dev/shm")
LOOK_EVERY_S = 0.2
BUSY_LOOKS = 10
"""So often in a row there are too many: nodes that start together are through by then."""
LAST_IN_LINE = 19
"""The lowest priority: sched(7). Some 70 such threads weigh as much as one of the others."""
CRUMB = 200
"""Such a part of all."""
TICKS_A_SECOND = os.sysconf("SC_CLK_TCK")
JUST_NOW_S = 0.2
QUESTIONS = ("WAITS", "OWN_WAITS", "WORKED", "STATE", "COMMANDS")
KILL = "KILL:"
LONGEST_COMMAND = 4096
NEARLY = 0.95
"""The kernel keeps it from reaching its bound, or ends one process only."""


class StartOrder:
    """What to start, where, and how much of its output to pass on."""

    def __init__(
        self,
        command: list[str],
        environment: dict[str, str],
        folder: str,
        walls: str,
        output: dict[str, int],
        flood: dict[str, int],
        limits: dict[str, int],
        watch: dict[str, int],
        user: int | None,
        filters: tuple[bytes, ...],
        reach: dict[str, object] | None,
        busy: int,
    ) -> None:
        """What each dictionary's names mean: `BoundedOutput`, `Flood`, module `resource`, these.

        `watch`: the most of `memory`, in bytes, of `pids`, threads too, of `cpu_s`, and of `files`.
        `user`: who the process becomes; None where it stays who the guardian is.
        `filters`: of its system calls: one that asks us, and one for a kernel that cannot; none
        where nothing is refused.
        `reach`: the words of kernel.confine(); None where it reaches what its user may.
        `busy`: so many threads may want a processor at once; 0 where nobody counts them.
        """
        self.command, self.environment = command, environment
        self.folder, self.walls = folder, walls
        self.output, self.flood, self.limits, self.watch = output, flood, limits, watch
        self.user, self.filters, self.reach, self.busy = user, filters, reach, busy


class BoundedOutput:
    """Passes on the first of an endless output, and keeps the last for the end.

    Lines are bounded as well as bytes. Half a million empty ones are 512 KB here, and hold the
    arena up for seconds when each becomes a record of the evidence.
    """

    def __init__(self, head_bytes: int, tail_bytes: int, head_lines: int, tail_lines: int) -> None:
        self.head_left, self.lines_left = head_bytes, head_lines
        self.tail_bytes, self.tail_lines = tail_bytes, tail_lines
        self.tail: list[bytes] = []
        self.tail_held = 0
        self.total = self.lines = 0
        self.dropped = 0
        self.before_ending: int | None = None
        self.ending_cut = False

    def take(self, chunk: bytes) -> bytes:
        """The part of `chunk` to pass on at once; the rest is held for the end."""
        self.total += len(chunk)
        self.lines += chunk.count(b"\n")
        fits = within(chunk, self.head_left, self.lines_left)
        now, later = chunk[:fits], chunk[fits:]
        self.head_left -= fits
        self.lines_left -= now.count(b"\n")
        if later:
            self._hold(later)
        return now

    def begin_ending(self) -> None:
        """From now on the process was asked to end: the last lines are to hold all of that."""
        if self.before_ending is None:
            self.before_ending = self.total

    def _hold(self, chunk: bytes) -> None:
        self.tail.append(chunk)
        self.tail_held += len(chunk)
        while self.tail_held - len(self.tail[0]) >= self.tail_bytes:
            lost = len(self.tail.pop(0))
            self.tail_held -= lost
            self.dropped += lost

    def rest(self) -> bytes:
        """The last lines, when all is over; what does not stay is counted as dropped."""
        held = b"".join(self.tail)
        kept = b"\n".join(held.split(b"\n")[-self.tail_lines :])
        self.dropped += len(held) - len(kept)
        since = 0 if self.before_ending is None else self.total - self.before_ending
        self.ending_cut = self.dropped > 0 and since > len(kept)
        return kept


def within(chunk: bytes, most_bytes: int, most_lines: int) -> int:
    """How many bytes of `chunk` are within both bounds."""
    chunk = chunk[:most_bytes]
    *lines, beyond = chunk.split(b"\n", most_lines)
    return len(chunk) - (len(beyond) if len(lines) == most_lines else 0)


class Flood:
    """Whether an output has no end: so many rows in each second, for so many seconds in a row.

    A row is what fills one of a terminal, with a line break or without. Much that is over soon is
    no flood.
    """

    def __init__(self, rows_a_second: int, row_bytes: int, seconds: int) -> None:
        self.most_rows, self.row_bytes, self.most_s = rows_a_second, row_bytes, seconds
        self.began_s = time.monotonic()
        self.latest_s = 0.0
        self.lines = self.bytes = self.in_a_row = 0

    def take(self, chunk: bytes) -> bool:
        """Count what came; whether it is known now that it has no end."""
        self.lines += chunk.count(b"\n")
        self.bytes += len(chunk)
        self.latest_s = time.monotonic()
        passed_s = self.latest_s - self.began_s
        if passed_s >= 1:
            self.in_a_row = self.in_a_row + 1 if self.rows() >= self.most_rows * passed_s else 0
            self.lines = self.bytes = 0
            self.began_s += passed_s
        return self.in_a_row >= self.most_s

    def rows(self) -> int:
        """Of the second that goes on."""
        return max(self.lines, self.bytes // self.row_bytes)

    def goes_on(self) -> bool:
        """It has begun, and something came just now."""
        begun = self.in_a_row > 0 or self.rows() >= self.most_rows
        return begun and time.monotonic() - self.latest_s < JUST_NOW_S


class Guardian:
    """One process, from start to end."""

    def __init__(self, channel: int, order: StartOrder) -> None:
        self.channel = channel
        self.order = order
        self.bounded_output = BoundedOutput(**order.output)
        self.flood = Flood(**order.flood)
        self.waker, waked = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        signal.set_wakeup_fd(waked)
        self.pid, self.terminal, asked = start(order)
        self.refusals = refusals.Refusals(asked)
        self.exited: dict[str, object] | None = None
        self.bounds_met: list[str] = []
        self.printed_on = False
        self.looked_s = 0.0
        self.busy_looks = self.most_busy = 0
        self.filled_its_disk = False

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
        if self.printed_on and self.bounded_output.dropped and not self.bounds_met:
            self.bounds_met = ["output"]
        self.tell(
            {
                **(self.exited or {"exited": None}),
                "left_behind": left,
                "output_bytes": self.bounded_output.total,
                "output_lines": self.bounded_output.lines,
                "dropped_bytes": self.bounded_output.dropped,
                "ending_cut": int(self.bounded_output.ending_cut),
                "bounds_met": self.bounds_met,
                "most_busy": self.most_busy,
                "filled_its_disk": int(self.filled_its_disk),
                "refused_calls": self.refusals.counts,
            }
        )

    def turn(self) -> bool:
        """One round: output, orders, ended children. False when the arena let go."""
        sources = [self.terminal, self.channel, self.waker, *self.refusals.sources()]
        again_s = LOOK_EVERY_S if self.order.watch else None
        ready, _, _ = select.select(sources, [], [], again_s)
        if self.order.watch and time.monotonic() - self.looked_s >= LOOK_EVERY_S:
            self.insist_on_bounds()
        if self.terminal in ready:
            self.read_terminal()
        self.refusals.answer()
        if self.waker in ready:
            os.read(self.waker, 4096)
            self.reap()
        return self.channel not in ready or self.obey()

    def insist_on_bounds(self) -> None:
        """End everything when it takes too much: what meets a bound does no honest work."""
        self.looked_s = time.monotonic()
        others = descendants()
        places = {self.order.environment.get("HOME", "/tmp"), *TEMPORARY}
        if "files" in self.order.watch and any(map(is_full, places)):
            self.filled_its_disk = True
        taken = {
            "memory": sum(map(memory_of, others)),
            "pids": sum(map(tasks_of, others)),
            "cpu_s": cpu_s_of(others),
            "files": sum(map(files_in, places)),
        }
        met = [name for name, most in self.order.watch.items() if taken[name] >= most * NEARLY]
        if met:
            self.bounds_met = met
            kill_all(others)
        elif self.order.busy:
            self.insist_on_share(others)

    def insist_on_share(self, others: list[int]) -> None:
        """Put it behind all others where too many of its threads want a processor for long.

        Who has many of them would else have most of the time, and the neighbours little.
        """
        busy = sum(map(busy_in, others))
        self.busy_looks = self.busy_looks + 1 if busy > self.order.busy else 0
        if self.busy_looks >= BUSY_LOOKS:
            self.most_busy = max(self.most_busy, busy)
            put_last(others)

    def read_terminal(self) -> bool:
        """Pass on what the process wrote. False when nobody holds the terminal any more."""
        try:
            chunk = os.read(self.terminal, READ_BYTES)
        except OSError:  # EIO: the last holder of the other side closed it
            time.sleep(0.001)
            return False
        self.say(self.bounded_output.take(chunk))
        if self.flood.take(chunk) and not self.bounds_met:
            self.bounds_met = ["output"]
            kill_all(descendants())  # it prints on until it is gone
        return True

    def say(self, chunk: bytes) -> None:
        """Pass on bytes as Latin-1 text, which keeps each of them."""
        if chunk:
            self.tell({"said": chunk.decode("latin-1"), "at": time.monotonic_ns()})

    def tell_rest(self) -> None:
        """The end of a long output, after a line that says how much is missing."""
        rest = self.bounded_output.rest()
        if self.bounded_output.dropped:
            self.say(f"\n[... {self.bounded_output.dropped} bytes not kept ...]\n".encode())
        self.say(rest)

    def obey(self) -> bool:
        """Do what the arena says. False when it closed its end."""
        try:
            orders = os.read(self.channel, 4096)
        except ConnectionResetError:  # it went without reading all that we said
            return False
        for name in orders.decode().split():
            self.follow(name)
        return bool(orders)

    def follow(self, name: str) -> None:
        """Answer a question, end one process, or pass a signal on to the process itself."""
        if name in QUESTIONS:
            self.tell({"answer": self.answer_to(name), "to": name})
        elif name.startswith(KILL):
            kill_own(int(name.removeprefix(KILL)))
        elif self.exited is None:
            self.printed_on = self.printed_on or self.flood.goes_on()
            self.bounded_output.begin_ending()
            os.kill(self.pid, getattr(signal, name))

    def answer_to(self, name: str) -> object:
        """What one of the questions wants to know."""
        if name == "WAITS":
            return kernel.waits(descendants())
        if name == "OWN_WAITS":
            return kernel.waits([self.pid])
        if name == "WORKED":
            return cpu_s_of(descendants())
        return state(self.pid) if name == "STATE" else commands(descendants())

    def reap(self) -> None:
        """Collect ended children: the process itself, and orphans that came to us."""
        while True:
            try:
                ended = os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)
            except ChildProcessError:
                return
            if ended is None:
                return
            waited = kernel.waited_ns(ended.si_pid, ended.si_pid)  # told until it is collected
            pid, status, usage = os.wait4(ended.si_pid, 0)
            if pid == self.pid:
                self.exited = {
                    "waited_ns": waited,
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
            send(self.channel, event)
        except OSError:
            self.exited = self.exited or {"exited": None}


def send(channel: int, event: dict[str, object]) -> None:
    """Write one event, whole. Raises OSError where nobody is there to read it."""
    left = as_json(event).encode(errors="replace") + b"\n"
    while left:
        left = left[os.write(channel, left) :]


ESCAPES = {code: f"\\u{code:04x}" for code in (*range(32), ord('"'), ord("\\"))}


def as_json(value: object) -> str:
    """An event as one line of JSON: texts, numbers, None, and lists and dictionaries of them."""
    if value is None:
        return "null"
    if isinstance(value, str):
        return f'"{value.translate(ESCAPES)}"'
    if isinstance(value, dict):
        pairs = (f"{as_json(key)}: {as_json(each)}" for key, each in value.items())
        return f"{{{', '.join(pairs)}}}"
    if isinstance(value, list):
        return f"[{', '.join(map(as_json, value))}]"
    return repr(value)


def start(order: StartOrder) -> tuple[int, int, int | None]:
    """Start the process on a terminal of its own; returns its pid and our side of it.

    And the descriptor on which a filter asks whether it may call the kernel, where it has one.

    A terminal, because a program that writes into a pipe holds its lines back. It returns when
    the program has taken over, for until then a signal would meet our own dispositions.
    """
    taken_over, ours = os.pipe()
    here, there = refusals.pair()
    pid, terminal = pty.fork()
    if pid == 0:
        become(order, there)
    there.close()
    asked = refusals.taken_over(here)
    here.close()
    os.close(ours)
    os.read(taken_over, 1)  # the child's copy of the other end closes when it becomes the program
    os.close(taken_over)
    return pid, terminal, asked


def become(order: StartOrder, there: object) -> None:
    """In the child: be the ordered command, with the signals that a fresh terminal gives."""
    try:
        make_plain_terminal(sys.stdout.fileno())
        for number in LATEST_SIGNALS:
            signal.signal(number, signal.SIG_DFL)
        signal.set_wakeup_fd(-1)
        signal.pthread_sigmask(signal.SIG_SETMASK, [])
        limit(order.limits)
        hold_no_keys()
        if order.reach:
            kernel.confine(**order.reach)
        if order.user is not None:
            give_up_all_rights(order.user)
        os.chdir(order.folder)
        refuse_calls(order.filters, there)
        os.execvpe(order.command[0], order.command, order.environment)
    except OSError as error:
        os.write(2, f"{order.command[0]}: {error.strerror}\n".encode())
    finally:
        os._exit(127)


def give_up_all_rights(user: int) -> None:
    """In the child: be an unprivileged user who holds nothing but its own terminal."""
    os.fchown(0, user, -1)
    for name in os.listdir("/proc/self/fd"):  # noqa: PTH208
        if int(name) > 2:
            try:
                os.set_inheritable(int(name), False)
            except OSError:  # the list's own
                continue
    os.umask(0o077)
    kernel.become_user(user)


def hold_no_keys() -> None:
    """In the child: of the kernel's keys, hold none that another process has."""
    try:
        kernel.leave_keys()
    except OSError:  # who cannot leave them cannot reach them either
        return


def refuse_calls(filters: tuple[bytes, ...], there: object) -> None:
    """In the child: what attacks begin with is refused, where the kernel can refuse it.

    The parent refuses it, and counts, where the kernel can ask it.
    """
    if not filters:
        return
    asking, refusing = filters
    try:
        refusals.hand_over(there, kernel.ask_before_calls(asking))
    except OSError:
        try:
            kernel.refuse_calls(refusing)
        except OSError as error:
            if error.errno != errno.EINVAL:  # a kernel that is built without it
                raise


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


def state(pid: int) -> str:
    """What the main thread of a process does: R runs or could, S sleeps; empty where it is gone."""
    return state_in(f"/proc/{pid}/stat")


def state_in(file: str) -> str:
    """The same, of the process or thread that a file tells of."""
    try:
        return stat_in(file)[0].decode()
    except OSError:
        return ""


def commands(pids: list[int]) -> dict[str, str]:
    """Pid to the words of its command, as in proc(5); those that are gone are left out."""
    found: dict[str, str] = {}
    for pid in pids:
        try:
            words: bytes = kernel.read(f"/proc/{pid}/cmdline")
        except OSError:
            continue
        found[str(pid)] = words[:LONGEST_COMMAND].decode("latin-1")
    return found


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
    return stat_in(f"/proc/{pid}/stat")


def stat_in(file: str) -> list[bytes]:
    """The same of the process or thread that a file tells of. Raises OSError."""
    found: bytes = kernel.read(file)
    return found.rpartition(b")")[2].split()


def memory_of(pid: int) -> int:
    """Resident bytes of a process: proc_pid_statm(5)."""
    try:
        pages = int(kernel.read(f"/proc/{pid}/statm").split()[1])
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


def is_full(folder: str) -> bool:
    """Whether nothing more than a crumb can be written there; where that has a bound at all."""
    try:
        system = os.statvfs(folder)
    except OSError:
        return False
    return system.f_blocks > 0 and system.f_bavail * CRUMB < system.f_blocks


def threads_of(pid: int) -> list[str]:
    """The folders of a process's threads; none where it is gone."""
    folder = f"/proc/{pid}/task"
    try:
        return [f"{folder}/{name}" for name in os.listdir(folder)]  # noqa: PTH208
    except OSError:
        return []


def tasks_of(pid: int) -> int:
    """How many threads a process has."""
    return len(threads_of(pid))


def cpu_s_of(pids: list[int]) -> float:
    """Seconds of the processor: of these, and of all that were collected, by these and by us."""
    ours = os.times()
    return ours.children_user + ours.children_system + sum(map(ticks_of, pids)) / TICKS_A_SECOND


def ticks_of(pid: int) -> int:
    """Time of the processor, of a process and of its children that have ended: proc_pid_stat(5)."""
    try:
        return sum(map(int, stat_of(pid)[11:15]))
    except OSError:
        return 0


def busy_in(pid: int) -> int:
    """How many threads of a process run, or would if a processor were free."""
    return sum(state_in(f"{thread}/stat") == "R" for thread in threads_of(pid))


def put_last(pids: list[int]) -> None:
    """Let all other processes of this machine go first.

    Where each session has its own share of the processors, its priority counts, too: sched(7),
    "The autogroup feature".
    """
    for pid in pids:
        for thread in threads_of(pid):
            put_thread_last(int(thread.rpartition("/")[2]))
        put_session_last(f"/proc/{pid}/autogroup")


def put_thread_last(thread: int) -> None:
    """One that has just ended is no matter."""
    try:
        os.setpriority(os.PRIO_PROCESS, thread, LAST_IN_LINE)
    except OSError:
        return


def put_session_last(file: str) -> None:
    """Not told again where it is so: the kernel takes ten such orders a second, and no more."""
    try:
        if not kernel.read(file).endswith(b"nice %d\n" % LAST_IN_LINE):
            with open(file, "w") as autogroup:  # noqa: PTH123
                autogroup.write(str(LAST_IN_LINE))
    except OSError:
        return


def kill_all(pids: list[int]) -> None:
    """End processes; the first one of a namespace ends all others at once, born ones too."""
    if os.getpid() == 1:
        kill(-1)
    for pid in pids:
        kill(pid)


def kill_own(pid: int) -> None:
    """End one process as a crash would, where it descends from this one."""
    if pid in descendants():
        kill(pid)


def kill(pid: int) -> None:
    """End a process that may be gone already."""
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        return


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


def main(channel: int) -> None:
    """Take the order, go where it says, and guard; the process's whole life."""
    kernel.die_with_parent()
    os.set_inheritable(channel, False)
    order = StartOrder(**marshal.loads(read_order(channel)))
    for number in LATEST_SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    try:
        if order.walls == "namespaces":
            enter_namespaces()
        elif order.walls == "sandbox":
            kernel.be_unreadable()
        else:
            kernel.adopt_orphans()
        if order.user is not None:
            kernel.be_unreadable()
        Guardian(channel, order).run()
    except OSError as error:
        send(channel, {"refused": str(error)})
    os._exit(0)  # what Python would tidy now is nobody's any more


def read_order(channel: int) -> bytes:
    """As many bytes as the line before them says, and none of what comes later."""
    length = b""
    while not length.endswith(b"\n"):
        length += os.read(channel, 1) or b"0\n"
    order = b""
    while part := os.read(channel, int(length) - len(order)):
        order += part
    return order
