"""Which wall is chosen, and that it holds."""

from __future__ import annotations

import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings.arena import choose_isolation, isolation, isolation_for_strangers
from roslings.arena.environment import base_environment
from roslings.arena.isolation import BARE, ENTER
from roslings.arena.shared_memory import SHARED_MEMORY, swept_shared_memory
from skips import needs, skip_without

REFUSING = """
    import os, sys
    sys.path.insert(0, {folder!r})
    import kernel
    uid, gid = os.getuid(), os.getgid()
    kernel.unshare(kernel.CLONE_NEWUSER)
    kernel.map_identity(uid, gid)
    with open("/proc/sys/user/max_{kind}_namespaces", "w") as limit:
        limit.write("0")
    os.execv(sys.executable, [sys.executable, "-c", "import roslings.arena as a;"
        "i = a.choose_isolation(); print(i.wall); print(i.because)"])
"""


def needs_namespaces() -> None:
    """Skip where the machine refuses namespaces."""
    skip_without("namespaces")
    isolation = choose_isolation()
    assert isolation.wall == "namespace", isolation.because


@pytest.mark.parametrize("kind", ["net", "pid"])
def test_a_kernel_that_refuses_namespaces_is_noticed(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A real refusal: the limit on namespaces is set to none, one level down."""
    monkeypatch.delenv("ROSLINGS_ISOLATION", raising=False)
    needs_namespaces()
    script = textwrap.dedent(REFUSING.format(folder=str(ENTER.parent), kind=kind))
    ran = subprocess.run([*BARE, "-c", script], capture_output=True, text=True, check=False)
    if ran.returncode and "Permission denied" in ran.stderr:
        skip_without("limit one level down")
    wall, because = ran.stdout.splitlines()
    assert wall == "domain"
    assert because == f"user.max_{kind}_namespaces is 0"  # no word of a disk that is full


def test_the_wall_can_be_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    """ROSLINGS_ISOLATION=domain does without namespaces."""
    monkeypatch.setenv("ROSLINGS_ISOLATION", "domain")
    assert choose_isolation().wall == "domain"


def test_the_second_wall_can_be_chosen_for_strangers(monkeypatch: pytest.MonkeyPatch) -> None:
    """What one runs of one's own is not run as somebody else."""
    monkeypatch.setenv("ROSLINGS_ISOLATION", "user")
    assert isolation_for_strangers().wall == "user"
    assert choose_isolation().wall != "user"


@needs("root")
def test_without_a_sandbox_root_takes_a_user_or_says_why_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Strangers' code never runs as root: another user holds it, or both reasons are told."""
    monkeypatch.delenv("ROSLINGS_ISOLATION", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))  # no bubblewrap
    isolation._best.cache_clear()
    try:
        found = isolation_for_strangers()
    finally:
        isolation._best.cache_clear()
    if found.wall == "user":
        assert found.lack is None
    else:
        assert found.lack
        assert "; and no user of its own can hold it: " in found.lack.reason
        assert "\nOr: " in found.lack.next_step


def test_only_loopback_exists_inside(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing can come in, and nothing can go out."""
    monkeypatch.delenv("ROSLINGS_ISOLATION", raising=False)
    needs_namespaces()
    listing = ["cat", "/proc/net/dev"]
    ran = subprocess.run([*BARE, str(ENTER), *listing], capture_output=True, text=True, check=True)
    names = [line.partition(":")[0].strip() for line in ran.stdout.splitlines()[2:]]
    assert "lo" in names
    moving = [line for line in ran.stdout.splitlines()[2:] if int(line.split()[2]) > 0]
    assert all(line.strip().startswith("lo:") for line in moving)


def test_two_leases_are_two_domains() -> None:
    """A domain is leased to one at a time, and comes back."""
    with leased_domain() as one, leased_domain() as other:
        assert one != other
        assert {one, other} <= set(range(1, 102))


def test_the_students_own_domain_is_not_leased(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nodes that the student has running must not be seen by the grader."""
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    with leased_domain() as domain:
        assert domain != 7


def test_a_lease_ends_with_its_process() -> None:
    """Killed or not, the kernel takes the port back."""
    source = """
        import os
        from ros2_on_pip.domain_lease import leased_domain
        lease = leased_domain()
        print(lease.__enter__(), flush=True)
        os.kill(os.getpid(), 9)
    """
    for _ in range(3):
        command = [sys.executable, "-c", textwrap.dedent(source)]
        ran = subprocess.run(command, capture_output=True, text=True, check=False)
        assert ran.stdout.strip().isdecimal()


def test_shared_memory_of_a_killed_node_is_swept() -> None:
    """What appeared and is held by nobody goes; what a living process holds stays."""
    mine, held = SHARED_MEMORY / "fastrtps_roslings_dead", SHARED_MEMORY / "fastrtps_roslings_held"
    old = SHARED_MEMORY / "fastrtps_roslings_old"
    try:
        old.touch()
        with swept_shared_memory():
            mine.touch()
            holder = held.open("w")
        assert not mine.exists()
        assert held.exists()
        assert old.exists()
        holder.close()
    finally:
        for path in (mine, held, old):
            path.unlink(missing_ok=True)


def test_an_older_version_that_is_sourced_does_not_stand_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A prefix that holds the package under test is left out of the node's environment."""
    (tmp_path / "mine/share/chatter").mkdir(parents=True)
    (tmp_path / "other/share/rover").mkdir(parents=True)
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{tmp_path}/mine:{tmp_path}/other:{tmp_path}/gone")
    environment = base_environment(tmp_path, hidden_package="chatter")
    prefixes = environment["AMENT_PREFIX_PATH"].split(":")
    assert f"{tmp_path}/other" in prefixes
    assert not {f"{tmp_path}/mine", f"{tmp_path}/gone"} & set(prefixes)
