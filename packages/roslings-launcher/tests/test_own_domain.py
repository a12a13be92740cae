"""A ROS domain for each user of a shared computer: who shares it, what is said, who has chosen.

`ls` and `id` of the system are asked, so a folder in front of PATH decides what they tell.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from course_copy import REAL

from skips import skip_without

FRAGMENT = REAL / "packages/roslings-launcher/src/roslings_launcher/domain.sh"
SHELLS = ("sh", "bash", "zsh")
ALONE = "dr-xr-xr-x 9 0 0 0 Nov 27 22:56 /proc/1\ndr-xr-xr-x 9 1004 1004 0 Nov 27 22:56 /proc/812\n"
CONTAINER = Path("/.dockerenv").exists() or Path("/run/.containerenv").exists()


class Computer:
    """A shell on a computer that user 1004 works at; `seen` is what `ls` tells of all others."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name in ("id", "ls"):
            (folder / name).write_text(f'#!/bin/sh\n. "{folder}/{name}.sh"\n')
            (folder / name).chmod(0o755)
        (folder / "id.sh").write_text("echo 1004\n")

    def domain(self, seen: str = "", homes: str = "", shell: str = "sh", **variables: str) -> str:
        """What is said, and the domain afterwards."""
        (self.folder / "seen").write_text(ALONE + seen)
        (self.folder / "homes").write_text(homes)
        told = 'case "$*" in */proc/*) cat "{0}/seen" ;; *) cat "{0}/homes" ;; esac\n'
        (self.folder / "ls.sh").write_text(told.format(self.folder))
        done = subprocess.run(
            [shell, "-uc", f'. "{FRAGMENT}"; echo "$_roslings_said|${{ROS_DOMAIN_ID-}}"'],
            env={"PATH": f"{self.folder}:/usr/bin:/bin", "HOME": "/home/me", **variables},
            capture_output=True,
            text=True,
            check=True,
        )
        assert done.stderr == ""
        return done.stdout.strip()


@pytest.fixture
def computer(tmp_path: Path) -> Computer:
    """One that nobody shares yet."""
    return Computer(tmp_path)


OTHER = "dr-xr-xr-x 9 1007 1007 0 Nov 27 22:56 /proc/4711\n"
LOGGED_IN = "drwx------ 9 1219401103 513 0 Nov 27 22:56 /run/user/1219401103\n"
SAID = "roslings: several people use this computer, so your ROS_DOMAIN_ID is 96.|96"


@pytest.mark.parametrize("shell", [name for name in SHELLS if shutil.which(name)])
def test_who_shares_a_computer_has_a_domain(computer: Computer, shell: str) -> None:
    """Where another person's program runs, or is logged in, however large the number."""
    assert computer.domain(shell=shell) == "|"
    assert computer.domain(OTHER, shell=shell) == SAID
    assert computer.domain(LOGGED_IN, shell=shell) == SAID


@pytest.mark.parametrize("owner", ["0", "101", "999", "1004", "64205", "65534", "100999", "?", ""])
def test_services_and_containers_are_nobody(computer: Computer, owner: str) -> None:
    """Nor the users that a grading lends, nor what cannot be read."""
    assert computer.domain(f"dr-xr-xr-x 9 {owner} 0 0 Nov 27 22:56 /proc/4711\n") == "|"


def test_folders_of_others_count(computer: Computer) -> None:
    """On the computer itself: the night before, the others were there."""
    folder = "drwxr-x--- 9 1007 1007 4096 Nov 26 09:00 /home/you/\n"
    assert computer.domain(homes=folder) == ("|" if CONTAINER else SAID)
    assert computer.domain(homes=folder.replace("1007", "1004")) == "|"


