"""One process behind its guardian: output, signals, end, and nothing left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest

from roslings.arena import Launch, Process
from roslings.arena import process as process_room
from roslings.evidence import ProcessSeen
from skips import needs, skip_without

LONG_S = 60.0
"""A bound, not a measure: every wait ends when its condition holds."""


def launch(tmp_path: Path, namespaces: bool, *command: str, **environment: str) -> Launch:
    """A command with a small environment of its own."""
    return Launch(list(command), {"PATH": os.defpath, **environment}, tmp_path, namespaces)


def run(tmp_path: Path, namespaces: bool, *command: str) -> ProcessSeen:
    """Run a command to its end."""
    with Process("it", launch(tmp_path, namespaces, *command)) as process:
        assert process.wait_ended(LONG_S)
    return process.seen


def python(source: str) -> tuple[str, ...]:
    """A command that runs a piece of Python."""
    return sys.executable, "-I", "-S", "-c", textwrap.dedent(source)


def texts(seen: ProcessSeen) -> list[str]:
    """What it wrote."""
    return [line.text for line in seen.lines]


def test_its_lines_and_its_status_are_seen(tmp_path: Path, namespaces: bool) -> None:
    """Standard output and standard error, in order, and the exit code."""
    seen = run(tmp_path, namespaces, "sh", "-c", "echo one; echo two >&2; exit 3")
    assert texts(seen) == ["one", "two"]
    assert seen.status == 3
    assert seen.ended_by_itself


def test_every_byte_arrives(tmp_path: Path, namespaces: bool) -> None:
    """Quotes, backslashes, and what is no UTF-8."""
    seen = run(tmp_path, namespaces, *python("import os; os.write(1, bytes(range(256)))"))
    text = bytes(range(256)).decode("utf-8", errors="replace")
    assert texts(seen) == [part.rstrip("\r") for part in text.split("\n")]


def test_python_does_not_hold_its_lines_back(tmp_path: Path, namespaces: bool) -> None:
    """A print() is seen while the process still runs, without PYTHONUNBUFFERED."""
    source = "import time; print('I heard it'); time.sleep(1000)"
    with Process("it", launch(tmp_path, namespaces, *python(source))) as process:
        assert process.wait_until(lambda: bool(process.seen.lines), LONG_S)
        assert process.alive
    assert texts(process.seen)[0] == "I heard it"


def test_only_the_given_environment_arrives(
    tmp_path: Path, namespaces: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What this terminal has set does not change what a student's node does."""
    monkeypatch.setenv("PYTHONUNBUFFERED", "1")
    monkeypatch.setenv("SECRET", "x")
    with Process("it", launch(tmp_path, namespaces, "env", ONLY="this")) as process:
        assert process.wait_ended(LONG_S)
    names = {line.partition("=")[0] for line in texts(process.seen)}
    assert "ONLY" in names
    assert not names & {"PYTHONUNBUFFERED", "SECRET"}


def test_ctrl_c_reaches_the_process(tmp_path: Path, namespaces: bool) -> None:
    """SIGINT with its default effect, and the time until the end is written down."""
    with Process("it", launch(tmp_path, namespaces, "sleep", "1000")) as process:
        assert process.interrupt(LONG_S)
    assert process.seen.status == -signal.SIGINT
    assert process.seen.ending is not None
    assert process.seen.ending.after_s is not None
    assert not process.seen.ended_by_itself


BUSY = "while True: pass"
SLOW_TO_END = """
import signal, time
def end(*_):
    until_s = time.process_time() + 1.0
    while time.process_time() < until_s:
        pass
    raise SystemExit(0)
signal.signal(signal.SIGINT, end)
print("ready", flush=True)
while True:
    time.sleep(0.01)
"""


ENDS_IN_A_THREAD = """
import signal, threading, time
def work():
    until_s = time.thread_time() + 1.0
    while time.thread_time() < until_s:
        pass
def end(*_):
    working = threading.Thread(target=work)
    working.start()
    working.join()
    raise SystemExit(0)
signal.signal(signal.SIGINT, end)
print("ready", flush=True)
while True:
    time.sleep(0.01)
"""


