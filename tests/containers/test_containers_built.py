"""Our own Containerfile, built and used: the course's image, and the Dev Container's."""

from __future__ import annotations

import re
import shutil
import socket
import subprocess
import urllib.request
from dataclasses import replace
from pathlib import Path

import pytest
from images import GROUPS, Builder, dev_container

from roslings.course import root
from roslings_class.release import is_for_students
from skips import needs
from until_told import is_open, until_told

pytestmark = [
    pytest.mark.slow,
    pytest.mark.alone,
    pytest.mark.twice,
    needs("root", "buildah", "debootstrap", "Python 3.11"),
]
ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/lab\S*")
STUDENT = 1000


@pytest.fixture(scope="module")
def builder(tmp_path_factory: pytest.TempPathFactory) -> Builder:
    """With a Debian to build on, and what pip would fetch for its Python."""
    folder = tmp_path_factory.mktemp("images")
    words = [str(root() / "roslings"), "wheels", str(folder / "wheels"), *GROUPS]
    found = shutil.which("python3.11")  # Debian's own version
    fetched = subprocess.run(
        ["env", f"ROSLINGS_PYTHON={found}", *words], capture_output=True, text=True, check=False
    )
    assert fetched.returncode == 0, fetched.stderr
    made = Builder(folder, folder / "wheels")
    made.make_base()
    return made


def test_the_image_grades_and_opens_the_lesson(builder: Builder) -> None:
    """As a student, not as root; a full score; JupyterLab on the first day; and no answer."""
    image = builder.build("course")
    settings = builder.settings(image)
    assert settings["User"] == "student"
    assert "8888/tcp" in settings["ExposedPorts"]
    with builder.started(image) as container:
        assert container.run("id", "-u").stdout.strip() == str(STUDENT)
        there = container.run(
            "find", ".", "-path", "./.venv*", "-prune", "-o", "-type", "f", "-print"
        )
        names = [name.removeprefix("./") for name in there.stdout.splitlines()]
        assert [name for name in names if not is_for_students(name)] == []
        said = container.run(
            "grep", "--only-matching", "./roslings check .* --solution", "README.md"
        )
        first = said.stdout.splitlines()[0]
        graded = until_told(lambda: container.run(*first.split()), is_open)
        assert "100 of 100" in graded.stdout, graded.stdout + graded.stderr
        types = container.run("./roslings", "ready", "check", "actions")
        assert (types.returncode, types.stderr) == (0, ""), types.stderr
        port = str(free_port())
        opens = [port if word == "8888" else word for word in settings["Cmd"]]
        with subprocess.Popen(
            container.command(*opens), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        ) as server:
            try:
                address = first_address(server)
                assert "JupyterLab" in urllib.request.urlopen(address).read().decode()
                assert "/notebooks/01-install/lesson.ipynb" in urllib.request.urlopen(address).url
            finally:
                server.kill()  # the namespace ends with it, and all in it


def free_port() -> int:
    """A port that nobody listens on."""
    with socket.socket() as tried:
        tried.bind(("127.0.0.1", 0))
        port: int = tried.getsockname()[1]
        return port


def first_address(server: subprocess.Popen[str]) -> str:
    """The address with its key that the server tells a student."""
    said = []
    assert server.stdout is not None
    for line in server.stdout:
        said.append(line)
        if found := ADDRESS.search(line):
            return found.group()
    raise AssertionError("".join(said))


def test_the_dev_container_grades(builder: Builder, tmp_path: Path) -> None:
    """What VS Code would do: the machine, the folder from outside, then its own last command."""
    image = builder.build("machine")
    course = tmp_path / "roslings"
    left = shutil.ignore_patterns(".venv*", ".git", ".*_cache", "build", "__pycache__")
    shutil.copytree(root(), course, ignore=left)
    for path in (course, *course.rglob("*")):
        shutil.chown(path, STUDENT, STUDENT)
    with builder.started(image) as machine:
        container = replace(machine, folder="/workspaces/roslings", outside=course)
        created = container.run("sh", "-c", dev_container()["postCreateCommand"])
        assert created.returncode == 0, created.stdout + created.stderr
        assert "colcon" in created.stdout  # the doctor's words
        words = ("./roslings", "check", "topics", "--solution")
        graded = until_told(lambda: container.run(*words), is_open)
        assert "100 of 100" in graded.stdout, graded.stdout + graded.stderr
