"""Look-ups in a tree: right numbers at all times, and geometry2's words where there are none."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from frame_reference import BEGIN_NS, KEPT_NS, SECOND_NS, worst_error

from ros2_on_pip.stand_ins._frames import errors
from ros2_on_pip.stand_ins._frames.errors import (
    ConnectivityException,
    ExtrapolationException,
    LookupException,
    TransformException,
)
from ros2_on_pip.stand_ins._frames.history import Moving, NotKnown, ParentTransform
from ros2_on_pip.stand_ins._frames.motion import RigidTransform
from ros2_on_pip.stand_ins._frames.tree import FrameTree
from sources import code_of

GOAL = 1e-9
NEWEST = 0


def ahead(x_m: float) -> RigidTransform:
    """So far along x."""
    return RigidTransform((x_m, 0.0, 0.0))


def tree(**parents: str) -> FrameTree:
    """Each frame one metre ahead of its parent, and it never moves."""
    made = FrameTree(KEPT_NS)
    for child, parent in parents.items():
        made.set_static(child, ParentTransform(parent, ahead(1.0)))
    return made


def moving(made: FrameTree, child: str, parent: str, *times_s: float) -> FrameTree:
    """One that is at x = t at the time t."""
    for time_s in times_s:
        made.set_moving(child, round(time_s * SECOND_NS), ParentTransform(parent, ahead(time_s)))
    return made


def test_random_trees_as_transforms3d() -> None:
    """To 1e-9, in both directions, across the root, at times that were never said."""
    assert worst_error(seed=1, trees=500) < GOAL


@pytest.mark.slow
def test_ten_thousand_random_trees_as_transforms3d() -> None:
    """The figure."""
    assert worst_error(seed=2, trees=10_000) < GOAL


def test_up_down_and_across() -> None:
    """From a child to its parent, back, and between two branches."""
    made = tree(base="odom", laser="base", camera="base")
    assert made.look_up("odom", "laser", NEWEST)[0].shift == (2.0, 0.0, 0.0)
    assert made.look_up("laser", "odom", NEWEST)[0].shift == (-2.0, 0.0, 0.0)
    assert made.look_up("laser", "camera", NEWEST)[0].shift == (0.0, 0.0, 0.0)
    assert made.look_up("base", "base", NEWEST) == (RigidTransform(), 0)
    assert made.look_up("nobody", "nobody", 7) == (RigidTransform(), 7)


def test_the_newest_is_what_all_steps_have() -> None:
    """Not the newest of one: its time is said."""
    made = moving(tree(laser="base"), "base", "odom", 1.0, 2.0)
    moving(made, "odom", "map", 1.0, 1.5)
    motion, at_ns = made.look_up("map", "laser", NEWEST)
    assert at_ns == round(1.5 * SECOND_NS)
    assert motion.shift == pytest.approx((1.5 + 1.5 + 1.0, 0.0, 0.0))
    assert made.look_up("odom", "base", NEWEST)[1] == 2 * SECOND_NS
    assert made.look_up("base", "laser", NEWEST)[1] == 0, "what never moves has no time"


def test_a_gap_above_both_does_not_matter() -> None:
    """map to odom is not known then, and nobody needs it between base and laser."""
    made = moving(tree(laser="base", camera="base"), "base", "odom", 1.0, 2.0)
    moving(made, "odom", "map", 5.0, 6.0)
    at_ns = round(1.5 * SECOND_NS)
    assert made.look_up("camera", "laser", at_ns)[0].shift == (0.0, 0.0, 0.0)
    assert made.look_up("odom", "laser", at_ns)[0].shift == pytest.approx((2.5, 0.0, 0.0))
    with pytest.raises(ExtrapolationException, match="into the past"):
        made.look_up("map", "laser", at_ns)


def test_a_frame_that_changes_its_parent() -> None:
    """Between the two it is where it was last said to be, below the old one."""
    made = moving(tree(), "cup", "table", 1.0, 2.0)
    moving(made, "cup", "hand", 3.0)
    assert made.look_up("table", "cup", round(2.5 * SECOND_NS))[0].shift == (2.0, 0.0, 0.0)
    assert made.look_up("hand", "cup", NEWEST)[0].shift == (3.0, 0.0, 0.0)
    with pytest.raises(ConnectivityException):
        made.look_up("table", "cup", NEWEST)


def test_from_static_to_moving_and_back() -> None:
    """The last word says which it is."""
    made = moving(tree(base="odom"), "base", "odom", 5.0)
    with pytest.raises(ExtrapolationException):
        made.look_up("odom", "base", SECOND_NS)
    made.set_static("base", ParentTransform("odom", ahead(9.0)))
    assert made.look_up("odom", "base", SECOND_NS)[0].shift == (9.0, 0.0, 0.0)


def test_what_is_older_than_is_kept() -> None:
    """It goes when a newer one comes, and does not come back."""
    kept = Moving(keep_ns=10 * SECOND_NS)
    for time_s in (1, 5, 12):
        assert kept.insert(time_s * SECOND_NS, ParentTransform("odom", ahead(time_s)))
    assert (kept.length, kept.oldest_ns) == (2, 5 * SECOND_NS)
    assert not kept.insert(SECOND_NS, ParentTransform("odom", ahead(1.0)))
    assert kept.insert(2 * SECOND_NS, ParentTransform("odom", ahead(2.0))), "as old as is allowed"


def test_two_for_one_moment() -> None:
    """The later counts, and it is one moment still."""
    kept = Moving(keep_ns=10 * SECOND_NS)
    for x_m in (1.0, 2.0):
        kept.insert(SECOND_NS, ParentTransform("odom", ahead(x_m)))
    assert kept.length == 1
    assert kept.at(SECOND_NS).motion == ahead(2.0)


def test_clear_forgets_what_moves() -> None:
    """Names stay, and what never moves."""
    made = moving(tree(laser="base"), "base", "odom", 1.0, 2.0)
    made.clear()
    assert made.look_up("base", "laser", NEWEST)[0].shift == (1.0, 0.0, 0.0)
    assert "odom" in made.names
    with pytest.raises(ConnectivityException):
        made.look_up("odom", "laser", NEWEST)
    with pytest.raises(ExtrapolationException, match=r"^, when looking up transform from frame"):
        made.look_up("odom", "laser", SECOND_NS)
    with pytest.raises(NotKnown):
        Moving(SECOND_NS).at(NEWEST)


def test_the_chain_between_two() -> None:
    """By the frame where both ways meet."""
    made = tree(base="odom", laser="base", lens="camera", camera="base")
    assert made.chain("lens", "laser") == ["laser", "base", "camera", "lens"]
    assert made.chain("odom", "laser") == ["laser", "base", "odom"]
    assert made.chain("laser", "odom") == ["odom", "base", "laser"]


# --- the words ---------------------------------------------------------------------------------

WAY = ", when looking up transform from frame [laser] to frame [odom]"
Case = tuple[Callable[[], object], type[TransformException], str]


def look_up(made: FrameTree, target: str, source: str, time_s: float = 0.0) -> Callable[[], object]:
    """To be called."""
    return lambda: made.look_up(target, source, round(time_s * SECOND_NS))


CASES: dict[str, Case] = {
    "no name": (
        lambda: tree().require("", "lookupTransform argument target_frame"),
        errors.InvalidArgumentException,
        'Invalid argument "" passed to lookupTransform argument target_frame'
        " - in tf2 frame_ids cannot be empty",
    ),
    "a slash": (
        lambda: tree().require("/map", "lookupTransform argument target_frame"),
        errors.InvalidArgumentException,
        'Invalid argument "/map" passed to lookupTransform argument target_frame'
        " - in tf2 frame_ids cannot start with a '/'",
    ),
    "no such frame": (
        lambda: tree(base="odom").require("map", "lookupTransform argument target_frame"),
        LookupException,
        '"map" passed to lookupTransform argument target_frame does not exist. ',
    ),
    "two trees": (
        look_up(tree(laser="base", odom="map"), "map", "laser"),
        ConnectivityException,
        "Could not find a connection between 'map' and 'laser' because they are not part of the"
        " same tree.Tf has two or more unconnected trees.",
    ),
    "two trees, at a time": (
        look_up(tree(laser="base", odom="map"), "map", "laser", 1.0),
        ConnectivityException,
        "Could not find a connection between 'map' and 'laser' because they are not part of the"
        " same tree.Tf has two or more unconnected trees.",
    ),
    "one moment": (
        look_up(moving(tree(), "laser", "odom", 1.0), "odom", "laser", 2.0),
        ExtrapolationException,
        "Lookup would require extrapolation at time 2.000000, but only time 1.000000 is in the"
        " buffer" + WAY,
    ),
    "the future": (
        look_up(moving(tree(), "laser", "odom", 1.0, 2.0), "odom", "laser", 3.0),
        ExtrapolationException,
        "Lookup would require extrapolation into the future.  Requested time 3.000000 but the"
        " latest data is at time 2.000000" + WAY,
    ),
    "the past": (
        look_up(moving(tree(), "laser", "odom", 1.0, 2.0), "odom", "laser", 0.5),
        ExtrapolationException,
        "Lookup would require extrapolation into the past.  Requested time 0.500000 but the"
        " earliest data is at time 1.000000" + WAY,
    ),
    "a loop": (
        look_up(tree(a="b", b="c", c="a", d="e"), "e", "a"),
        LookupException,
        "The tf tree is invalid because it contains a loop.\nFrame a exists with parent b.\n"
        "Frame b exists with parent c.\nFrame c exists with parent a.\n"
        "Frame d exists with parent e.\n\n",
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_the_words_of_geometry2(case: Case) -> None:
    """Letter for letter: a student pastes them into a search."""
    act, kind, text = case
    with pytest.raises(TransformException) as raised:
        act()
    assert type(raised.value) is kind
    assert str(raised.value) == text


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_the_table_has_them(case: Case) -> None:
    """`COMMANDS.md` says each, with where it comes from."""
    _, kind, text = case
    table = (code_of("ros2_on_pip") / "COMMANDS.md").read_text("utf-8")
    assert f"| `{kind.__name__}` | `{text.partition(chr(10))[0]}`" in table


def test_a_time_as_geometry2_writes_it() -> None:
    """Six digits."""
    assert errors.seconds(BEGIN_NS + 123_456_789) == "1700000000.123457"


def test_a_traceback_names_the_module_of_the_real_one() -> None:
    """`tf2.LookupException: ...`"""
    assert {each.__module__ for each in errors.EXCEPTIONS} == {"tf2"}
    assert all(issubclass(each, TransformException) for each in errors.EXCEPTIONS)
