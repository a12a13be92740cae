"""What can be done on this very machine where no wall holds strangers' code: nothing else is said.

Who is an ordinary user already is not told to be one. What the kernel forbids is named by its
setting. Another machine is advised only where this one has no way.
"""

from __future__ import annotations

import os
import pwd
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from roslings.arena.bounds import kernel_counts_by_namespace

SETTINGS = Path("/proc/sys")
MOST = tuple(f"user.max_{kind}_namespaces" for kind in ("user", "net", "mnt", "pid", "ipc", "uts"))
"""How many namespaces there may be: namespaces(7). Whoever meets one is told ENOSPC."""
APPARMOR = "kernel.apparmor_restrict_unprivileged_userns"
DEBIAN = "kernel.unprivileged_userns_clone"
ENOUGH = 15000
NO_MORE = "No space left on device"
SIGNS_OF_CONTAINERS = ("/.dockerenv", "/run/.containerenv", "/run/systemd/container")
ACCOUNTS = range(1000, 60000)
"""Of people: Debian Policy 9.2.2."""
NO_SHELLS = ("nologin", "false", "")
ELSEWHERE = "Grade on another machine: on this one no way is known."
OUTSIDE = "Grade on a machine that is not a container."


@dataclass(frozen=True)
class Facts:
    """What of this machine decides which ways there are."""

    is_root: bool
    is_container: bool = False
    has_sudo: bool = False
    people: tuple[str, ...] = ()
    """Names of those who can log in, and are not root."""
    settings: Mapping[str, int] = field(default_factory=dict)
    """Of the kernel, as far as it has them."""
    counts_by_namespace: bool = True


def facts() -> Facts:
    """As they are now."""
    found = {name: _setting(name) for name in (*MOST, APPARMOR, DEBIAN)}
    return Facts(
        is_root=os.geteuid() == 0,
        is_container=any(Path(sign).exists() for sign in SIGNS_OF_CONTAINERS),
        has_sudo=shutil.which("sudo") is not None,
        people=tuple(
            each.pw_name
            for each in pwd.getpwall()
            if each.pw_uid in ACCOUNTS and Path(each.pw_shell).name not in NO_SHELLS
        ),
        settings={name: value for name, value in found.items() if value is not None},
        counts_by_namespace=kernel_counts_by_namespace(),
    )


def _setting(name: str) -> int | None:
    try:
        return int((SETTINGS / name.replace(".", "/")).read_text("ascii"))
    except (OSError, ValueError):
        return None


def in_words(refusal: str, here: Facts) -> str:
    """What the kernel meant: ENOSPC has nothing to do with the disk when it makes namespaces."""
    if NO_MORE not in refusal:
        return refusal
    none = [name for name in MOST if here.settings.get(name) == 0]
    return f"{none[0]} is 0" if none else "all that the kernel allows are taken"


def to_namespaces(here: Facts) -> str:
    """The next step where the kernel refuses namespaces."""
    wanted = " ".join(_wanted_settings(here))
    who = "Allow them" if here.is_root or here.has_sudo else "Allow them, as root"
    change = "sudo sysctl" if here.has_sudo and not here.is_root else "sysctl"
    ways = [f"{who}: {change} -w {wanted}"] if wanted else []
    if not here.is_root and here.has_sudo:
        ways.append("Run the same command with sudo: root takes a user for each submission.")
    return _told(ways, here)


def _wanted_settings(here: Facts) -> Iterator[str]:
    """As they must be; root is not asked the first two."""
    if here.settings.get(APPARMOR) == 1 and not here.is_root:
        yield f"{APPARMOR}=0"
    if here.settings.get(DEBIAN) == 0 and not here.is_root:
        yield f"{DEBIAN}=1"
    yield from (f"{name}={ENOUGH}" for name in MOST if here.settings.get(name) == 0)


def to_a_sandbox(here: Facts) -> str:
    """The next step where bubblewrap is there and cannot work."""
    return _told([*_as_somebody(here)], here)


def to_bounds(here: Facts) -> str:
    """The next step where nothing bounds the number of processes."""
    if here.counts_by_namespace:
        return _told([*_as_somebody(here)], here)
    return _told(["Install Linux 5.14 or a newer one."], here)


def _as_somebody(here: Facts) -> Iterator[str]:
    if here.is_root and here.people:
        yield f"Run the command as an ordinary user: {here.people[0]}"


def _told(ways: Sequence[str], here: Facts) -> str:
    last = [OUTSIDE] if here.is_container else []
    return "\nOr: ".join([*ways, *last]) or ELSEWHERE
