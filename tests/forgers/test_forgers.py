"""The forgers' gallery: a talker of 1 Hz that earns 86 points, and tries to have more.

Behind every wall: none has more, none changes the course, the results or the environment, and
honest packages beside them have what they earn.

    ./roslings test tests/forgers -m slow                            all, behind all walls
    ./roslings test tests/forgers -m slow -k "user and rewrites"     one of them
"""

from __future__ import annotations

import ast
import functools
from collections.abc import Callable
from pathlib import Path

import pytest
from behind import HONEST, NEEDED, SLOW, WALLS, Graded, Wall, grade
from forger import HONEST_SCORE, Forger, forgers

from asked_for import MADE_FOR_ALL, asked_for
from once import once
from skips import skip_without

ENTRIES = {each.name: each for each in forgers()}
JOBS = 2
TOUCH_OTHERS = (
    "inherited_descriptors",
    "leaves_a_daemon",
    "plants_in_python",
    "poisons_the_home",
    "replaces_programs",
    "rewrites_the_grader",
    "second_a_leaves",
    "second_b_takes",
    "writes_the_verdict",
)
"""They write into files, homes or processes of the grader or of other students."""


def _marks(wall: Wall) -> list[pytest.MarkDecorator]:
    """One worker asks for all that were graded behind one wall: no other waits for it.

    The namespaces are the same ones for root; what root's rights change, the rogues show.
    """
    again = [pytest.mark.twice] if wall == "namespaces_as_root" else []
    return [pytest.mark.xdist_group(f"forgers_{wall}"), MADE_FOR_ALL, *again]


def _behind(wall: Wall, name: str) -> object:
    """Users are graded one after the other: most forgers wait for `-m slow` there.

    What another user may not do is held off by the kernel; those that touch what is somebody
    else's try it each time.
    """
    again = [pytest.mark.twice] if wall == "user" and name not in TOUCH_OTHERS else []
    return pytest.param(wall, name, marks=[*_marks(wall), *again], id=f"{name}-{wall}")


BEHIND_EACH = pytest.mark.parametrize(
    "wall", [pytest.param(wall, marks=_marks(wall)) for wall in WALLS]
)


@pytest.mark.parametrize("entry", ENTRIES.values(), ids=ENTRIES.keys())
def test_a_forger_is_a_package(entry: Forger, tmp_path: Path) -> None:
    """Its files are Python, and it attacks somewhere: it has 86 by its talker alone."""
    known = {"mark": "forger", "token": "forger"}
    entry.make(tmp_path / "chatter", known)
    for file in (tmp_path / "chatter").rglob("*.py"):
        ast.parse(file.read_text("utf-8"))
    if entry.file.suffix == ".yaml" and entry.name != "behaves_for_the_camera":
        assert [*(tmp_path / "chatter/chatter").glob("attack_*.py")]


@pytest.fixture(scope="session")
def graded_behind(request: pytest.FixtureRequest, shared_folder: Path) -> Callable[[Wall], Graded]:
    """Wall to what came of the forgers that are asked for, graded in one go."""
    asked: dict[str, list[Forger]] = {}
    for _, words in asked_for(request, __file__):
        if "wall" in words and (name := words.get("name")) in ENTRIES:
            asked.setdefault(words["wall"], []).append(ENTRIES[name])

    @functools.cache
    def graded(wall: Wall) -> Graded:
        skip_without(*NEEDED[wall])
        file = shared_folder / f"forgers-{wall}.json"
        found = once(file, lambda: grade(asked.get(wall, []), wall, JOBS).model_dump_json())
        return Graded.model_validate_json(found)

    return graded


@pytest.mark.slow
@pytest.mark.parametrize(
    ("wall", "name"), [_behind(wall, name) for name in ENTRIES for wall in WALLS]
)
def test_nobody_forges_a_grade(
    name: str, wall: Wall, graded_behind: Callable[[Wall], Graded]
) -> None:
    """None has more than it earns."""
    insist_on(name, graded_behind(wall))


@pytest.mark.slow
@BEHIND_EACH
def test_all_else_is_as_it_was(wall: Wall, graded_behind: Callable[[Wall], Graded]) -> None:
    """Honest packages have their points, nothing is changed, and nothing still runs."""
    insist_on_the_rest(graded_behind(wall), wall)


def insist_on(name: str, graded: Graded) -> None:
    """What must hold of each forger."""
    seen = graded.seen[name]
    assert seen.reached == []
    assert seen.score is None or seen.score <= HONEST_SCORE
    assert seen.word in ("fail", "inconclusive")


def insist_on_the_rest(graded: Graded, wall: Wall) -> None:
    """What must hold of all together."""
    honest = {name: (graded.seen[name].score, graded.seen[name].failed) for name in HONEST}
    assert honest == dict.fromkeys(HONEST, (100, []))
    slow = graded.seen[SLOW]
    assert (slow.score, slow.failed) == (HONEST_SCORE, ["rate"])
    assert slow.wall == ("user" if wall == "user" else "namespaces")
    assert graded.changed == []
    assert graded.running == {}
    assert "Traceback" not in graded.words
