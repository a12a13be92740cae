"""The files for containers agree with the course and with each other."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from images import CONTAINERFILE, DEVCONTAINER, dev_container

from roslings.course import root
from roslings_class.release import is_for_students, rewrite_texts
from sources import python_path

IGNORE = root() / ".dockerignore"
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


# --- what is in the image: what `release` leaves in ---------------------------------------------


def pattern(line: str) -> re.Pattern[str]:
    """A line of the ignore file as docker reads it: it holds for all that lies below, too."""
    parts = re.split(r"(\*\*/|\*\*|\*|\?)", line.strip("/"))
    signs = {"**/": "(?:.*/)?", "**": ".*", "*": "[^/]*", "?": "[^/]"}
    return re.compile("".join(signs.get(part, re.escape(part)) for part in parts) + "(?:/.*)?")


def stays_out(name: str) -> bool:
    """Whether docker leaves a file of the course outside; the last line that fits counts."""
    out = False
    for line in IGNORE.read_text("utf-8").splitlines():
        text = line.strip()
        if text and not text.startswith("#") and pattern(text.lstrip("!")).fullmatch(name):
            out = not text.startswith("!")
    return out


def copied(name: str) -> bool:
    """Whether the Containerfile copies it."""
    sources = [
        source for line in lines() if line.startswith("COPY") for source in line.split()[2:-1]
    ]
    return any(name == source or name.startswith(f"{source}/") for source in sources)


def tracked() -> list[str]:
    """All files that git keeps here."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=root(), capture_output=True, text=True, check=True
    )
    return [name for name in listed.stdout.split("\0") if name]


def in_new_rooms(name: str) -> str:
    """The same file in a lab, a day, a grader and a drill that do not exist yet."""
    name = re.sub(r"^labs/[^/]+", "labs/brand-new", name)
    name = re.sub(r"^days/\d\d-[^/]+", "days/77-new", name)
    name = re.sub(r"/drills/[^/]+", "/drills/99_new", name)
    return re.sub(r"^graders/(hidden|grade)_\w+", r"graders/\1_brand_new", name)


NOT_THERE_YET = (
    "graders/hidden_topics.py",
    "labs/topics/solution/a/b.cpp",
    "labs/topics/mutants/a.yaml",
    "days/02-nodes/drills/07_a/solution.xml",
    "days/02-nodes/drills/07_a/solution",
    "days/77-new/drills/solution.py",
)


def test_the_image_holds_what_release_leaves_in() -> None:
    """No answer, no mutant, no hidden check, also of labs to come; and nothing else is missing."""
    kept = [name for name in tracked() if copied(name)]
    for name in {*kept, *map(in_new_rooms, kept), *NOT_THERE_YET}:
        assert stays_out(name) != is_for_students(name), name
    assert [name for name in kept if "/solution" in name and not stays_out(name)]  # the example's


def test_its_texts_are_those_that_release_writes(tmp_path: Path) -> None:
    """The edition's own program is not in the image: what the Containerfile does is the same."""
    (command,) = re.findall(r"find README\.md .*? \+", " ".join(lines()))
    for way in ("image", "release"):
        for name in filter(is_for_students, filter(copied, tracked())):
            (tmp_path / way / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(root() / name, tmp_path / way / name)
    subprocess.run(["sh", "-c", command], cwd=tmp_path / "image", check=True)
    rewrite_texts(tmp_path / "release")
    done = subprocess.run(
        ["diff", "-r", "image", "release"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == ""
    as_it_is = (root() / "README.md").read_text("utf-8")
    assert (tmp_path / "image/README.md").read_text("utf-8") != as_it_is


MADE = (
    ".venv/bin/python",
    ".venv-apt/x",
    ".git/config",
    "packages/roslings/src/roslings/__pycache__/a.pyc",
    "build/site/index.html",
    "topics.zip",
    "labs/topics/interfaces/__pycache__/a.pyc",
    ".mypy_cache/x",
    "tests/labs/test_labs.py",
    "days/02-nodes/.ipynb_checkpoints/a",
)


@pytest.mark.parametrize("name", MADE)
def test_what_a_clone_makes_stays_out(name: str) -> None:
    """Environments, caches, and all of git's."""
    assert stays_out(name)


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


def test_binder_gets_the_kernel(tmp_path: Path) -> None:
    """The last line of its build writes it, into the course's environment."""
    python = tmp_path / ".venv/bin/python"
    python.parent.mkdir(parents=True)
    for file, text in (
        (tmp_path / "roslings", "#!/bin/sh\n"),
        (python, f"#!/bin/sh\nPYTHONPATH='{python_path()}' exec '{sys.executable}' \"$@\"\n"),
    ):
        file.write_text(text)
        file.chmod(0o755)
    seen = {**os.environ, "HOME": str(tmp_path)}
    done = subprocess.run(
        [BINDER / "postBuild"], cwd=tmp_path, env=seen, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_binders_start_shows_the_kernel_and_runs_the_rest(tmp_path: Path) -> None:
    """JupyterLab comes from Binder; the kernel from the course's environment."""
    for name in ("postBuild", "start"):
        assert os.access(BINDER / name, os.X_OK)
        subprocess.run(["bash", "-n", BINDER / name], check=True)
    (tmp_path / "setup.bash").write_text("export SOURCED=yes\n")
    done = subprocess.run(
        [BINDER / "start", "sh", "-c", "echo $JUPYTER_PATH $SOURCED"],
        cwd=tmp_path,
        env={"PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == [f"{tmp_path}/.venv/share/jupyter", "yes"]
