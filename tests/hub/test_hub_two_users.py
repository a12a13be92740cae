"""A real JupyterHub, installed, configured and started as the page for teachers says it.

Two users of one computer log in. They have one edition, which they cannot write to.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hub_page import block

from roslings.course import root
from roslings_class.release import release
from skips import needs

pytestmark = [
    pytest.mark.slow,
    needs("other users", "useradd", "environment made by ./roslings"),
]

PLAY = Path(__file__).with_name("play.py")
ALONE = ("unshare", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc", "--net")
DOMAINS = {"anna": 97, "ben": 98}
SAID = "everal people use this computer, so your ROS_DOMAIN_ID is {}."


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Folders that everybody may enter. It has an edition, with a copy of this environment."""
    folder = tmp_path_factory.mktemp("hub") / "server"
    folder.mkdir(mode=0o755)
    course = folder / "opt/roslings"
    course.parent.mkdir()
    release(course)
    subprocess.run(["cp", "-a", sys.prefix, course / ".venv"], check=True)
    python = {"ROSLINGS_PYTHON": str(Path(sys.base_prefix, "bin/python3"))}
    done = subprocess.run(
        ["bash", "-ec", block("bash", "and add JupyterHub to it", folder)],
        env={**os.environ, **python},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    yield folder
    shutil.rmtree(folder)


@pytest.fixture(scope="module")
def seen(server: Path) -> dict[str, dict[str, str]]:
    """What both have seen, and where."""
    settings = server / "settings.json"
    settings.write_text(
        json.dumps(
            {
                "folder": str(server),
                "course": str(server / "opt/roslings"),
                "python": [sys.base_prefix, str(root())],
                "config": block("python", "Write this into", server),
                "start": block("bash", "Then start it", server),
            }
        )
    )
    done = subprocess.run(
        [*ALONE, sys.executable, PLAY, settings],
        capture_output=True,
        text=True,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    log = server / "hub.log"
    assert done.returncode == 0, done.stderr + (log.read_text("utf-8") if log.is_file() else "")
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@pytest.mark.parametrize("name", DOMAINS)
def test_each_is_told_a_domain_of_their_own(seen: dict[str, dict[str, str]], name: str) -> None:
    """In one line of the terminal, and once in the notebook."""
    own, domain = seen[name], DOMAINS[name]
    assert own["terminal"].count("roslings: s" + SAID.format(domain)) == 1
    assert f"ROS_DOMAIN_ID={domain}" in own["terminal"]
    assert own["kernel"].count("S" + SAID.format(domain)) == 1
    assert f"\n{name}\n" in own["who"] and f"/home/{name}/roslings_ws/notebooks/" in own["who"]


def test_nobody_hears_the_cmd_vel_of_the_other(seen: dict[str, dict[str, str]]) -> None:
    """Both drive at once; who asks for the other's domain by hand hears it."""
    assert "domain 97 heard [0.5]\n" in seen["anna"]["kernel"]
    assert "domain 98 heard [0.25]\n" in seen["ben"]["kernel"]
    for own in seen.values():
        assert "Publisher count: 1" in own["topic"]
        assert re.findall(r"^0\.\d+$", own["across"], re.M) == ["0.5", "0.25"]


@pytest.mark.parametrize(
    ("device", "name", "parameter"),
    [("board", "ttyROVER", "port"), ("camera", "rover_camera", "device")],
)
def test_board_and_camera_have_a_place_of_each_users_own(
    seen: dict[str, dict[str, str]], device: str, name: str, parameter: str
) -> None:
    """The first has the card's; the other is told what to give the node."""
    own = f"/tmp/roslings-2016/{name}"
    assert f" /tmp/{name}\n" in seen["anna"][device] and "--ros-args" not in seen["anna"][device]
    assert f" {own}\n" in seen["ben"][device]
    assert f"Start your node with: --ros-args -p {parameter}:={own}\n" in seen["ben"][device]


def test_nobody_writes_to_the_course(seen: dict[str, dict[str, str]], server: Path) -> None:
    """Kernel and settings of each lie in their own workspace, where root has written none."""
    assert set(seen) == set(DOMAINS)
    for name, number in (("anna", 2015), ("ben", 2016)):
        kernel = server / f"home/{name}/roslings_ws/.roslings/jupyter/kernels/roslings/kernel.json"
        assert kernel.stat().st_uid == number
    owners = {path.lstat().st_uid for path in (server / "opt/roslings").rglob("*")}
    assert not owners & {2015, 2016}
