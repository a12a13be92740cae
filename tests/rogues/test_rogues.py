"""The rogues' gallery: strangers' packages that attack, each beside an honest one.

Of each: it is contained, its verdict is true, its neighbour has the full score (beside one that
takes the processors it may have to try again: it loses no point), and nothing of it is left. A
rogue says what it reached; witnesses outside say whether that is so.

    ./roslings test tests/rogues                                 a few that do no harm
    ./roslings test tests/rogues/test_rogues.py -m slow          all of them
    ./roslings test tests/rogues -m slow -k "root and fork_bomb" one of them
    ./roslings test tests/rogues -m "slow and alone" -n 0        those that take the whole machine

Those that take the whole machine are graded some at a time. After the moment that
`ROSLINGS_TESTS_UNTIL` names (seconds since 1970) no more begin, and their tests are skipped.

`ROSLINGS_GALLERY=DIR` keeps what was seen of each: verdict, words, what was held off.
"""

from __future__ import annotations

import ast
import functools
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from gallery import Entry, Gallery, Seen, hang, hang_in_turns, next_to, turns, untrue
from parcels import PARCELS, Parcel
from rogue import LAB, Attempt, attempts
from stage import SANDBOX, TIME, UNTIL_S

from asked_for import MADE_FOR_ALL, asked_for
from once import once
from roslings.hand_in.errors import HandInRefused
from roslings.hand_in.unpack import package_in
from roslings.workspace.errors import WorkspaceError
from roslings.workspace.inspect import inspect_package
from skips import needs, skip_without

ENTRIES: dict[str, Entry] = {each.name: each for each in (*attempts(), *PARCELS)}
HARMLESS = ("exits_0_from_atexit-run", "fake_std_msgs", "reads-build", "zip_link")
"""A few for every run of the tests."""

JOBS, JOBS_OF_THE_WILD = 4, 2
"""Most of a grading is waiting. One that rages has its honest neighbour beside it, and no other."""
needs_sandbox = needs(*SANDBOX)
needs_root = needs("root")
ONE_WORKER = pytest.mark.xdist_group("rogues")
"""It asks for both galleries, one after the other: no other waits for them."""
MARKS_OF = {"root": [needs_root, ONE_WORKER], "ordinary": [ONE_WORKER]}


# --- the packages themselves -------------------------------------------------------------------


@pytest.mark.parametrize(
    "entry", [e for e in ENTRIES.values() if isinstance(e, Attempt)], ids=lambda entry: entry.name
)
def test_a_rogue_is_a_package(entry: Attempt, tmp_path: Path) -> None:
    """Its edits fit the solution, and its files are Python: it fails by its attack alone."""
    package = entry.make(tmp_path / "chatter", {"mark": "rogue", "token": "rogue"})
    for file in package.rglob("*.py"):
        ast.parse(file.read_text("utf-8"))
    assert (package / "chatter/attack.py").exists() == bool(entry.rogue.attack)


@pytest.mark.slow
@pytest.mark.parametrize("parcel", PARCELS, ids=lambda parcel: parcel.name)
def test_a_hostile_parcel_is_refused(parcel: Parcel, tmp_path: Path) -> None:
    """With its reason, when it is unpacked or read; what it writes stays in the folder for it."""
    handed_in, room = tmp_path / f"it{parcel.ending}", tmp_path / "room"
    room.mkdir()
    parcel.make(handed_in)
    with pytest.raises((HandInRefused, WorkspaceError), match=parcel.refused):
        inspect_package(package_in(handed_in, "chatter", room), LAB.card)
    assert {path.name for path in tmp_path.iterdir()} == {handed_in.name, "room"}
    assert {path.name for path in room.iterdir()} <= {"unpacked"}


# --- graded ------------------------------------------------------------------------------------


def test_the_wild_come_in_turns() -> None:
    """Each once, all places of one together; another commit has another order."""
    wild = [ENTRIES[name] for name in ENTRIES if is_wild(name)]
    orders = [[entry.name for few in turns(wild, seed) for entry in few] for seed in "abc"]
    assert all(sorted(order) == sorted(entry.name for entry in wild) for order in orders)
    assert orders[0] != orders[1]
    for few in turns(wild, "a"):
        ours = {next_to(entry) for entry in few}
        assert not ours & {next_to(entry) for entry in wild if entry not in few}


@pytest.mark.slow
@needs_sandbox
def test_a_few_are_contained() -> None:
    """Those that harm nobody, for every run of the tests."""
    gallery = hang([ENTRIES[name] for name in HARMLESS], ordinary=False, jobs=JOBS)
    for name in HARMLESS:
        insist_on(name, gallery)
    insist_on_nothing_left(gallery)


def is_wild(name: str) -> bool:
    """It stresses the whole machine, at whichever place it begins; no parcel does."""
    entry = ENTRIES[name]
    return isinstance(entry, Attempt) and entry.rogue.alone