@pytest.mark.slow
@needs("schedstat")
@pytest.mark.parametrize("program", [SLOW_TO_END, ENDS_IN_A_THREAD], ids=["main", "thread"])
def test_while_it_waits_for_a_processor_its_time_stands_still(
    tmp_path: Path, namespaces: bool, program: str
) -> None:
    """Three others on its processor: by itself it takes a second, with them more."""
    one = {min(os.sched_getaffinity(0))}
    pinned = f"import os; os.sched_setaffinity(0, {one})\n"
    others = [subprocess.Popen([sys.executable, "-S", "-c", pinned + BUSY]) for _ in range(3)]
    try:
        with Process("it", launch(tmp_path, namespaces, *python(pinned + program))) as process:
            assert process.wait_until(lambda: bool(process.seen.lines), LONG_S)
            assert process.interrupt(1.5)
    finally:
        for other in others:
            other.kill()
            other.wait()
    ending = process.seen.ending
    assert ending and ending.after_s
    assert (ending.waited_s if program == SLOW_TO_END else ending.others_waited_s) > 0.1
    assert ending.least_own_s < ending.after_s - 0.1


def test_ctrl_c_works_under_a_parent_that_ignores_it(tmp_path: Path) -> None:
    """A background job and CI ignore SIGINT; the student's node must not inherit that."""
    source = """
        import os, signal
        from pathlib import Path
        from roslings.arena import Launch, Process
        order = Launch(["sleep", "1000"], {"PATH": os.defpath}, Path("/"), False)
        with Process("it", order) as process:
            assert process.interrupt(60)
        print(process.seen.status)
    """
    ignoring = ["sh", "-c", 'trap "" INT; exec "$@"', "sh", sys.executable, "-c"]
    ran = subprocess.run(
        [*ignoring, textwrap.dedent(source)], capture_output=True, text=True, check=True
    )
    assert ran.stdout.strip() == str(-signal.SIGINT)


def test_a_stubborn_process_is_killed(tmp_path: Path, namespaces: bool) -> None:
    """One that ignores SIGINT and SIGTERM ends all the same, and that it had to be is seen."""
    command = ("sh", "-c", "trap '' INT TERM; echo ready; while :; do sleep 1; done")
    with Process("it", launch(tmp_path, namespaces, *command)) as process:
        assert process.wait_until(lambda: bool(process.seen.lines), LONG_S)
    assert process.seen.status == -signal.SIGKILL
    assert process.seen.ending is not None
    assert process.seen.ending.after_s is None


def test_a_daemon_is_ended_and_counted(tmp_path: Path, namespaces: bool) -> None:
    """A process that forks twice and leaves its session does not outlive the block."""
    source = """
        import os, time
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                time.sleep(1000)
            os._exit(0)
        os.wait()
    """
    seen = run(tmp_path, namespaces, *python(source))
    assert seen.left_behind == 1


