"""Images built by buildah where no registry can be reached: the base comes from debootstrap."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from roslings.course import root

DEVCONTAINER = ".devcontainer"
CONTAINERFILE = f"{DEVCONTAINER}/Containerfile"
SUITE = "bookworm"
"""Debian 12, as the Containerfile's own base; its Python is 3.11."""
MIRROR = "http://deb.debian.org/debian"
BASE = "localhost/base"
WHEELS = "/wheels"
GROUPS = (
    "ros",
    "colcon",
    "check",
    "ros2",
    "graph",
    "vision",
    "notebook",
    "lab",
    "desk",
    "generators",
)


def dev_container(name: str = "") -> Any:
    """What a Dev Container says of itself."""
    return json.loads((root() / DEVCONTAINER / name / "devcontainer.json").read_text("utf-8"))


@dataclass(frozen=True)
class Builder:
    """buildah with a store of its own in `folder`, and wheels, so that pip needs no network."""

    folder: Path
    wheels: Path

    def command(self, *words: str) -> list[str]:
        """buildah's command line; what it starts ends with it."""
        store = ["--root", str(self.folder / "store"), "--runroot", str(self.folder / "run")]
        ends = ["unshare", "--pid", "--fork", "--kill-child", "--mount-proc"]
        return [*ends, "buildah", *store, "--storage-driver", "vfs", *words]

    def run(self, *words: str) -> str:
        """What buildah says. Fails where it fails."""
        done = subprocess.run(self.command(*words), capture_output=True, text=True, check=False)
        assert done.returncode == 0, (done.stdout + done.stderr)[-4000:]
        return done.stdout.strip()

    def make_base(self) -> None:
        """A Debian, as small as debootstrap makes it."""
        system = self.folder / "base"
        words = ["debootstrap", "--variant=minbase", SUITE, str(system), MIRROR]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        assert done.returncode == 0, (done.stdout + done.stderr)[-4000:]
        scratch = self.run("from", "scratch")
        self.run("add", scratch, str(system), "/")
        self.run("commit", "--rm", scratch, BASE)
        shutil.rmtree(system)

    def build(self, target: str) -> str:
        """The image of one stage of our Containerfile; its name."""
        arguments = ("--build-arg", f"BASE={BASE}", "--build-arg", f"ROSLINGS_WHEELS={WHEELS}")
        self.run(
            "build",
            "--isolation",
            "chroot",
            "--network",
            "host",
            "--pull-never",
            *arguments,
            "--volume",
            f"{self.wheels}:{WHEELS}:ro",
            "--target",
            target,
            "--tag",
            f"localhost/{target}",
            "--file",
            str(root() / CONTAINERFILE),
            str(root()),
        )
        return f"localhost/{target}"

    def settings(self, image: str) -> dict[str, Any]:
        """What the image says of itself: Cmd, Entrypoint, User, ..."""
        found: dict[str, Any] = json.loads(self.run("inspect", "--type", "image", image))
        config: dict[str, Any] = found["OCIv1"]["config"]
        return config

    @contextmanager
    def started(self, image: str) -> Iterator[Container]:
        """A container of the image, gone with the block."""
        name = self.run("from", "--pull-never", image)
        try:
            yield Container(self, name, tuple(self.settings(image)["Entrypoint"]))
        finally:
            self.run("rm", name)


@dataclass(frozen=True)
class Container:
    """A container that runs commands, one after another."""

    builder: Builder
    name: str
    entrypoint: tuple[str, ...]
    folder: str = ""
    """Where commands run; the image's own folder where empty."""
    outside: Path | None = None
    """What is mounted there."""

    def command(self, *words: str) -> list[str]:
        """How to run a command in it as `docker run` would: through its entry point."""
        mounts = {self.builder.wheels: f"{WHEELS}:ro"}
        mounts |= {self.outside: self.folder} if self.outside else {}
        volumes = [f"--volume={outside}:{inside}" for outside, inside in mounts.items()]
        where = ["--workingdir", self.folder] if self.folder else []
        line = ["--", *self.entrypoint, *words]
        return self.builder.command(
            "run",
            "--isolation",
            "chroot",
            "--network",
            "host",
            "--env",
            f"ROSLINGS_WHEELS={WHEELS}",
            *volumes,
            *where,
            self.name,
            *line,
        )

    def run(self, *words: str) -> subprocess.CompletedProcess[str]:
        """Run a command to its end."""
        return subprocess.run(
            self.command(*words),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
        )
