"""A version changes with all that a verdict comes from, and with nothing else."""

from __future__ import annotations

import dataclasses
import shutil
from pathlib import Path

import pytest

from roslings.course import Lab, lab
from roslings_class import version
from roslings_class.dask_pool import FIT, fitness
from roslings_class.version import ENGINE, engine_in, version_of


@pytest.fixture
def copied(tmp_path: Path) -> Lab:
    """The lab topics, in a folder of its own."""
    one = lab("topics")
    folder = shutil.copytree(one.folder, tmp_path / "labs/topics")
    (tmp_path / "graders").mkdir()
    grader = Path(shutil.copy(one.grader, tmp_path / "graders"))
    return dataclasses.replace(one, folder=folder, grader=grader)


@pytest.fixture
def engine(tmp_path: Path) -> Path:
    """Another engine, of two files."""
    folder = tmp_path / "engine"
    (folder / "judge").mkdir(parents=True)
    (folder / "judge" / "rates.py").write_text("LEAST = 3\n")
    (folder / "cli.py").write_text("")
    return folder


@pytest.mark.parametrize("file", ["card.yaml", "hints.yaml", "../../graders/grade_topics.py"])
def test_what_a_lab_is_judged_by_counts(file: str, copied: Lab) -> None:
    """One byte more, another version."""
    before = version_of(copied)
    with (copied.folder / file).open("a") as end:
        end.write("\n")
    assert version_of(copied) != before


@pytest.mark.parametrize("file", ["interfaces/arm/msg/Bend.msg", "firmware/arm/arm.ino"])
def test_what_a_lab_brings_counts(file: str, copied: Lab) -> None:
    """Its message types and its sketch: there or not, and each byte of them."""
    versions = {version_of(copied)}
    (copied.folder / file).parent.mkdir(parents=True)
    for text in ("float64 angle\n", "float32 angle\n"):
        (copied.folder / file).write_text(text)
        versions.add(version_of(copied))
    assert len(versions) == 3


def test_what_is_only_read_by_people_does_not(copied: Lab) -> None:
    """The task can be made clearer without grading anew."""
    before = version_of(copied)
    copied.task.write_text("Do it.")
    assert version_of(copied) == before


def test_each_file_of_the_engine_counts(engine: Path) -> None:
    """Its content and its name, in whichever room; not what Python makes of it."""
    versions = [engine_in(engine)]
    (engine / "judge" / "__pycache__").mkdir()
    (engine / "judge" / "__pycache__" / "rates.pyc").write_bytes(b"0")
    assert engine_in(engine) == versions[0]
    (engine / "judge" / "rates.py").write_text("LEAST = 4\n")
    versions.append(engine_in(engine))
    (engine / "judge" / "rates.py").rename(engine / "judge" / "rate.py")
    versions.append(engine_in(engine))
    assert len(set(versions)) == 3
    assert engine_in(*ENGINE) == version.engine_version()


@pytest.mark.parametrize("package", ENGINE, ids=lambda folder: folder.name)
def test_each_package_that_measures_or_judges_counts(package: Path, tmp_path: Path) -> None:
    """One byte more in any of them, another version."""
    shutil.copytree(package, tmp_path / package.name, ignore=shutil.ignore_patterns("__pycache__"))
    copies = [tmp_path / each.name if each == package else each for each in ENGINE]
    assert engine_in(*copies) == version.engine_version()
    with (tmp_path / package.name / "__init__.py").open("a") as end:
        end.write("\n")
    assert engine_in(*copies) != version.engine_version()


@pytest.mark.parametrize(
    "file", ["shared.py", "topics/near.py", "topics/near.xml", "grade_services.py"]
)
def test_of_the_graders_its_own_count_and_what_several_share(file: str, copied: Lab) -> None:
    """No other lab's."""
    graders = copied.grader.parent
    before = version_of(copied)
    (graders / file).parent.mkdir(exist_ok=True)
    (graders / file).write_text("MOST = 3\n")
    assert (version_of(copied) != before) == (file != "grade_services.py")


def test_another_engine_does_not_grade(engine: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A worker whose clone has another engine says so, and grades nothing."""
    wanted = version_of(lab("topics"))
    assert fitness("topics", wanted, None, trust=True) == FIT
    monkeypatch.setattr(version, "engine_version", lambda: engine_in(engine))
    assert "another version" in fitness("topics", wanted, None, trust=True)