ENDLESS = {
    "stdout": "while True: print('a line')",
    "stderr": "import sys\nwhile True: print('a line', file=sys.stderr)",
    "no line": "while True: print('.', end='')",
    "from a thread": (
        "import threading\n"
        "def flood():\n"
        "    while True: print('a line')\n"
        "threading.Thread(target=flood).start()"
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("source", ENDLESS.values(), ids=ENDLESS)
def test_what_prints_without_end_is_ended(tmp_path: Path, namespaces: bool, source: str) -> None:
    """By itself it never would be; what it wrote is counted, and its beginning and end are kept."""
    seen = run(tmp_path, namespaces, *python(source))
    assert seen.prints_without_end
    assert seen.ended_by_itself
    assert seen.output_bytes > 80 * 1000
    assert len(seen.lines) < 12_000


@pytest.mark.parametrize(
    ("pause", "lines", "flood"), [("", 50_000, True), ("time.sleep(0.01)", 20, False)]
)
def test_what_still_prints_when_it_is_asked_to_end_is_told(
    tmp_path: Path, namespaces: bool, pause: str, lines: int, flood: bool
) -> None:
    """Before it was known that it never stops; a loop that waits in between is none."""
    source = f"""
        import itertools, time
        for n in itertools.count(1):
            print('a line')
            {pause or "pass"}
            if n == {lines}:
                open('ready', 'w').close()
    """
    with Process("it", launch(tmp_path, namespaces, *python(source))) as process:
        wait_for(lambda: (tmp_path / "ready").exists())
    assert process.seen.prints_without_end is flood


@pytest.fixture
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is ended for what it prints, however long a busy computer takes for it."""
    monkeypatch.setitem(process_room.FLOOD, "seconds", 1000)


@pytest.mark.usefixtures("patient")
def test_an_endless_output_is_drained_and_bounded(tmp_path: Path, namespaces: bool) -> None:
    """The start and the end of a flood are kept, the middle is counted."""
    flood = "head -c 30000000 /dev/zero | tr '\\0' 'x' | fold -w 99; echo; echo the end"
    seen = run(tmp_path, namespaces, "sh", "-c", f"echo the start; {flood}")
    assert texts(seen)[0] == "the start"
    assert texts(seen)[-1] == "the end"
    assert seen.output_bytes > 30_000_000
    assert seen.output_dropped_bytes > 20_000_000
    assert sum(len(text) for text in texts(seen)) < 1_000_000


@pytest.mark.usefixtures("patient")
def test_a_flood_of_empty_lines_is_bounded_too(tmp_path: Path, namespaces: bool) -> None:
    """A line costs the evidence more than its bytes do."""
    flood = "head -c 3000000 /dev/zero | tr '\\0' '\\n'"
    seen = run(tmp_path, namespaces, "sh", "-c", f"echo the start; {flood}; echo the end")
    assert texts(seen)[0] == "the start"
    assert texts(seen)[-1] == "the end"
    assert len(seen.lines) < 12_000
    assert seen.output_bytes == 3_000_018


@pytest.mark.parametrize(("before", "after", "cut"), [(9_000_000, 99, False), (0, 9_000_000, True)])
def test_an_end_that_is_not_kept_whole_is_told(
    tmp_path: Path, namespaces: bool, before: int, after: int, cut: bool
) -> None:
    """A flood before Ctrl-C leaves room for all that comes after it; a flood after it does not."""
    source = f"""
        import signal
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        print('x' * {before}, flush=True)
        open('ready', 'w').close()
        signal.sigwait([signal.SIGINT])
        print('y' * {after})
    """
    with Process("it", launch(tmp_path, namespaces, *python(source))) as process:
        end_s = time.monotonic() + LONG_S
        while not (tmp_path / "ready").exists() and time.monotonic() < end_s:
            process.wait_ended(0.01)
    assert process.seen.output_dropped_bytes > 0
    assert process.seen.ending_cut is cut


def test_one_endless_line_is_cut(tmp_path: Path, namespaces: bool) -> None:
    """A line of 200,000 letters does not become one line of the verdict."""
    seen = run(tmp_path, namespaces, "sh", "-c", "head -c 200000 /dev/zero | tr '\\0' 'x'")
    assert max(len(text) for text in texts(seen)) <= 2000


def test_bytes_that_are_no_text_are_shown_as_such(tmp_path: Path, namespaces: bool) -> None:
    """Output that is no UTF-8 is kept readable."""
    seen = run(tmp_path, namespaces, "printf", r"good \377\376 bad\n")
    assert texts(seen) == ["good \ufffd\ufffd bad"]


def test_a_program_that_is_missing_is_said(tmp_path: Path, namespaces: bool) -> None:
    """The line that a shell would print, and its status."""
    seen = run(tmp_path, namespaces, "no-such-program")
    assert texts(seen) == ["no-such-program: No such file or directory"]
    assert seen.status == 127


def test_an_error_inside_the_block_ends_the_process_at_once(
    tmp_path: Path, namespaces: bool
) -> None:
    """Ctrl-C in the middle: no politeness, nothing left (see `nothing_left`)."""
    command = ("sh", "-c", "trap '' INT TERM; echo ready; while :; do sleep 1; done")
    with (
        pytest.raises(KeyboardInterrupt),
        Process("it", launch(tmp_path, namespaces, *command)) as process,
    ):
        assert process.wait_until(lambda: bool(process.seen.lines), LONG_S)
        raise KeyboardInterrupt
    assert not process.alive


def test_nothing_outlives_an_arena_that_is_killed(tmp_path: Path, namespaces: bool) -> None:
    """A power cut for the grader: the kernel ends the guardian, and with it the node."""
    source = f"""
        import os, sys
        from pathlib import Path
        from roslings.arena import Launch, Process
        command = ["sh", "-c", "echo $$ > {tmp_path}/pid; sleep 1000"]
        order = Launch(command, {{"PATH": os.defpath}}, Path("/"), {namespaces})
        with Process("it", order) as process:
            process.wait_until(lambda: os.path.exists("{tmp_path}/pid"), 60)
            print(process._guardian.pid, flush=True)
            sys.stdin.read()
    """
    arena = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(source)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert arena.stdout is not None
    wait_for(lambda: (tmp_path / "pid").exists())
    arena.kill()
    arena.wait()
    wait_for(lambda: not processes_with(f"{tmp_path}/pid"))


def processes_with(word: str) -> list[int]:
    """Every living process with `word` in its command line."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != os.getpid():
            try:
                line = (entry / "cmdline").read_bytes()
            except OSError:
                continue
            if word.encode() in line:
                found.append(int(entry.name))
    return found


def wait_for(condition: object) -> None:
    """Wait until a condition holds; fail when it never does."""
    deadline_s = time.monotonic() + LONG_S
    while not condition():  # type: ignore[operator]
        assert time.monotonic() < deadline_s
        time.sleep(0.01)


def test_a_process_that_waits_is_told_from_one_that_works(tmp_path: Path, namespaces: bool) -> None:
    """And one that is gone does neither."""
    sleeper = launch(tmp_path, namespaces, *python("import time; time.sleep(1000)"))
    with Process("it", sleeper) as process:
        deadline_s = time.monotonic() + LONG_S
        while not process.asleep():  # it is still being started
            assert time.monotonic() < deadline_s
    assert not process.asleep()
    source = "print('works', flush=True)\nwhile True: pass"
    with Process("it", launch(tmp_path, namespaces, *python(source))) as process:
        assert process.wait_until(lambda: bool(process.seen.lines), LONG_S)
        assert not any(process.asleep() for _ in range(20))


def test_what_a_process_has_worked_is_counted_with_its_children(
    tmp_path: Path, namespaces: bool
) -> None:
    """Seconds of a processor: of those that run and of those that ended; none when it is gone."""
    burn = "import time; [None for _ in iter(lambda: time.process_time() < 0.45, False)]"
    children = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {burn!r}])"
    source = f"{children}; print('done', flush=True); import time; time.sleep(1000)"
    with Process("it", launch(tmp_path, namespaces, *python(source))) as process:
        assert process.wait_until(lambda: bool(process.seen.lines), LONG_S)
        assert 0.4 <= process.worked_s() < 10
    assert process.worked_s() == 0