NOTHING_LEFT = "nothing_left"
"""Not a rogue: what is asked of a whole gallery."""


def graded(wild: bool) -> pytest.MarkDecorator:
    """One test for each rogue of a gallery and each user, named USER-ROGUE."""
    return pytest.mark.parametrize(
        ("user", "rogue"),
        [
            pytest.param(user, name, id=f"{user}-{name}", marks=_marks(user, name))
            for user in ("root", "ordinary")
            for name in [*(name for name in ENTRIES if is_wild(name) == wild), NOTHING_LEFT]
        ],
    )


def _marks(user: str, name: str) -> list[pytest.MarkDecorator]:
    """Each user's are graded by one worker; root's only where the user makes a difference."""
    entry = ENTRIES.get(name)
    differs = name == NOTHING_LEFT or (isinstance(entry, Attempt) and entry.rogue.as_root)
    once_is_enough = [] if user == "ordinary" or differs else [pytest.mark.twice]
    return [*MARKS_OF[user], MADE_FOR_ALL, *once_is_enough]


@pytest.fixture(scope="session")
def graded_as(
    request: pytest.FixtureRequest, shared_folder: Path
) -> Callable[[str, bool], Gallery]:
    """User to what came of the tame or the wild rogues that are asked for, graded in one go."""
    asked: dict[tuple[str, bool], dict[str, None]] = {}
    for item, words in asked_for(request, __file__):
        if "rogue" in words:
            name, user = words["rogue"], words["user"]
            wild = item.get_closest_marker("alone") is not None
            asked.setdefault((user, wild), {})
            if name != NOTHING_LEFT:
                asked[user, wild][name] = None

    @functools.cache
    def gallery(user: str, wild: bool) -> Gallery:
        file = shared_folder / f"gallery-{user}-{'wild' if wild else 'tame'}.json"
        return _graded(file, user, wild, [*asked[user, wild]] or [*HARMLESS])

    return gallery


def _graded(file: Path, user: str, wild: bool, names: list[str]) -> Gallery:
    ordinary = user == "ordinary" and os.geteuid() == 0

    def grade() -> str:
        entries = [ENTRIES[name] for name in names]
        if wild:
            found = hang_in_turns(entries, ordinary, JOBS_OF_THE_WILD, UNTIL_S)
        else:
            found = hang(entries, ordinary, JOBS)
        return found.model_dump_json(indent=1)

    found = once(file, grade)
    if folder := os.environ.get("ROSLINGS_GALLERY"):
        Path(folder, file.name).write_text(found, "utf-8")
    return Gallery.model_validate_json(found)


@pytest.mark.slow
@needs_sandbox
@graded(wild=False)
def test_a_rogue_is_contained(
    rogue: str, user: str, graded_as: Callable[[str, bool], Gallery]
) -> None:
    """It reaches nothing, its verdict is true, and the next submission has its full score."""
    insist_on(rogue, graded_as(user, False))


@pytest.mark.slow
@pytest.mark.alone
@needs_sandbox
@graded(wild=True)
def test_a_wild_rogue_is_contained(
    rogue: str, user: str, graded_as: Callable[[str, bool], Gallery]
) -> None:
    """The same of those that stress the machine, where there was time for it."""
    gallery = graded_as(user, True)
    was_graded = rogue in gallery.seen or (rogue == NOTHING_LEFT and gallery.seen)
    if not was_graded:
        skip_without(TIME)
    insist_on(rogue, gallery)


def insist_on(name: str, gallery: Gallery) -> None:
    """What must hold of each rogue, and of all together."""
    if name == NOTHING_LEFT:
        insist_on_nothing_left(gallery)
        return
    seen = gallery.seen[name]
    assert seen.reached == []
    assert untrue(ENTRIES[name].truth, seen) == []
    insist_on_honest(seen.neighbour, ENTRIES[name].truth.may_be_unclear)


def insist_on_honest(seen: Seen | None, is_beside_wild: bool) -> None:
    """The full score; beside one that takes the processors it may be told to try again."""
    assert seen
    if is_beside_wild and seen.word == "inconclusive":
        assert "inconclusive" in seen.outcomes.values()
        assert "fail" not in seen.outcomes.values()
    else:
        assert (seen.word, seen.reason, seen.score, seen.faults) == ("pass", "", 100, {})


def insist_on_nothing_left(gallery: Gallery) -> None:
    """No process, no file, no word to anybody; all that is the instructor's is as it was."""
    assert gallery.running == {}
    assert gallery.left == []
    assert gallery.changed == []
    assert gallery.heard == []
    both = [each for seen in gallery.seen.values() for each in (seen, seen.neighbour) if each]
    unclear = any(each.word == "inconclusive" for each in both)
    assert gallery.status == (3 if unclear else 0), gallery.words
    assert "Traceback" not in gallery.words
