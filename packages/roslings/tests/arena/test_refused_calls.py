"""System calls that attacks begin with are refused; each is made where nothing else holds it."""

from __future__ import annotations

import struct
import subprocess
import sys
import textwrap

import pytest
from in_sandbox import launch_in, run

from roslings.arena import Process, Sandbox, process
from roslings.arena.refused_calls import (
    ALLOWED,
    ANSWER,
    ANY_BIT,
    AT_LEAST,
    EQUAL,
    FAILS,
    LOAD,
    MACHINES,
    MISSING_SINCE_2019,
    NAMESPACES,
    SINCE_2019,
    X32,
    filter_of_calls,
)
from roslings.evidence import ProcessSeen
from skips import needs

needs_sandbox = needs("namespaces", "bubblewrap", "filter of system calls")

MAKES = """
    import ctypes, errno, os
    libc = ctypes.CDLL(None, use_errno=True)
    def call(*words):
        ctypes.set_errno(0)
        found = libc.syscall(*words)
        return "done" if found >= 0 else errno.errorcode[ctypes.get_errno()]
    x86 = os.uname().machine == "x86_64"
    child = os.fork()
    if child == 0:
        print("unshare", call(272 if x86 else 97, 0x10000000), flush=True)
        os._exit(0)
    os.waitpid(child, 0)
    name, words = ctypes.c_char_p(b"user"), ctypes.c_char_p(b"it")
    print("add_key", call(248 if x86 else 217, name, words, words, ctypes.c_size_t(2), -2))
    print("keyctl", call(250 if x86 else 219, 0, -2, 1))
    print("ptrace", call(101 if x86 else 117, 0, 0, 0, 0))
    print("clone3", call(435, None, ctypes.c_size_t(0)))
    print("io_uring_setup", call(425, 0, None))
"""
REFUSED = {
    "unshare": "EPERM",
    "add_key": "EPERM",
    "keyctl": "EPERM",
    "ptrace": "EPERM",
    "clone3": "ENOSYS",
    "io_uring_setup": "ENOSYS",
}


COUNTED = {name: 1 for name, answer in REFUSED.items() if answer == "EPERM"}


def answers_of(seen: ProcessSeen) -> dict[str, str]:
    """What the kernel answered to each call."""
    return dict(line.text.split() for line in seen.lines)  # type: ignore[misc]


@needs_sandbox
def test_calls_are_refused_in_a_sandbox(sandbox: Sandbox) -> None:
    """As the table says; those that only attacks need are counted."""
    seen = run(sandbox, MAKES)
    assert answers_of(seen) == REFUSED
    assert seen.refused_calls == COUNTED


