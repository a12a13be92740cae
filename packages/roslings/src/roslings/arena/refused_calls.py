"""System calls that no student's program needs, and that attacks begin with: the kernel refuses.

The table becomes a program for seccomp(2), in the classic BPF of <linux/filter.h>. What programs
only try, and do otherwise where the kernel is older, answers ENOSYS; the rest answers EPERM.
Where a machine has no filter, or is of another kind, its other walls stand as before.
"""

from __future__ import annotations

import errno
import os
import struct
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

NAMESPACES = 0x7E020000
"""All flags of clone(2) that make a namespace. No filter sees those of clone3(2): it is missing."""

LOAD, EQUAL, AT_LEAST, ANY_BIT, ANSWER = 0x20, 0x15, 0x35, 0x45, 0x06
NUMBER, ARCHITECTURE, FIRST_ARGUMENT = 0, 4, 16
"""Where these stand in `struct seccomp_data`; of an argument, its lower half on little endians."""
ALLOWED = 0x7FFF0000
FAILS = 0x00050000
ASKS = 0x7FC00000
"""The call waits until the one who holds the filter's other end has answered it: it is refused, and
told. Not there before Linux 5.0."""
X32 = 0x40000000
"""Calls of x86-64's third kind have this bit; nothing uses them."""


@dataclass(frozen=True)
class ProcessorKind:
    """A kind of processor, as the kernel numbers it and its calls."""

    architecture: int
    clone: int
    refused: dict[str, int]


MACHINES = {
    "x86_64": ProcessorKind(
        0xC000003E,
        56,
        {
            "ptrace": 101,
            "pivot_root": 155,
            "acct": 163,
            "mount": 165,
            "umount2": 166,
            "swapon": 167,
            "swapoff": 168,
            "reboot": 169,
            "init_module": 175,
            "delete_module": 176,
            "quotactl": 179,
            "kexec_load": 246,
            "add_key": 248,
            "request_key": 249,
            "keyctl": 250,
            "unshare": 272,
            "perf_event_open": 298,
            "open_by_handle_at": 304,
            "setns": 308,
            "process_vm_readv": 310,
            "process_vm_writev": 311,
            "finit_module": 313,
            "kexec_file_load": 320,
            "bpf": 321,
            "userfaultfd": 323,
        },
    ),
    "aarch64": ProcessorKind(
        0xC00000B7,
        220,
        {
            "umount2": 39,
            "mount": 40,
            "pivot_root": 41,
            "quotactl": 60,
            "acct": 89,
            "unshare": 97,
            "kexec_load": 104,
            "init_module": 105,
            "delete_module": 106,
            "ptrace": 117,
            "reboot": 142,
            "add_key": 217,
            "request_key": 218,
            "keyctl": 219,
            "swapon": 224,
            "swapoff": 225,
            "perf_event_open": 241,
            "open_by_handle_at": 265,
            "setns": 268,
            "process_vm_readv": 270,
            "process_vm_writev": 271,
            "finit_module": 273,
            "bpf": 280,
            "userfaultfd": 282,
            "kexec_file_load": 294,
        },
    ),
}
"""Sources: Linux, arch/x86/entry/syscalls/syscall_64.tbl and include/uapi/asm-generic/unistd.h."""
SINCE_2019 = {
    "pidfd_getfd": 438,
    "open_tree": 428,
    "move_mount": 429,
    "fsopen": 430,
    "fsconfig": 431,
    "fsmount": 432,
    "fspick": 433,
    "mount_setattr": 442,
}
MISSING_SINCE_2019 = {
    "io_uring_setup": 425,
    "io_uring_enter": 426,
    "io_uring_register": 427,
    "clone3": 435,
}
"""From then on a call has the same number on each machine."""


@cache
def filter_of_calls(machine: str = "", refuses: int = FAILS | errno.EPERM) -> bytes:
    """The filter for this machine, or for the named one; empty where there is none.

    `refuses` is what it says of a call that only attacks need.
    """
    known = MACHINES.get(machine or os.uname().machine)
    if known is None or (not machine and sys.maxsize < 2**32):
        return b""
    refused = {**known.refused, **SINCE_2019}
    return b"".join(
        _program(known, sorted(refused.values()), sorted(MISSING_SINCE_2019.values()), refuses)
    )


def asking_filter() -> bytes:
    """The same for this machine; somebody else refuses the calls, and counts them."""
    return filter_of_calls(refuses=ASKS)


def name_of(number: int) -> str:
    """Of a call that is refused on this machine; of another its number, in words."""
    known = MACHINES.get(os.uname().machine)
    names = {**known.refused, **SINCE_2019, "clone": known.clone} if known else {}
    return next((name for name, each in names.items() if each == number), f"call {number}")


def _program(
    machine: ProcessorKind, refused: Sequence[int], missing: Sequence[int], refuses: int
) -> list[bytes]:
    """Each comparison leads on, or to one of the three answers at the end."""
    begin = [
        (LOAD, ARCHITECTURE, None, None),
        (EQUAL, machine.architecture, None, "missing"),
        (LOAD, NUMBER, None, None),
        (AT_LEAST, X32, "missing", None),
    ]
    calls = [
        *((EQUAL, number, "refused", None) for number in refused),
        *((EQUAL, number, "missing", None) for number in missing),
    ]
    flags = [
        (EQUAL, machine.clone, None, "allowed"),
        (LOAD, FIRST_ARGUMENT, None, None),
        (ANY_BIT, NAMESPACES, "refused", None),
    ]
    lines = [*begin, *calls, *flags]
    place = {name: len(lines) + at for at, name in enumerate(("allowed", "refused", "missing"))}
    jumps = [
        _line(code, value, *(place[to] - at - 1 if to else 0 for to in (yes, no)))
        for at, (code, value, yes, no) in enumerate(lines)
    ]
    answers = (ALLOWED, refuses, FAILS | errno.ENOSYS)
    return [*jumps, *(_line(ANSWER, answer) for answer in answers)]


def _line(code: int, value: int, yes: int = 0, no: int = 0) -> bytes:
    """`struct sock_filter`."""
    return struct.pack("=HBBI", code, yes, no, value)