def test_what_it_has_started_is_known_and_can_be_killed(tmp_path: Path, namespaces: bool) -> None:
    """By the words of its command; the process itself lives on, and no stranger is killed."""
    shell = "sleep 1000 & echo ready; wait; echo woken; exec sleep 2000"
    with Process("it", launch(tmp_path, namespaces, "sh", "-c", shell)) as process:
        assert process.wait_until(lambda: bool(process.seen.lines), LONG_S)
        wait_for(lambda: ["sleep", "1000"] in process.commands().values())
        process.kill(os.getpid() if not namespaces else 1)
        (child,) = (pid for pid, words in process.commands().items() if words[-1] == "1000")
        process.kill(child)
        wait_for(lambda: ["sleep", "2000"] in process.commands().values())
        assert process.alive
    assert texts(process.seen) == ["ready", "woken"]
    assert process.commands() == {}


def test_the_time_without_a_processor_is_known_by_thread(tmp_path: Path, namespaces: bool) -> None:
    """It never shrinks, and grows where several busy threads of one process share the cores."""
    source = f"""
        import os, threading, time
        for _ in range({4 * (os.cpu_count() or 1)}):
            os.fork() or exec("while True: pass")
        time.sleep(1000)
    """
    with Process("it", launch(tmp_path, namespaces, *python(source))) as process:
        if not process.waits_ns():
            skip_without("schedstat")
        grown = False
        deadline_s = time.monotonic() + LONG_S
        before = process.waits_ns()
        while not grown and time.monotonic() < deadline_s:
            now = process.waits_ns()
            assert all(now[thread] >= before[thread] for thread in before)
            grown = sum(now.values()) > sum(before.values())
        assert grown
    assert process.waits_ns() == {}
