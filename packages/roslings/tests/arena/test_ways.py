"""A refusal names the ways that this machine has, and no others."""

from __future__ import annotations

import pwd
from itertools import product
from pathlib import Path

import pytest

from roslings.arena import ways
from roslings.arena.users import _closed
from roslings.arena.ways import APPARMOR, DEBIAN, MOST, Facts

EVERY = [
    Facts(root, container, sudo, people, settings, new)
    for root, container, sudo, people, settings, new in product(
        (False, True),
        (False, True),
        (False, True),
        ((), ("anna",)),
        ({}, {APPARMOR: 1}, {DEBIAN: 0}, {MOST[1]: 0}),
        (False, True),
    )
]
STEPS = (ways.to_namespaces, ways.to_a_sandbox, ways.to_bounds)


@pytest.mark.parametrize("here", EVERY, ids=str)
def test_only_ways_that_exist_are_named(here: Facts) -> None:
    """On every kind of machine, whoever asks."""
    for step in STEPS:
        told = step(here)
        assert told and max(map(len, told.splitlines())) <= 100
        if not here.is_root or not here.people:
            assert "as an ordinary user" not in told
        if here.is_root:
            assert "sudo" not in told and "as root" not in told
        if not here.has_sudo:
            assert "sudo" not in told
        assert ("not a container" in told) == here.is_container
        for name in (APPARMOR, DEBIAN, *MOST):
            assert name not in told or name in here.settings


def test_what_the_kernel_forbids_is_named_with_its_mend() -> None:
    """For an ordinary user with sudo, and for root."""
    person = Facts(is_root=False, has_sudo=True, settings={APPARMOR: 1, MOST[0]: 0})
    told = ways.to_namespaces(person).splitlines()[0]
    assert told == f"Allow them: sudo sysctl -w {APPARMOR}=0 {MOST[0]}=15000"
    root = Facts(is_root=True, settings={APPARMOR: 1, MOST[0]: 0})
    assert ways.to_namespaces(root) == f"Allow them: sysctl -w {MOST[0]}=15000"


def test_no_more_namespaces_is_no_full_disk() -> None:
    """The kernel has one word for both."""
    none = Facts(is_root=False, settings={MOST[0]: 0})
    for refusal in (
        "unshare: No space left on device",
        "bwrap: Creating new namespace failed: No space left on device",
    ):
        assert ways.in_words(refusal, none) == f"{MOST[0]} is 0"
        assert "disk" not in ways.in_words(refusal, Facts(is_root=False))
    assert ways.in_words("unshare: not permitted", none) == "unshare: not permitted"


def test_this_machine_is_looked_at() -> None:
    """Its own kernel and people."""
    here = ways.facts()
    assert {*here.settings} <= {*MOST, APPARMOR, DEBIAN} and MOST[0] in here.settings
    assert "root" not in here.people


@pytest.mark.parametrize(
    "home",
    [
        Path("/root"),
        Path("/home"),
        Path.home(),
        *(Path(each.pw_dir) for each in pwd.getpwall()[:3]),
    ],
)
def test_nobody_is_told_to_open_a_home(home: Path) -> None:
    """What else lies there would be open, too."""
    if any(
        home == Path(each.pw_dir) or home in Path(each.pw_dir).parents for each in pwd.getpwall()
    ):
        assert "chmod" not in _closed(home).next_step
    assert "/opt" in _closed(home).next_step
