"""The Linux calls behind an arena that Python 3.10 does not offer, and the kernel's own accounts.

Standard library only: the guardian and the script beside this file run it in a bare interpreter.
"""

from __future__ import annotations

import ctypes
import os
import sys

CLONE_NEWNS = 0x00020000
CLONE_NEWIPC = 0x08000000
CLONE_NEWUSER = 0x10000000
CLONE_NEWPID = 0x20000000
CLONE_NEWNET = 0x40000000

BYTES_A_FILE = 16384
"""On average; a file takes memory of the kernel even where it is empty."""

_PR_SET_PDEATHSIG = 1
_SIGKILL = 9
_PR_SET_DUMPABLE = 4
_PR_SET_SECCOMP = 22
_SECCOMP_MODE_FILTER = 2
_SECCOMP = {"x86_64": 317, "aarch64": 277}
_SECCOMP_SET_MODE_FILTER, _NEW_LISTENER = 1, 1 << 3
_LANDLOCK_CREATE, _LANDLOCK_ADD, _LANDLOCK_RESTRICT = 444, 445, 446
_BENEATH = 1
_KEYCTL = {"x86_64": 250, "aarch64": 219}
_JOIN_SESSION_KEYRING, _CLEAR_KEYRING = 1, 7
_OWN_KEYRINGS = (-4, -5)
"""A user's, and that of a user's sessions: keyctl(2)."""
_PR_SET_CHILD_SUBREAPER = 36
_PR_SET_NO_NEW_PRIVS = 38
_MS_NOSUID_NODEV = 0x2 | 0x4
_MS_NOSUID_NOEXEC = 0x2 | 0x8
_MS_REC_PRIVATE = 0x4000 | 0x40000
_MS_BIND_REC = 0x1000 | 0x4000
_MS_REMOUNT_BIND_READ_ONLY = 0x20 | 0x1000 | 0x1
_MOUNT_FLAGS = 0x1 | 0x2 | 0x4 | 0x8 | 0x400 | 0x800
"""Read-only, nosuid, nodev, noexec, noatime, nodiratime: the same numbers in statvfs(3)."""
_VIEW = b"size=1m,nr_inodes=1k,mode=0711"
_SIOCSIFFLAGS = 0x8914
_SIOCADDRT = 0x890B
_IFF_UP_LOOPBACK_RUNNING_MULTICAST = 0x1 | 0x8 | 0x40 | 0x1000
_RTF_UP = 0x1

_libc = ctypes.CDLL(None, use_errno=True)


class _Filter(ctypes.Structure):
    """`struct sock_fprog` of <linux/filter.h>."""

    _fields_ = (("lines", ctypes.c_ushort), ("program", ctypes.c_char_p))


_BYTES_A_LINE = 8


class _Route(ctypes.Structure):
    """`struct rtentry` of <net/route.h>, as the ioctl SIOCADDRT takes it."""

    _fields_ = (
        ("pad1", ctypes.c_ulong),
        ("destination", ctypes.c_ubyte * 16),
        ("gateway", ctypes.c_ubyte * 16),
        ("netmask", ctypes.c_ubyte * 16),
        ("flags", ctypes.c_ushort),
        ("pad2", ctypes.c_short),
        ("pad3", ctypes.c_ulong),
        ("pad4", ctypes.c_void_p),
        ("metric", ctypes.c_short),
        ("device", ctypes.c_char_p),
        ("mtu", ctypes.c_ulong),
        ("window", ctypes.c_ulong),
        ("irtt", ctypes.c_ushort),
    )


def _call(name: str, *arguments: object) -> None:
    """Call a libc function that returns -1 on failure. Raises OSError, named after it."""
    if getattr(_libc, name)(*arguments) == -1:
        code = ctypes.get_errno()
        raise OSError(code, f"{name}: {os.strerror(code)}")


def enter(besides: int = 0, other: int | None = None) -> None:
    """Take a user and a network namespace of one's own, and `besides`. Raises OSError.

    A process with threads may not. There, one is who one was, and can be the user `other` too,
    which only root may ask for.
    """
    flags = CLONE_NEWUSER | CLONE_NEWNET | besides
    if other is None:
        uid, gid = os.getuid(), os.getgid()
        unshare(flags)
        map_identity(uid, gid)
    else:
        unshare_with(flags, other)
    raise_loopback()


