"""The rogues' gallery: strangers' packages that attack, each beside an honest one.

Of each: it is contained, its verdict is true, its neighbour has the full score, and nothing of it
is left. A rogue says what it reached; witnesses outside say whether that is so.

    ./roslings test tests/rogues                                 a few that do no harm
    ./roslings test tests/rogues/test_rogues.py -m slow          all of them
    ./roslings test tests/rogues -m slow -k "root and fork_bomb" one of them

`ROSLINGS_GALLERY=FILE` keeps what was seen of each: verdict, words, what was held off.
"""

from __future__ import annotations

import ast
import fcntl
import functools
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from gallery import Entry, Gallery, hang, keep, untrue
from parcels import PARCELS, Parcel
from rogue import Attempt, attempts

from roslings.arena import choose_isolation
from roslings.batch.opening import package_in
from roslings.batch.trouble import Refused

ENTRIES: dict[str, Entry] = {each.name: each for each in (*attempts(), *PARCELS)}
HARMLESS = ("exits_0_from_atexit-run", "fake_std_msgs", "reads-build", "zip_link")
"""A few for every run of the tests."""

JOBS = 3
LACK = choose_isolation().lack
NO_SANDBOX = f"{LACK.reason}: {LACK.next_step}" if LACK else ""
needs_sandbox = pytest.mark.skipif(bool(LACK), reason=NO_SANDBOX)
needs_root = pytest.mark.skipif(os.geteuid() != 0, reason="these tests run as an ordinary user")
USERS = [pytest.param("root", marks=needs_root), "ordinary"]


# --- the packages themselves -------------------------------------------------------------------


@pytest.mark.parametrize("entry", [e for e in ENTRIES.values() if isinstance(e, Attempt)],
                         ids=lambda entry: entry.name)  # fmt: skip
def test_a_rogue_is_a_package(entry: Attempt, tmp_path: Path) -> None:
    """Its edits fit the solution, and its files are Python: it fails by its attack alone."""
    package = entry.make(tmp_path / "chatter", {"mark": "rogue", "token": "rogue"})
    for file in package.rglob("*.py"):
        ast.parse(file.read_text("utf-8"))
    assert (package / "chatter/attack.py").exists() == bool(entry.rogue.attack)


@pytest.mark.parametrize("parcel", PARCELS, ids=lambda parcel: parcel.name)
def test_a_hostile_parcel_is_refused(parcel: Parcel, tmp_path: Path) -> None:
    """With its reason; what it writes stays in the folder for it."""
    handed_in, room = tmp_path / f"it{parcel.ending}", tmp_path / "room"
    room.mkdir()
    parcel.make(handed_in)
    with pytest.raises(Refused, match=parcel.refused):
        package_in(handed_in, "chatter", room)
    assert {path.name for path in tmp_path.iterdir()} == {handed_in.name, "room"}
    assert {path.name for path in room.iterdir()} <= {"unpacked"}


# --- graded ------------------------------------------------------------------------------------


@needs_sandbox
def test_a_few_are_contained() -> None:
    """Those that harm nobody, for every run of the tests."""
    gallery = hang([ENTRIES[name] for name in HARMLESS], ordinary=False, jobs=JOBS)
    for name in HARMLESS:
        insist_on(name, gallery)
    insist_on_nothing_left(gallery)


@pytest.fixture(scope="session")
def graded_as(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Callable[[str], Gallery]:
    """User to what came of all rogues that are asked for, graded in one go.

    The processes of one test run share it: who comes first grades, the others wait.
    """
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent
    asked: dict[str, dict[str, None]] = {}
    for item in request.session.items:
        words = getattr(item, "callspec", None)
        if words and "rogue" in words.params:
            asked.setdefault(words.params["user"], {})[words.params["rogue"]] = None
    return functools.cache(lambda user: _graded(folder, user, [*asked[user]]))


def _graded(folder: Path, user: str, names: list[str]) -> Gallery:
    ordinary = user == "ordinary" and os.geteuid() == 0
    file = folder / f"gallery-{user}.json"
    with (folder / f"gallery-{user}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        failed = file.with_suffix(".failed")
        assert not failed.exists(), "the gallery could not be graded: see the first test's error"
        if not file.exists():
            failed.touch()
            keep(hang([ENTRIES[name] for name in names], ordinary, JOBS), file)
            failed.unlink()
            if place := os.environ.get("ROSLINGS_GALLERY"):
                shutil.copy(file, place)
    return Gallery.model_validate_json(file.read_text("utf-8"))


@pytest.mark.slow
@needs_sandbox
@pytest.mark.parametrize("user", USERS)
@pytest.mark.parametrize("rogue", list(ENTRIES))
def test_a_rogue_is_contained(rogue: str, user: str, graded_as: Callable[[str], Gallery]) -> None:
    """It reaches nothing, its verdict is true, and the next submission has its full score."""
    insist_on(rogue, graded_as(user))


@pytest.mark.slow
@needs_sandbox
@pytest.mark.parametrize("user", USERS)
@pytest.mark.parametrize("rogue", ["zip_link"])
def test_nothing_is_left_of_them(
    rogue: str, user: str, graded_as: Callable[[str], Gallery]
) -> None:
    """No process, no file, no word to anybody; all that is the instructor's is as it was."""
    insist_on_nothing_left(graded_as(user))


def insist_on(name: str, gallery: Gallery) -> None:
    """What must hold of each rogue."""
    seen = gallery.seen[name]
    assert seen.reached == []
    assert untrue(ENTRIES[name].truth, seen) == []
    honest = (seen.neighbour, seen.neighbours_score, seen.neighbours_faults)
    assert honest == ("pass", 100, {})


def insist_on_nothing_left(gallery: Gallery) -> None:
    """What must hold of all together."""
    assert gallery.running == {}
    assert gallery.left == []
    assert gallery.changed == []
    assert gallery.heard == []
    unclear = any(seen.word == "inconclusive" for seen in gallery.seen.values())
    assert gallery.status == (3 if unclear else 0), gallery.words
    assert "Traceback" not in gallery.words
