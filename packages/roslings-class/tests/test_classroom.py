"""`./roslings serve`: the files of a room, asked for as browsers and as pip ask."""

from __future__ import annotations

import http.client
import os
import re
import socket
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Iterator
from html import unescape
from pathlib import Path
from urllib.request import urlopen

import pytest

from ros2_on_pip.network_cards import cards
from roslings import course
from roslings_class import classroom
from roslings_class.classroom import LOOPBACK, CannotServe, Handout, addresses, offer, serving, told

RCLPY = "ros_rclpy-7.1.6-{tag}-manylinux_2_28_x86_64.whl"


def wheel(folder: Path, name: str, content: str = "") -> Path:
    """A small wheel that pip can install."""
    path = folder / name
    project, version = name.split("-")[:2]
    info = f"{project}-{version}.dist-info"
    with zipfile.ZipFile(path, "w") as packed:
        packed.writestr(f"{project}.py", content)
        packed.writestr(
            f"{info}/METADATA", f"Metadata-Version: 2.1\nName: {project}\nVersion: {version}\n"
        )
        packed.writestr(
            f"{info}/WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
        )
        packed.writestr(f"{info}/RECORD", "")
    return path


@pytest.fixture
def room(tmp_path: Path) -> Handout:
    """An edition, wheels of two Pythons, and a site with files that are nobody's business."""
    edition, wheels, site = tmp_path / "edition", tmp_path / "wheels", tmp_path / "site"
    for folder in (edition / "labs", wheels, site / "labs", site / ".git"):
        folder.mkdir(parents=True)
    (edition / "roslings").write_text("#!/bin/sh\n")
    (edition / "roslings").chmod(0o755)
    wheel(wheels, "num_x-2.0-py3-none-any.whl", "VERSION = '2.0'\n")
    for tag in ("cp312-cp312", "cp310-cp310"):
        wheel(wheels, RCLPY.format(tag=tag))
    (wheels / "notes.txt").write_text("mine")
    (site / "index.html").write_text("<h1>The course</h1>")
    (site / "labs/index.html").write_text("<h1>Labs</h1>")
    (site / ".git/config").write_text("secret")
    (tmp_path / "secret.txt").write_text("secret")
    (site / "out.txt").symlink_to(tmp_path / "secret.txt")
    own = wheel(tmp_path, "roslings-0.1.0-py3-none-any.whl")
    return offer(edition, own, classroom._wheels_in(wheels), classroom._pages_in(site))


@pytest.fixture
def address(room: Handout) -> Iterator[str]:
    """Where it can be had, while the test runs."""
    with serving(room, LOOPBACK, 0) as found:
        assert len(found) == 1
        yield found[0]


def read(address: str) -> str:
    """A page."""
    with urlopen(address) as answer:
        return str(answer.read().decode())


def status(address: str, path: str, method: str = "GET") -> int:
    """The answer's number; the path is sent as it is, dots and all."""
    asked = http.client.HTTPConnection(address.removeprefix("http://"))
    asked.request(method, path)
    answer = asked.getresponse()
    answer.read()
    asked.close()
    return answer.status


def test_the_first_page_says_what_to_type(address: str) -> None:
    """With the address by which this student has found it."""
    page = read(address)
    for line in classroom.commands(address):
        assert line in unescape(page)
    assert "Python 3.10, 3.12" in page
    assert 'href="/site/index.html"' in page
    asked = http.client.HTTPConnection(address.removeprefix("http://"))
    asked.request("GET", "/", headers={"Host": "desk-of-mrs-k:8000"})
    assert "PIP_INDEX_URL=http://desk-of-mrs-k:8000/simple/" in asked.getresponse().read().decode()
    asked.request("GET", "/", headers={"Host": "<script>"})
    page = asked.getresponse().read().decode()
    assert "script" not in page
    assert f"PIP_INDEX_URL={address}/simple/" in page


def test_the_edition_is_one_file(address: str, tmp_path: Path) -> None:
    """It becomes one folder, and what could be run can still be."""
    with urlopen(f"{address}/roslings-course.tar.gz") as answer:
        (tmp_path / "got.tar.gz").write_bytes(answer.read())
    subprocess.run(["tar", "xzf", "got.tar.gz"], cwd=tmp_path, check=True)
    assert os.access(tmp_path / "roslings-course/roslings", os.X_OK)
    with tarfile.open(tmp_path / "got.tar.gz") as packed:
        assert {(entry.uid, entry.uname) for entry in packed} == {(0, "")}


def test_pip_takes_packages_from_it(address: str, tmp_path: Path) -> None:
    """By the settings that the first page names, and from nowhere else; the digest is looked at."""
    words = [
        sys.executable,
        "-m",
        "pip",
        "download",
        "--no-deps",
        "-d",
        str(tmp_path),
        "Num.X==2.0",
    ]
    own = {"PIP_INDEX_URL": f"{address}/simple/", "PIP_TRUSTED_HOST": LOOPBACK, "no_proxy": "*"}
    plain = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "PIP_CONFIG_FILE": os.devnull}
    done = subprocess.run(words, env=plain | own, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "num_x-2.0-py3-none-any.whl").is_file()
    assert re.search(r"#sha256=[0-9a-f]{64}", read(f"{address}/simple/num-x/"))
    assert "/simple/ros-rclpy/" in read(f"{address}/simple/")


