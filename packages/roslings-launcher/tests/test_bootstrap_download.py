"""Downloads that break go on; what was fetched once is not fetched again."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from course_copy import CourseCopy
from package_index import PackageIndex
from tiny_wheels import make_wheel

from roslings_launcher.installing import at_once

BIG: dict[str, str | bytes] = {"check_x.py": "", "big_x.bin": b"\x07" * 3_000_000}


@pytest.fixture
def big(wheels: Path) -> None:
    """A package that is large enough to be cut."""
    make_wheel(wheels, "check-x", "1.0", BIG)


@pytest.mark.slow
@pytest.mark.usefixtures("big")
def test_a_cut_download_goes_on_within_one_run(online: CourseCopy, index: PackageIndex) -> None:
    """pip asks for the rest of the file, not for all of it again."""
    index.traffic.cuts["check_x-1.0-py3-none-any.whl"] = 1
    outcome = online.run("check")
    assert outcome.code == 0, outcome.err
    assert [first > 0 for _, first in index.fetched("check_x")] == [False, True]
    assert not (online.venv / "wheels").exists()


@pytest.mark.slow
@pytest.mark.usefixtures("big")
def test_the_next_try_goes_on(online: CourseCopy, index: PackageIndex) -> None:
    """The connection breaks for good; the next run fetches only what is missing."""
    fetches_one_by_one(online)
    index.traffic.cuts["check_x-1.0-py3-none-any.whl"] = 100
    broken = online.run("check", PIP_RESUME_RETRIES="0", HOME="")  # and pip keeps nothing
    assert broken.code == 2
    assert "run the same command again" in " ".join(broken.err.split())
    assert "Traceback" not in broken.err
    assert not online.venv.exists()
    (online.root / ".venv.wheels/cut_x-1.0-py3-none-any.whl").write_bytes(b"PK cut")
    index.traffic.cuts.clear()
    again = online.run("check", HOME="")
    assert again.code == 0, again.err
    assert [len(index.fetched(name)) for name in ("ros_x", "col_x")] == [1, 1]
    assert not (online.root / ".venv.wheels").exists()


def fetches_one_by_one(course: CourseCopy) -> None:
    """Each tiny package stands for many: what one pip fetched is kept when the next one breaks."""
    file = course.root / "packages/roslings-launcher/src/roslings_launcher/installing.py"
    changed = re.sub(r"^_AT_ONCE = \d+", "_AT_ONCE = 1", file.read_text(), flags=re.MULTILINE)
    assert "_AT_ONCE = 1\n" in changed.replace("  #", "\n")
    file.write_text(changed)


@pytest.mark.slow
def test_an_index_that_is_away_is_named(online: CourseCopy) -> None:
    """No network, or a registry that is down: one message, nothing left."""
    outcome = online.run("check", PIP_INDEX_URL="http://127.0.0.1:9/simple")
    assert outcome.code == 2
    assert "package index cannot be reached" in outcome.err
    assert "ROSLINGS_WHEELS" in outcome.err
    assert "Traceback" not in outcome.err
    assert not online.venv.exists()


@pytest.mark.slow
def test_a_new_group_that_does_not_come_leaves_the_old(
    ready: CourseCopy, index: PackageIndex
) -> None:
    """Offline, `graph` says so, and `check` still runs."""
    away = {"PIP_INDEX_URL": "http://127.0.0.1:9/simple", "PIP_RETRIES": "0"}
    assert ready.run("graph", ROSLINGS_WHEELS=None, **away).code == 2
    assert (ready.run("check").code, ready.run("check").err) == (0, "")


@pytest.mark.slow
def test_a_folder_of_wheels_sets_up_without_a_network(
    online: CourseCopy, index: PackageIndex, tmp_path: Path
) -> None:
    """`./roslings wheels DIR` on one machine, ROSLINGS_WHEELS=DIR on the next."""
    stick = tmp_path / "a stick"
    make_wheel(online.wheels, "other-x", "3.0")
    oldest = f"3.{online.run('doctor').seen['python'][1]}.1"
    with (online.root / "constraints.txt").open("a") as pins:
        pins.write(f"other-x==3.0 ; python_full_version < '{oldest}'  # check\n")
    filled = online.run("wheels", str(stick), "ros", "colcon", "check")
    assert filled.code == 0, filled.err
    assert f"ROSLINGS_WHEELS='{stick}'" in filled.err
    names = {wheel.name.split("-")[0] for wheel in stick.glob("*.whl")}
    assert names == {"pip", "setuptools", "ros_x", "col_x", "check_x", "other_x"}
    away = "http://127.0.0.1:9/simple"
    outcome = online.run("check", ROSLINGS_WHEELS=str(stick), PIP_INDEX_URL=away)
    assert outcome.code == 0, outcome.err


@pytest.mark.parametrize("words", [[], ["-x"], ["/dev/null/x"], ["here", "no-such-group"]])
def test_wheels_says_what_it_needs(standing: CourseCopy, words: list[str], tmp_path: Path) -> None:
    """Wrong words: nothing is fetched."""
    given = [str(tmp_path / "here") if word == "here" else word for word in words]
    outcome = standing.run("wheels", *given)
    assert outcome.code == 2
    assert "Next:" in outcome.err
    assert "Traceback" not in outcome.err


@pytest.mark.slow
def test_an_empty_folder_of_wheels_is_named(course: CourseCopy, tmp_path: Path) -> None:
    """The stick was not filled, or its name is misspelt."""
    outcome = course.run("check", ROSLINGS_WHEELS=str(tmp_path / "nowhere"))
    assert outcome.code == 2
    assert "without wheels" in outcome.err
    assert "./roslings wheels" in outcome.err


def test_two_versions_of_a_package_are_never_fetched_together() -> None:
    """A folder of wheels is for every release of a Python, and pip takes two for a conflict."""
    packages = ["a==1", "b==1", "b==2", "c==1", "d==1", "b==3"]
    rounds = list(at_once(packages, 3))
    assert sorted(each for some in rounds for each in some) == sorted(packages)
    assert all(len({each[0] for each in some}) == len(some) <= 3 for some in rounds)
    assert list(at_once([], 3)) == []
