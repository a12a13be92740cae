"""A bare Python, as Ubuntu and Debian give it: where its first pip is from."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from course_copy import CourseCopy
from package_index import PackageIndex
from pythons_here import BASE

from roslings_launcher import seeds
from roslings_launcher.errors import LauncherTrouble
from skips import skip_without

pytestmark = pytest.mark.slow


@pytest.fixture
def bare(bare_python: Callable[..., str]) -> str:
    """A Python without pip and ensurepip."""
    return bare_python("ensurepip", "pip")


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """Nothing on PATH and nothing configured."""
    for name in list(os.environ):
        if name.startswith(("PIP_", "ROSLINGS_", "XDG_", "PYENV")):
            monkeypatch.delenv(name)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("PIP_CONFIG_FILE", os.devnull)
    monkeypatch.setattr(seeds, "SYSTEM_FOLDERS", ())
    yield


def test_a_folder_of_wheels_is_enough(course: CourseCopy, bare: str) -> None:
    """ROSLINGS_WHEELS holds a pip: a whole set-up with nothing else."""
    outcome = course.run("check", ROSLINGS_PYTHON=bare)
    assert outcome.code == 0, outcome.err
    assert outcome.seen["prefix"] == str(course.venv)


def test_the_index_of_pips_configuration_is_enough(
    online: CourseCopy, index: PackageIndex, bare: str, tmp_path: Path
) -> None:
    """Only an address is known, and there is no other Python: pip's wheel is fetched from it."""
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("dirname", "readlink", "cmp"):
        (tools / name).symlink_to(f"/usr/bin/{name}")
    outcome = online.run("check", ROSLINGS_PYTHON=bare, PATH=str(tools))
    assert outcome.code == 0, outcome.err


@pytest.mark.usefixtures("alone")
def test_pip_comes_from_the_configured_index(
    bare: str, index: PackageIndex, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By the variable, and by the configuration file."""
    monkeypatch.setenv("PIP_INDEX_URL", index.address)
    assert seeds.find_seed(bare, tmp_path / "a").parent.parent == tmp_path / "a"
    monkeypatch.delenv("PIP_INDEX_URL")
    (tmp_path / "pip.conf").write_text(f"[global]\nindex-url = {index.address}\n")
    monkeypatch.setenv("PIP_CONFIG_FILE", str(tmp_path / "pip.conf"))
    assert seeds.find_seed(bare, tmp_path / "b").parent.parent == tmp_path / "b"


@pytest.mark.usefixtures("alone")
def test_a_wheel_that_is_not_as_promised_is_refused(
    bare: str, index: PackageIndex, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The link carries a digest; a cut file has another."""
    name = next(index.folder.glob("pip-*.whl")).name
    index.traffic.cuts[name] = 100
    monkeypatch.setenv("PIP_INDEX_URL", index.address)
    with pytest.raises(LauncherTrouble):
        seeds.find_seed(bare, tmp_path / "a")


@pytest.mark.usefixtures("alone")
def test_another_python_lends_its_pip(
    bare: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Any Python on PATH will do, of any version."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/python3.99").symlink_to(BASE)
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    seed = seeds.find_seed(bare, tmp_path / "scratch")
    assert seed in set(seeds.from_python(str(BASE)))


@pytest.mark.usefixtures("alone")
def test_without_any_pip_the_next_step_is_said(bare: str, tmp_path: Path) -> None:
    """Both with sudo and without."""
    with pytest.raises(LauncherTrouble) as trouble:
        seeds.find_seed(bare, tmp_path / "scratch")
    assert "apt install python3-venv" in trouble.value.steps[0]
    assert "ROSLINGS_WHEELS" in trouble.value.steps[1]


@pytest.mark.usefixtures("alone")
def test_apt_gives_pip_without_root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """`apt-get download` needs no sudo, and its pip fits the Python that apt installed."""
    monkeypatch.setenv("PATH", "/usr/bin:/bin")
    skip_without("apt")
    found = list(seeds.from_apt(tmp_path / "scratch"))
    if not found:
        skip_without("pip from apt")
    assert seeds.answers("/usr/bin/python3", found[0])
