"""The wheel: built here, installed where nothing is, used in an empty folder."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from email.message import Message
from email.parser import Parser
from pathlib import Path
from typing import Any

import pytest

from roslings import __version__, course
from roslings.course import all_labs
from roslings_class.release import is_for_students, leaks
from roslings_class.wheel import FOR_INSTRUCTORS, build_sdist
from roslings_launcher import constraints, groups
from roslings_launcher.installed import ARCHIVE
from roslings_launcher.place import CoursePlace
from skips import needs
from until_told import is_open, until_told

pytestmark = pytest.mark.slow

CLONE = CoursePlace(course.root())
NAME = f"roslings-{__version__}-py3-none-any.whl"
RUNS_A_CHECK = "ros,colcon,check"


@pytest.fixture(scope="session")
def wheel(shared_folder: Path) -> Path:
    """The wheel of this clone, as `pip wheel packages/roslings` makes it; once in a run."""
    from once import once

    return Path(once(shared_folder / "wheel.txt", lambda: str(_built(shared_folder / "wheel"))))


def _built(folder: Path) -> Path:
    words = [
        "wheel",
        "--no-deps",
        "--no-build-isolation",
        "--no-index",
        "-w",
        str(folder),
        "packages/roslings",
    ]
    done = run([sys.executable, "-m", "pip", *words], cwd=course.root())
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / NAME


def run(words: list[str], cwd: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run a program with pip's settings of this machine, and these variables besides."""
    pip = {name: text for name, text in os.environ.items() if name.startswith(("PIP_", "SSL_"))}
    own = {"PATH": "/usr/bin:/bin", "HOME": str(cwd), **pip, **variables}
    return subprocess.run(
        words,
        cwd=cwd,
        env=own,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )


def installed(folder: Path, wheel: str, *options: str, **variables: str) -> Path:
    """The command `roslings` of a fresh environment that the wheel was installed into."""
    new = folder / "environment"
    run([sys.executable, "-m", "venv", "--without-pip", str(new)], folder)
    words = ["--python", str(new), "install", "--no-compile", *options, wheel]
    done = run([sys.executable, "-m", "pip", *words], folder, **variables)
    assert done.returncode == 0, done.stdout + done.stderr
    return new / "bin" / "roslings"