@pytest.mark.parametrize(
    "variables",
    [
        {"ROS_DOMAIN_ID": "7"},
        {"ROS_DOMAIN_ID": "0"},
        {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"},
    ],
)
def test_who_has_chosen_keeps_it(computer: Computer, variables: dict[str, str]) -> None:
    """A domain, or a robot on the network, which has a domain already."""
    kept = variables.get("ROS_DOMAIN_ID", "")
    assert computer.domain(OTHER, **variables) == f"|{kept}"


def test_who_came_by_a_jupyterhub_is_never_alone(computer: Computer) -> None:
    """The first of a class has a domain too, also in a container; who has chosen keeps it."""
    assert computer.domain(JUPYTERHUB_USER="anna") == SAID
    assert computer.domain(JUPYTERHUB_USER="anna", ROS_DOMAIN_ID="7") == "|7"


def test_a_program_within_says_it_too(computer: Computer) -> None:
    """A terminal of JupyterLab has the domain already, and nobody saw the line of the server."""
    within = {"ROS_DOMAIN_ID": "96", "ROSLINGS_OWN_DOMAIN": "96"}
    assert computer.domain(**within) == SAID
    assert computer.domain(**within | {"ROS_DOMAIN_ID": "7"}) == "|7"


def test_an_empty_choice_is_none(computer: Computer) -> None:
    """ROS takes it as 0; and without HOME there are only processes to look at."""
    local = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    assert computer.domain(OTHER, ROS_DOMAIN_ID="", HOME="", **local) == SAID


@pytest.mark.parametrize("missing", ["id", "ls"])
def test_a_bare_system_changes_nothing(computer: Computer, missing: str) -> None:
    """And says nothing of programs that are not there."""
    (computer.folder / missing).write_text("#!/bin/sh\nexit 127\n")
    assert computer.domain(OTHER) == "|"


def test_a_hundred_users_have_a_hundred_domains(computer: Computer) -> None:
    """Numbers that follow each other, as a class has them; all are domains that ROS can use."""
    found = set()
    for uid in range(1000, 1101):
        (computer.folder / "id.sh").write_text(f"echo {uid}\n")
        found.add(int(computer.domain(OTHER + "x 9 1999 0 0 N 2 9 /proc/3\n").rpartition("|")[2]))
    assert found == set(range(1, 102))


def test_a_real_neighbour_is_seen() -> None:
    """Not told by a file: a process of another user runs here."""
    if os.geteuid() != 0:
        skip_without("root")
    neighbour = subprocess.Popen(["sleep", "600"], user=1007, group=1007, extra_groups=[])
    try:
        done = subprocess.run(
            ["sh", "-c", f'. "{FRAGMENT}"; echo "$ROS_DOMAIN_ID"'],
            env={"PATH": "/usr/bin:/bin", "HOME": "/root"},
            capture_output=True,
            text=True,
            check=True,
        )
        assert done.stdout == "1\n"
    finally:
        neighbour.kill()
        neighbour.wait()


def sourced(computer: Computer, times: int, path: str = "", **variables: str) -> tuple[str, str]:
    """The domain, and what was said, after so many times `source setup.bash` in one terminal."""
    (computer.folder / "seen").write_text(ALONE + OTHER)
    (computer.folder / "homes").touch()
    (computer.folder / "ls.sh").write_text(f'cat "{computer.folder}/seen"\n')
    line = f"source {REAL}/setup.bash; " * times
    done = subprocess.run(
        ["bash", "-c", f"{line} echo $ROS_DOMAIN_ID; compgen -v | grep -c _roslings"],
        env={
            "PATH": f"{computer.folder}:/usr/bin:/bin{path}",
            "HOME": "/home/me",
            "ROS_DISTRO": "jazzy",
            **variables,
        },
        capture_output=True,
        text=True,
        check=False,
    )
    domain, left = done.stdout.split()
    assert left == "0"
    return domain, done.stderr


def test_both_doors_tell_it(computer: Computer) -> None:
    """`source setup.bash` in a terminal, once; what it exports is what `./roslings` then finds."""
    line = SAID.partition("|")[0] + "\n"
    assert sourced(computer, 2) == ("96", line)
    assert sourced(computer, 1, path=f":{REAL}") == ("96", line)


def test_a_terminal_of_jupyterlab_tells_it_once(computer: Computer) -> None:
    """JupyterLab was started with the domain; who chose another one is told nothing."""
    line = SAID.partition("|")[0] + "\n"
    assert sourced(computer, 2, ROS_DOMAIN_ID="96", ROSLINGS_OWN_DOMAIN="96") == ("96", line)
    assert sourced(computer, 2, ROS_DOMAIN_ID="7", ROSLINGS_OWN_DOMAIN="96") == ("7", "")