@pytest.mark.parametrize(
    "path",
    [
        "/site/../secret.txt",
        "/site/%2e%2e/secret.txt",
        "/site/out.txt",
        "/site/.git/config",
        "/wheels/notes.txt",
        "/wheels/",
        "//etc/passwd",
        "/etc/passwd",
        "/simple/no-such-package/",
        "/edition/roslings",
        "/labs/topics/solution",
    ],
)
def test_nothing_else_can_be_had(address: str, path: str) -> None:
    """Neither files beside those, nor what a link leads to, nor hidden ones."""
    assert status(address, path) == 404


def test_nothing_can_be_written(address: str) -> None:
    """And a head is a head."""
    assert [status(address, "/x", method) for method in ("PUT", "POST", "DELETE")] == [501] * 3
    assert status(address, "/wheels/num_x-2.0-py3-none-any.whl", "HEAD") == 200
    assert status(address, "/site/labs/") == 200


def test_thirty_at_once(address: str, room: Handout) -> None:
    """All connect before the first is answered; one goes away in the middle."""
    host, port = address.removeprefix("http://").split(":")
    gone = socket.create_connection((host, int(port)))
    gone.sendall(b"GET /wheels/num_x-2.0-py3-none-any.whl HTTP/1.1\r\n")
    gone.close()
    asked = [http.client.HTTPConnection(host, int(port)) for _ in range(30)]
    for each in asked:
        each.connect()
    for each in asked:
        each.request("GET", f"/{classroom.ARCHIVE}")
    sizes = {len(each.getresponse().read()) for each in asked}
    assert sizes == {room.files[classroom.ARCHIVE].stat().st_size}


def test_what_is_there_is_told(room: Handout) -> None:
    """And what to type for what is not."""
    full = told(room, ["http://10.0.0.5:8000", "http://127.0.0.1:8000"])
    assert "The course can be had at http://10.0.0.5:8000\n  or        http://127" in full
    assert "with ROS for Python 3.10, 3.12" in full
    assert "site      yes" in full
    bare = Handout(room.files, {"roslings-0.1.0-py3-none-any.whl": Path("x")})
    poor = told(bare, ["http://10.0.0.5:8000"])
    assert "./roslings wheels DIR" in poor
    assert "./roslings site" in poor
    assert "your own needs the internet" in classroom.start_page(bare, "http://10.0.0.5:8000")


def test_addresses_are_those_of_the_cards() -> None:
    """The room's come first, this computer's own last."""
    found = addresses(classroom.ALL_CARDS, 8000)
    assert found[-1] == "http://127.0.0.1:8000"
    ours = {address for card in cards() for address in card.inet4}
    assert {re.split("[/:]+", each)[1] for each in found} <= ours | {LOOPBACK}
    assert addresses("192.0.2.7", 80) == ["http://192.0.2.7:80"]


def test_what_cannot_be_handed_out_is_told(tmp_path: Path, room: Handout) -> None:
    """Before anything is made, with what to type."""
    with pytest.raises(CannotServe, match=r"\./roslings wheels"):
        classroom.made_in(tmp_path / "new", tmp_path / "empty", None)
    with pytest.raises(CannotServe, match=r"\./roslings site"):
        classroom.made_in(tmp_path / "new", None, tmp_path)
    assert not (tmp_path / "new").exists()
    with serving(room, LOOPBACK, 0) as first:
        port = int(first[0].rpartition(":")[2])
        with pytest.raises(CannotServe, match="--port"), serving(room, LOOPBACK, port):
            raise AssertionError("two servers have one port")


# --- the whole way -----------------------------------------------------------------------------


@pytest.mark.slow
def test_a_student_types_what_the_page_says(tmp_path: Path) -> None:
    """From the instructor's command to 100 points, with packages from nowhere else."""
    wheels = tmp_path / "wheels"
    own = [str(course.root() / "roslings"), "wheels", str(wheels), "ros", "colcon", "check"]
    filled = subprocess.run(own, capture_output=True, text=True, check=False)
    assert filled.returncode == 0, filled.stderr
    words = ["serve", "--wheels", str(wheels), "--host", LOOPBACK, "--port", "0"]
    served = subprocess.Popen(
        [str(course.root() / "roslings"), *words], stdout=subprocess.PIPE, text=True
    )
    try:
        assert served.stdout
        address = next(line.split()[-1] for line in served.stdout if "can be had at" in line)
        page = read(address)
        typed = unescape(page.partition("<pre>")[2].partition("</pre>")[0])
        home = tmp_path / "student"
        home.mkdir()
        student = {
            "PATH": "/usr/bin:/bin",
            "HOME": str(home),
            "PIP_CONFIG_FILE": os.devnull,
            "no_proxy": "*",
            "ROSLINGS_PYTHON": getattr(sys, "_base_executable", sys.executable),
        }
        done = subprocess.run(
            ["bash", "-e", "-c", typed],
            cwd=home,
            env=student,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        assert "100 of 100" in done.stdout
    finally:
        served.terminate()
        assert served.wait() == 0