@pytest.fixture(scope="module")
def command(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """`pip install roslings`, and nothing else."""
    return installed(tmp_path_factory.mktemp("pip"), str(wheel), "--no-index")


@pytest.fixture
def empty(tmp_path: Path) -> Path:
    """An empty folder."""
    folder = tmp_path / "empty"
    folder.mkdir()
    return folder


# --- what is in it -----------------------------------------------------------------------------


def as_it_is() -> dict[str, Any]:
    """Nothing in our own archive is left out; Debian 12's Python knows no filters, and does so."""
    return {"filter": "fully_trusted"} if hasattr(tarfile, "fully_trusted_filter") else {}


def test_it_holds_the_students_edition_and_no_answer(wheel: Path, tmp_path: Path) -> None:
    """Every file that students get, as a package or in the archive; no other, no answer."""
    with zipfile.ZipFile(wheel) as packed:
        packed.extractall(tmp_path)
    with tarfile.open(tmp_path / "roslings" / ARCHIVE) as archive:
        archive.extractall(tmp_path / "course", **as_it_is())
    whole = tmp_path / "course"
    for package in sorted(whole.glob("packages/*/src/*")):
        for file in package.rglob("*.py"):
            inside = tmp_path / package.name / file.relative_to(package)
            assert inside.read_bytes() == file.read_bytes(), inside
    names = {path.relative_to(whole).as_posix() for path in whole.rglob("*") if path.is_file()}
    assert names == {name for name in tracked() if is_for_students(name)}
    assert list(leaks(tmp_path, all_labs())) == []


def tracked() -> list[str]:
    """The files of this clone."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=course.root(), capture_output=True, text=True, check=True
    )
    return [name for name in listed.stdout.split("\0") if (course.root() / name).is_file()]


def told(wheel: Path) -> Message:
    """What the wheel says of itself."""
    with zipfile.ZipFile(wheel) as packed:
        return Parser().parsestr(packed.read(f"roslings-{__version__}.dist-info/METADATA").decode())


def test_each_group_is_an_extra_with_its_pins(wheel: Path) -> None:
    """No more and no less, as the wheel says. All but the types have something to install."""
    said = told(wheel)
    provided = said.get_all("Provides-Extra") or []
    assert provided == [*groups.names(CLONE.pyproject), "class"]
    needs: dict[str, set[str]] = {name: set() for name in provided}
    for need in said.get_all("Requires-Dist") or []:
        pin, _, name = need.removesuffix('"').rpartition('extra == "')
        needs.setdefault(name, set()).add(pin.partition(";")[0].strip())
    pins = constraints.read(CLONE.constraints)
    ours = {f"{name}=={__version__}" for name in FOR_INSTRUCTORS}
    assert needs == {"class": ours} | {
        name: {pin.requirement.partition(";")[0].strip() for pin in pins if name in pin.groups}
        for name in groups.names(CLONE.pyproject)
    }
    assert [name for name, pins_of in needs.items() if not pins_of] == ["interfaces"]


def test_its_page_says_who_made_it_and_leads_nowhere(wheel: Path) -> None:
    """Nobody told where students read it: no link, no address; the licences are in it."""
    said = told(wheel)
    assert said["Author"] == "The roslings authors"
    assert "Intended Audience :: Education" in (said.get_all("Classifier") or [])
    assert said.get_all("Project-URL") is None
    page = str(said.get_payload())
    assert "roslings new" in page
    assert "](" not in page
    assert set(said.get_all("License-File") or []) == {"LICENSE", "LICENSE-lessons.md"}


def test_it_fits_every_computer(wheel: Path) -> None:
    """Beside a ROS from apt it works on ARM: no platform stands in its tag."""
    with zipfile.ZipFile(wheel) as packed:
        tags = packed.read(f"roslings-{__version__}.dist-info/WHEEL").decode()
        assert [line for line in tags.splitlines() if line.startswith("Tag:")] == [
            "Tag: py3-none-any"
        ]
        assert [name for name in packed.namelist() if name.endswith((".so", ".pyd"))] == []


def test_there_is_no_sdist(tmp_path: Path) -> None:
    """It would be the clone, solutions and all."""
    with pytest.raises(NotImplementedError, match="solutions"):
        build_sdist(str(tmp_path))
    assert list(tmp_path.iterdir()) == []


# --- how it is used ----------------------------------------------------------------------------


def test_in_an_empty_folder_it_says_how_to_begin(command: Path, empty: Path) -> None:
    """Without data, without dependencies; and nothing appears there by itself."""
    alone = run([str(command)], empty)
    assert (alone.returncode, alone.stderr) == (0, "")
    assert "Next: roslings new" in alone.stdout
    looked = run([str(command), "doctor", "--only", "system", "python"], empty)
    assert looked.returncode == 0, looked.stdout + looked.stderr
    assert "computer alone" in looked.stderr
    refused = run([str(command), "check", "topics"], empty)
    assert (refused.returncode, refused.stdout) == (2, "")
    assert "Next: Make one: roslings new" in refused.stderr
    module = run([str(command.parent / "python"), "-m", "roslings", "--version"], empty)
    assert module.stdout == f"roslings {__version__}\n"
    assert list(empty.iterdir()) == []


def test_new_makes_a_course_that_works_as_a_clone_does(command: Path, empty: Path) -> None:
    """The command then runs that course's own script, from beside it and from within."""
    made = run([str(command), "new"], empty)
    assert made.returncode == 0, made.stderr
    assert "cd roslings-course" in made.stdout
    assert re.search(r"This machine:\n  has    Linux on ", made.stdout)
    folder = empty / "roslings-course"
    assert not [path for path in empty.iterdir() if path != folder]
    for inside in (empty, folder, folder / "labs" / "topics"):
        listed = run([str(command), "doctor", "--list"], inside, ROSLINGS_PYTHON="")
        assert listed.stdout == run([str(folder / "roslings"), "doctor", "--list"], empty).stdout
    assert run([str(command), "no-such-word"], folder).returncode == 2


def test_a_class_gets_it_as_the_page_says(wheel: Path, empty: Path) -> None:
    """One file, no pip, no environment: what students type, up to their first grading."""
    page = (course.root() / "site/pages/teachers/handing-out.md").read_text("utf-8")
    typed = page.partition("python3 -m zipfile")[1:]
    *lines, grading = "".join(typed).partition("\n```")[0].splitlines()
    assert grading == "./roslings check example --solution"
    shutil.copy(wheel, empty)
    doctor = "PYTHONPATH=../wheel python3 -m roslings doctor --only python"
    python = f"{Path(sys.executable).parent}:/usr/bin:/bin"
    done = run(
        ["bash", "-ec", "\n".join([*lines, "./roslings --version", doctor])], empty, PATH=python
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "This machine:\n  has    Linux on" in done.stdout
    assert f"roslings {__version__}" in done.stdout


def test_new_overwrites_nothing(command: Path, empty: Path) -> None:
    """Neither a course in which somebody has worked, nor any other folder."""
    (empty / "mine").mkdir()
    (empty / "mine" / "notes.txt").write_text("mine")
    again = run([str(command), "new", "mine"], empty)
    assert again.returncode == 2
    assert "nothing is ever" in again.stderr
    spaced = run([str(command), "new", "a space"], empty)
    assert spaced.returncode == 2
    assert "a space" in spaced.stderr
    assert [path.relative_to(empty).as_posix() for path in empty.rglob("*")] == [
        "mine",
        "mine/notes.txt",
    ]


def test_without_the_extras_this_environment_is_told(command: Path, empty: Path) -> None:
    """ROSLINGS_COURSE asks for the environment that the wheel is in."""
    run([str(command), "new"], empty)
    where = {"ROSLINGS_COURSE": str(empty / "roslings-course")}
    refused = run([str(command), "check", "topics"], empty, **where)
    assert refused.returncode == 2
    assert f"pip install 'roslings[{RUNS_A_CHECK}]==" in refused.stderr


def kept_downloads() -> dict[str, str]:
    """What pip fetched before is not fetched again, although HOME is another one."""
    words = [sys.executable, "-m", "pip", "cache", "dir"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return {"PIP_CACHE_DIR": done.stdout.strip()} if done.returncode == 0 else {}


@pytest.mark.slow
def test_from_nothing_to_100(command: Path, empty: Path) -> None:
    """`pip install roslings`, `roslings new`, `roslings check`: the course makes the rest."""
    run([str(command), "new"], empty)
    solution = str(course.lab("topics").solution)
    words = [str(command), "check", "topics", solution]
    graded = until_told(lambda: run(words, empty, **kept_downloads()), is_open)
    assert graded.returncode == 0, graded.stdout + graded.stderr
    assert "100 of 100" in graded.stdout


def for_a_grading_system() -> list[str]:
    """The lines that the page says, one after the other."""
    page = (course.root() / "site/pages/reference/installing.md").read_text("utf-8")
    block = page.partition("For a grading system")[2].partition("```bash\n")[2].partition("```")[0]
    return block.splitlines()


def test_an_engine_that_came_by_pip_finds_the_example(
    wheel: Path, empty: Path, tmp_path: Path
) -> None:
    """All that the page says for a grading system, but that pip's packages are those from here."""
    words = ["install", "--no-deps", "--no-index", "--quiet", "--target", str(tmp_path / "site")]
    run([sys.executable, "-m", "pip", *words, str(wheel)], tmp_path)
    program = f"{sys.executable} -P -m roslings" if sys.version_info >= (3, 11) else sys.executable
    here = {"PYTHONPATH": str(tmp_path / "site"), **libraries()}
    for line in for_a_grading_system()[1:]:
        typed = re.sub(r"(?<!\S)roslings(?= )", program, line)
        done = run(["bash", "-c", typed], empty, **here)
        assert done.returncode == 0, done.stdout + done.stderr
    assert "100 of 100" in done.stdout
    made = run(["bash", "-c", f"{program} new-lab lamp"], empty, **here, ROSLINGS_COURSE="course")
    assert made.returncode == 0, made.stderr
    assert (empty / "course/labs/lamp/card.yaml").is_file()
    assert not (empty / "course/.venv").exists()


def libraries() -> dict[str, str]:
    """What a process of this environment has of it."""
    names = ("LD_LIBRARY_PATH", "_ROS_WHEELS_BOOTSTRAP_COMPLETE", "ROSLINGS_SOAK_S")
    return {name: os.environ[name] for name in names if name in os.environ}


@pytest.mark.slow
@pytest.mark.twice
def test_the_extras_alone_grade_too(wheel: Path, empty: Path, tmp_path: Path) -> None:
    """One environment, made by pip: for a container, or a grading system. As the page says it."""
    pip, *lines = for_a_grading_system()
    assert f"roslings[{RUNS_A_CHECK}]" in pip
    command = installed(tmp_path, f"{wheel}[{RUNS_A_CHECK}]", **kept_downloads())
    for line in lines:
        done = run(["bash", "-c", line], empty, PATH=f"{command.parent}:/usr/bin:/bin")
        assert done.returncode == 0, done.stdout + done.stderr
    assert "100 of 100" in done.stdout
    assert not (empty / "course" / ".venv").exists()


@needs("uvx")
def test_uvx_makes_the_course_without_an_installation(wheel: Path, tmp_path: Path) -> None:
    """What the page on installing says of it."""
    uvx = shutil.which("uvx") or "uvx"
    cache = {"UV_CACHE_DIR": str(tmp_path / "cache"), "UV_PYTHON": sys.executable}
    made = run([uvx, "--offline", "--from", str(wheel), "roslings", "new"], tmp_path, **cache)
    assert made.returncode == 0, made.stderr
    assert (tmp_path / "roslings-course" / "roslings").is_file()
