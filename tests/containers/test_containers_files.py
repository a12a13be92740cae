"""The files for containers agree with the course and with each other."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import pytest
from images import CONTAINERFILE, DEVCONTAINER, dev_container

from roslings.course import root

NOT_IN_THE_IMAGE = {"tests", "site", "setup.bash", "build", "example-course"}
BINDER = root() / ".binder"


def lines() -> list[str]:
    """The lines of the Containerfile, joined where they go on."""
    text = (root() / CONTAINERFILE).read_text("utf-8").replace("\\\n", " ")
    return [line for line in text.splitlines() if line and not line.startswith("#")]


def test_every_folder_of_the_course_is_copied() -> None:
    """All that an edition's script, engine and lessons read; each exists."""
    copied = [line.split()[2:-1] for line in lines() if line.startswith("COPY")]
    names = {name for each in copied for name in each}
    listed = subprocess.run(
        ["git", "ls-files"], cwd=root(), capture_output=True, text=True, check=True
    ).stdout
    folders = {line.partition("/")[0] for line in listed.splitlines() if "/" in line}
    wanted = {name for name in folders if not name.startswith(".")} - NOT_IN_THE_IMAGE
    assert names >= wanted | {"roslings", "constraints.txt", "pyproject.toml"}
    assert [name for name in names if not (root() / name).exists()] == []


def test_nothing_in_it_runs_as_root() -> None:
    """From the first command of the course on."""
    users = [number for number, line in enumerate(lines()) if line == "USER student"]
    first = next(number for number, line in enumerate(lines()) if "./roslings" in line)
    assert users
    assert users[0] < first
    assert not [line for line in lines()[users[0] + 1 :] if line.startswith("USER")]


def test_both_dev_containers_differ_in_their_base_alone() -> None:
    """And end with the doctor; their files are where they say."""
    usual, jazzy = dev_container("."), dev_container("jazzy")
    for said, folder in ((usual, "."), (jazzy, "jazzy")):
        at = root() / DEVCONTAINER / folder
        build = said.pop("build")
        assert (at / build["dockerfile"]).resolve() == root() / CONTAINERFILE
        assert (at / build["context"]).resolve() == root().resolve()
        assert build.get("args", {}) == ({"BASE": "ros:jazzy"} if folder == "jazzy" else {})
        assert any(line.endswith(f" AS {build['target']}") for line in lines())
        assert said.pop("name")
    assert usual == jazzy
    assert usual["postCreateCommand"].endswith("&& ./roslings doctor'")
    assert f"useradd --create-home --uid 1000 --shell /bin/bash {usual['remoteUser']}" in " ".join(
        " ".join(lines()).split()
    )


@pytest.mark.parametrize("page", ["README.md", "site/pages/reference/installing.md"])
def test_the_pages_build_and_run_what_is_there(page: str) -> None:
    """The words of the Containerfile's own head, and a port and a volume that it has."""
    text = (root() / page).read_text("utf-8")
    head = (root() / CONTAINERFILE).read_text("utf-8").partition("ARG")[0]
    for command in (r"docker build -t roslings[^`\n]*\.", r"docker run -it[^`\n]* roslings"):
        said = re.search(command, text)
        assert said
        assert said.group() in head
    assert "VOLUME /work" in lines()
    assert "EXPOSE 8888" in lines()


def test_binders_start_shows_the_kernel_and_runs_the_rest(tmp_path: Path) -> None:
    """JupyterLab comes from Binder; the kernel from the course's environment."""
    for name in ("postBuild", "start"):
        assert os.access(BINDER / name, os.X_OK)
        subprocess.run(["bash", "-n", BINDER / name], check=True)
    (tmp_path / "setup.bash").write_text("export SOURCED=yes\n")
    done = subprocess.run(
        [BINDER / "start", "sh", "-c", "echo $JUPYTER_PATH $SOURCED"],
        cwd=tmp_path, env={"PATH": "/usr/bin:/bin"}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout.split() == [f"{tmp_path}/.venv/share/jupyter", "yes"]