@needs_sandbox
def test_an_older_kernel_refuses_them_itself(
    sandbox: Sandbox, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It asks nobody, so nobody counts."""
    monkeypatch.setattr(process, "asking_filter", lambda: bytes(8))  # not valid for any kernel
    seen = run(sandbox, MAKES)
    assert answers_of(seen) == REFUSED
    assert seen.refused_calls == {}


CALLS_OFTEN = """
    import ctypes, os, threading
    number = 250 if os.uname().machine == "x86_64" else 219
    def call():
        libc = ctypes.CDLL(None)
        for _ in range({times}):
            libc.syscall(number, 0, -2, 1)
    threads = [threading.Thread(target=call) for _ in range({threads})]
    for each in threads:
        each.start()
    print("said meanwhile")
    for each in threads:
        each.join()
"""


@needs_sandbox
def test_each_of_many_calls_is_counted(sandbox: Sandbox) -> None:
    """Also of threads that call at once; what the process says is heard as well."""
    seen = run(sandbox, CALLS_OFTEN.format(times=250, threads=4))
    assert [line.text for line in seen.lines] == ["said meanwhile"]
    assert seen.refused_calls == {"keyctl": 1000}


@needs_sandbox
def test_who_calls_without_end_is_ended_like_others(sandbox: Sandbox) -> None:
    """A call that nobody has answered yet holds nobody up."""
    source = CALLS_OFTEN.format(times=10**9, threads=4)
    with Process("it", launch_in(sandbox, source)) as it:
        assert it.wait_until(lambda: bool(it.seen.lines), 60)
    assert not it.alive
    assert it.seen.refused_calls["keyctl"] > 0


@needs_sandbox
def test_the_filter_is_what_refuses_them(sandbox: Sandbox, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without it the kernel does what is asked, or finds fault with the words of the call only."""
    monkeypatch.setattr(process, "filter_of_calls", bytes)
    answers = answers_of(run(sandbox, MAKES))
    assert answers["add_key"] == answers["keyctl"] == answers["ptrace"] == "done"
    assert not {name for name in answers if answers[name] == REFUSED[name] == "ENOSYS"}


def run_filter(program: bytes, architecture: int, number: int, argument: int = 0) -> str:
    """What the filter answers: a second reading of classic BPF, of the lines that ours has."""
    lines = list(struct.iter_unpack("=HBBI", program))
    seen = struct.pack("<iIQQ", number, architecture, 0, argument)
    at, held = 0, 0
    while True:
        code, yes, no, value = lines[at]
        if code == ANSWER:
            return {ALLOWED: "allowed", FAILS | 1: "refused", FAILS | 38: "missing"}[value]
        if code == LOAD:
            held, take = int.from_bytes(seen[value : value + 4], "little"), 0
        else:
            holds = {EQUAL: held == value, AT_LEAST: held >= value, ANY_BIT: bool(held & value)}
            take = yes if holds[code] else no
        at += 1 + take


@pytest.mark.parametrize("name", MACHINES)
def test_each_kind_of_machine_has_the_whole_table(name: str) -> None:
    """No call is refused but those that are named; another kind's calls are not there."""
    machine, program = MACHINES[name], filter_of_calls(name)
    refused = {*machine.refused.values(), *SINCE_2019.values()}
    missing = {*MISSING_SINCE_2019.values()}
    for number in range(600):
        expected = "refused" if number in refused else "missing" if number in missing else "allowed"
        assert run_filter(program, machine.architecture, number) == expected
    assert run_filter(program, machine.architecture, X32) == "missing"
    assert run_filter(program, machine.architecture + 1, 0) == "missing"


@pytest.mark.parametrize("name", MACHINES)
def test_threads_are_made_and_namespaces_are_not(name: str) -> None:
    """By clone(2), whose flags are its first argument."""
    machine, program = MACHINES[name], filter_of_calls(name)
    threads = 0x003D0F00
    assert not threads & NAMESPACES
    assert run_filter(program, machine.architecture, machine.clone, threads) == "allowed"
    for bit in (0x20000, 0x02000000, 0x04000000, 0x08000000, 0x10000000, 0x20000000, 0x40000000):
        assert run_filter(program, machine.architecture, machine.clone, threads | bit) == "refused"


def test_both_kinds_refuse_the_same() -> None:
    """By name."""
    tables = [{*machine.refused} for machine in MACHINES.values()]
    assert all(table == tables[0] for table in tables)


def test_an_unknown_machine_goes_without() -> None:
    """Its other walls stand."""
    assert filter_of_calls("riscv64") == b""


KEYS_OF_ITS_SESSION = """
    import ctypes, os
    libc = ctypes.CDLL(None, use_errno=True)
    keyctl = {"x86_64": 250, "aarch64": 219}[os.uname().machine]
    found = libc.syscall(keyctl, 10, -3, ctypes.c_char_p(b"user"), ctypes.c_char_p(b"secret"), 0)
    print("found" if found > 0 else "none")
"""
HAS_A_KEY = """
    import ctypes, os, sys
    from pathlib import Path
    from roslings.arena import Launch, Process, kernel
    libc = ctypes.CDLL(None, use_errno=True)
    add_key = {"x86_64": 248, "aarch64": 217}[os.uname().machine]
    kernel.leave_keys()
    name = ctypes.c_char_p(b"secret")
    assert libc.syscall(add_key, ctypes.c_char_p(b"user"), name, name, ctypes.c_size_t(6), -3) > 0
    exec(sys.argv[1])
    launch = Launch([sys.executable, "-I", "-c", sys.argv[1]], {}, Path("/"), namespaces=False)
    with Process("it", launch) as it:
        it.wait_ended(60)
    print(*(line.text for line in it.lines()))
"""


@needs("keys of the kernel")
def test_a_process_holds_no_key_of_its_makers_session() -> None:
    """Behind each wall, and where no filter keeps it from asking."""
    asks = textwrap.dedent(KEYS_OF_ITS_SESSION)
    words = [sys.executable, "-c", textwrap.dedent(HAS_A_KEY), asks]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.stdout.split() == ["found", "none"], done.stderr