def enter_with_room(
    folder: str, most_bytes: int, other: int | None = None, view: str | None = None
) -> None:
    """Besides: a mount namespace, with a room for what strangers build. Raises OSError.

    `view` is a folder in which `other` will be shown what lies where only root may go.
    """
    enter(CLONE_NEWNS, other)
    keep_mounts_private()
    mount_terminals()
    mount_room(folder, most_bytes, most_bytes // BYTES_A_FILE)
    if view is not None:
        _call("mount", b"tmpfs", view.encode(), b"tmpfs", _MS_NOSUID_NODEV, _VIEW)


def show(source: str, target: str, writable: bool = False) -> None:
    """Let a folder or file be seen at another place as well, to be read only. Raises OSError."""
    if os.path.isdir(source):  # noqa: PTH112
        os.mkdir(target)  # noqa: PTH102
    else:
        os.close(os.open(target, os.O_CREAT | os.O_EXCL, 0o644))
    _call("mount", source.encode(), target.encode(), None, _MS_BIND_REC, None)
    if not writable:
        kept = os.statvfs(target).f_flag & _MOUNT_FLAGS  # a mount from outside cannot lose these
        _call("mount", None, target.encode(), None, _MS_REMOUNT_BIND_READ_ONLY | kept, None)


def unshare_with(flags: int, other: int) -> None:
    """Leave namespaces, that of users too; root stays root, and `other` is there. Raises OSError.

    The two are named by a child that has stayed outside: who has left can name but itself.
    """
    left, leaves = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(leaves)
        os._exit(_named_from_outside(os.getppid(), other, left))
    os.close(left)
    try:
        unshare(flags)
        os.write(leaves, b"!")
    finally:
        os.close(leaves)
        _, status = os.waitpid(child, 0)
    if code := os.waitstatus_to_exitcode(status):
        raise OSError(code, f"uid_map: {os.strerror(code)}")


def _named_from_outside(parent: int, other: int, left: int) -> int:
    """In the child: wait until the parent has left; the number of what went wrong."""
    try:
        if os.read(left, 1):
            for name in ("uid_map", "gid_map"):
                _write(f"/proc/{parent}/{name}", f"0 0 1\n{other} {other} 1\n")
    except OSError as error:
        return error.errno or 1
    return 0


def unshare(flags: int) -> None:
    """Leave the namespaces in `flags`. Raises OSError (EINVAL when this process has threads)."""
    _call("unshare", flags)


def enter_network(descriptor: int) -> None:
    """Let this thread alone enter a network namespace. Raises OSError: setns(2)."""
    _call("setns", descriptor, CLONE_NEWNET)


def map_identity(uid: int, gid: int) -> None:
    """Keep one's own user and group in the user namespace just entered.

    An unprivileged process must give up setgroups first: user_namespaces(7).
    """
    _write("/proc/self/setgroups", "deny")
    _write("/proc/self/uid_map", f"{uid} {uid} 1")
    _write("/proc/self/gid_map", f"{gid} {gid} 1")


def _write(path: str, text: str) -> None:
    descriptor = os.open(path, os.O_WRONLY)
    try:
        os.write(descriptor, text.encode())
    finally:
        os.close(descriptor)


def raise_loopback() -> None:
    """Bring `lo` up in a new network namespace, with multicast, which DDS discovery needs."""
    import fcntl  # these three would double what a guardian imports, and it has no use for them
    import socket
    import struct

    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
        request = struct.pack("16sH14x", b"lo", _IFF_UP_LOOPBACK_RUNNING_MULTICAST)
        fcntl.ioctl(control, _SIOCSIFFLAGS, request)
        route = _Route(flags=_RTF_UP, device=b"lo")
        for place, dotted in ((route.destination, "224.0.0.0"), (route.netmask, "240.0.0.0")):
            place[:] = struct.pack("=HH4s8x", socket.AF_INET, 0, socket.inet_aton(dotted))
        fcntl.ioctl(control, _SIOCADDRT, route)


def mount_private(kind: str, place: str) -> None:
    """Mount a fresh `proc` or `tmpfs` that only this mount namespace sees. Raises OSError."""
    _call("mount", kind.encode(), place.encode(), kind.encode(), _MS_NOSUID_NODEV, None)


def mount_room(place: str, most_bytes: int, most_files: int) -> None:
    """Mount an empty folder that can be filled so far and no further. Raises OSError."""
    options = f"size={most_bytes},nr_inodes={most_files},mode=0700"
    _call("mount", b"tmpfs", place.encode(), b"tmpfs", _MS_NOSUID_NODEV, options.encode())


def mount_terminals() -> None:
    """Pseudo-terminals of one's own at /dev/pts: whoever sees them sees no others."""
    options = b"newinstance,ptmxmode=0666,mode=0620"
    _call("mount", b"devpts", b"/dev/pts", b"devpts", _MS_NOSUID_NOEXEC, options)


def be_unreadable() -> None:
    """Let no process of the same user trace this one, or open what it has open: ptrace(2)."""
    _call("prctl", _PR_SET_DUMPABLE, 0, 0, 0, 0)


def keep_mounts_private() -> None:
    """Let no mount of this namespace reach the machine. Raises OSError."""
    _call("mount", None, b"/", None, _MS_REC_PRIVATE, None)


def become_user(uid: int) -> None:
    """Be this user and this group and nobody else, for good: no program gives more rights back.

    Raises OSError. It must have one thread only: the others would keep their rights.
    """
    os.setgroups([])
    os.setresgid(uid, uid, uid)
    os.setresuid(uid, uid, uid)
    _call("prctl", _PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)


def refuse_calls(program: bytes) -> None:
    """Have the kernel judge each system call of this process by a filter, for good: seccomp(2).

    Raises OSError where the kernel has none.
    """
    _call("prctl", _PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    filter_ = _Filter(len(program) // _BYTES_A_LINE, program)
    _call("prctl", _PR_SET_SECCOMP, _SECCOMP_MODE_FILTER, ctypes.byref(filter_), 0, 0)


def ask_before_calls(program: bytes) -> int:
    """As `refuse_calls`; whoever holds the descriptor answers the calls of which the filter asks.

    Raises OSError where the kernel has no such filter, or another one has this right already.
    """
    _call("prctl", _PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    filter_ = _Filter(len(program) // _BYTES_A_LINE, program)
    number = _SECCOMP[os.uname().machine]
    return _numbered(number, _SECCOMP_SET_MODE_FILTER, _NEW_LISTENER, ctypes.byref(filter_))


def confine(rules: list[tuple[str, int]], rights: int, scopes: int) -> None:
    """Let this process do with files what `rules` say, and no more of `rights`: landlock(7).

    Raises OSError. What it holds open stays as it is.
    """
    kinds = (ctypes.c_uint64 * 3)(rights, 0, scopes)
    size = ctypes.c_size_t(24 if scopes else 8)
    ruleset = _numbered(_LANDLOCK_CREATE, ctypes.byref(kinds), size, 0)
    for path, allowed in rules:
        place = os.open(path, os.O_PATH | os.O_CLOEXEC)
        beneath = allowed.to_bytes(8, sys.byteorder) + place.to_bytes(4, sys.byteorder)
        _numbered(_LANDLOCK_ADD, ruleset, _BENEATH, beneath, 0)
        os.close(place)
    _call("prctl", _PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    _numbered(_LANDLOCK_RESTRICT, ruleset, 0)
    os.close(ruleset)


def _numbered(number: int, *words: object) -> int:
    """A call that libc has no function for. Raises OSError."""
    answer: int = _libc.syscall(number, *words)
    if answer == -1:
        code = ctypes.get_errno()
        raise OSError(code, f"call {number}: {os.strerror(code)}")
    return answer


def leave_keys() -> None:
    """Leave the keys of whoever began this process: its session has a new, empty keyring.

    Raises OSError where there are no keys, or a container keeps all from them.
    """
    _keyctl(_JOIN_SESSION_KEYRING, None, 0)


def forget_keys() -> None:
    """Clear what this process's user keeps for all of its processes. Raises OSError."""
    for keyring in _OWN_KEYRINGS:
        _keyctl(_CLEAR_KEYRING, keyring, 0)


def _keyctl(*words: object) -> None:
    """Raises OSError; nothing on a machine whose number for it is not known."""
    number = _KEYCTL.get(os.uname().machine)
    if number is not None:
        _numbered(number, *words)


def die_with_parent() -> None:
    """Have the kernel kill this process when its parent ends."""
    _call("prctl", _PR_SET_PDEATHSIG, _SIGKILL, 0, 0, 0)


def adopt_orphans() -> None:
    """Become the parent of every descendant whose own parent ended."""
    _call("prctl", _PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def cores() -> int:
    """The processors that this process may use."""
    return len(os.sched_getaffinity(0))


def waits(pids: list[int]) -> dict[str, int]:
    """For each thread of these processes: nanoseconds for which it was ready and had no processor.

    The second number of schedstat (Linux, Documentation/scheduler/sched-stats.rst). Empty where
    the kernel keeps no such account.
    """
    found: dict[str, int] = {}
    for pid in pids:
        try:
            threads = os.listdir(f"/proc/{pid}/task")  # noqa: PTH208
        except OSError:
            continue
        for thread in threads:
            if (waited := waited_ns(pid, int(thread))) is not None:
                found[thread] = waited
    return found


def waited_ns(pid: int, thread: int) -> int | None:
    """So long was a thread ready to run, and no processor was free; None where nobody knows."""
    try:
        return int(read(f"/proc/{pid}/task/{thread}/schedstat").split()[1])
    except (OSError, IndexError, ValueError):
        return None


def read(path: str) -> bytes:
    """The whole of a file of /proc. Raises OSError."""
    with open(path, "rb") as file:  # noqa: PTH123
        return file.read()
