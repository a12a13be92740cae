"""Red and blue in one room: who is first, what each sees of the other, and what the map shows."""

from __future__ import annotations

import io
import math

import pytest

from roslings.capabilities.launch.contract import LaunchWords
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.course import lab, root, written
from roslings_my_rover.parts import LIMITER
from roslings_my_rover.race import FINISH_M, FULL_M_S, LANES, LIGHTS, START_M, Race
from roslings_my_rover.race_nodes import ALLOWED, TAG, WANTED, RaceNode
from roslings_my_rover.race_running import LAUNCH_FILE
from roslings_my_rover.race_view import (
    SLOWER,
    RaceLines,
    RaceWindow,
    below,
    beside,
    cells,
    where,
)
from roslings_rover.models.differential_drive import Motion, Pose
from roslings_rover.models.world import default_world
from roslings_rover.rover.text_map import ASCII

STEP_S = 0.02
LONG_ENOUGH_S = 60.0


def driven(race: Race, limits_m_s: dict[str, float], for_s: float = LONG_ENOUGH_S) -> Race:
    """Both drive as they are told, no faster than their limits."""
    while not race.started:
        race.count_down()
    for _ in range(round(for_s / STEP_S)):
        race.look()
        for each in race.entrants:
            each.rover.drive(Motion(min(each.told_m_s, limits_m_s[each.colour])))
            each.rover.step(STEP_S)
    race.look()
    return race


def test_who_may_drive_faster_wins() -> None:
    """With the time of both: 6 m at the limits of day 8's card."""
    race = driven(Race(), {"red": 0.6, "blue": 0.4})
    assert race.told == "Red wins: 10.2 s. Blue: 15.1 s."
    assert driven(Race(), {"red": 0.15, "blue": 0.4}, 20).told == "Blue wins: 15.1 s."


def test_the_first_one_has_won_before_the_other_is_there() -> None:
    """It stands behind the finish, and its time stands, too."""
    race = driven(Race(), {"red": 0.6, "blue": 0.4}, 12.0)
    red, blue = race.entrants
    assert race.told == "Red wins: 10.2 s."
    assert red.rover.pose.x_m == pytest.approx(FINISH_M, abs=0.2) and not red.told_m_s
    assert red.running_s < blue.running_s and blue.told_m_s == FULL_M_S


def test_two_of_one_limit_end_in_a_dead_heat() -> None:
    """Nobody is called the winner."""
    told = driven(Race(), {"red": 0.4, "blue": 0.4}).told
    assert told.startswith("A dead heat: red 15.1 s, blue 15.1 s.") and len(told) <= 80


def test_nobody_is_told_to_drive_before_the_start() -> None:
    """Three lights go out, one after the other."""
    race = Race()
    for light in range(LIGHTS, 0, -1):
        assert race.told == f"Ready: {light}"
        assert [each.told_m_s for each in race.entrants] == [0, 0]
        race.count_down()
    assert race.started and race.told.startswith("Go!")
    race.count_down()
    assert race.lights == 0


def test_each_sees_the_other_and_cannot_drive_through_it() -> None:
    """The room itself holds neither."""
    race = Race()
    red, blue = race.entrants
    red.rover.pose, blue.rover.pose = Pose(0, -1.5), Pose(1, -1.5, math.pi)
    race.look()
    assert red.rover.range().range_m == pytest.approx(0.78, abs=0.05)
    red.rover.drive(Motion(0.5))
    red.rover.step(5.0)
    assert red.rover.touches and red.rover.pose.x_m == pytest.approx(0.76, abs=0.02)
    assert race.world == default_world()


def test_the_lanes_are_free() -> None:
    """From the start to the finish, and a way to brake behind it."""
    race = Race()
    for lane in LANES:
        for tenth in range(round((FINISH_M - START_M) * 10) + 3):
            assert (
                race.world.room_at(START_M + tenth / 10, lane.y_m)
                > race.entrants[0].rover.body.radius_m
            )


def test_the_map_shows_both_in_their_colours() -> None:
    """With the way of each, and the finish."""
    node = RaceNode(driven(Race(), {"red": 0.6, "blue": 0.4}, 6.0))
    drawn = [cell for row in cells(node, 46, 21, ASCII) for cell in row]
    for lane in LANES:
        own = [cell for cell in drawn if cell.hue == lane.hue and cell.kind != "ball"]
        assert [cell.letter for cell in own if cell.kind == "rover"] == [">"]
        assert any(cell.kind == "path" for cell in own)
    assert sum(cell.letter == ":" for cell in drawn) >= 3


def test_the_window_shows_both_in_their_colours() -> None:
    """Drawn without a screen: the figure is the same."""
    import matplotlib.pyplot as plt

    plt.switch_backend("Agg")
    node = RaceNode(driven(Race(), {"red": 0.6, "blue": 0.4}, 6.0))
    with RaceWindow(node) as window:
        window.show(node)
        window.show(node)  # what is drawn anew is not drawn twice
        (axes,) = plt.gcf().axes
        ways = [line for line in axes.lines if str(line.get_color()) in ("red", "blue")]
        assert [each.get_color() for each in ways] == ["red", "red", "blue", "blue"]
        assert not window.closed and axes.get_title().startswith("Go!")
    assert window.closed


def test_a_pipe_is_told_what_is_news() -> None:
    """A line for who has moved, and none again for who stands where it stood."""
    node, out = RaceNode(driven(Race(), {"red": 0.6, "blue": 0.4}, 6.0)), io.StringIO()
    lines = RaceLines(out)
    lines.show(node)
    begun = out.getvalue()
    assert all(text in begun for text in (node.told, *map(where, node.rovers)))
    lines.show(node)
    assert out.getvalue() == begun
    node.rovers[0].rover.step(1.0)
    lines.show(node)
    assert out.getvalue().removeprefix(begun).splitlines() == [where(node.rovers[0])]


@pytest.mark.parametrize("for_s", [0, 6, 60])
def test_its_words_fit(for_s: float) -> None:
    """Beside the map 32 columns; the lines of a pipe tell each rover."""
    node = RaceNode(driven(Race(), {"red": 0.6, "blue": 0.4}, for_s))
    assert max(map(len, beside(node))) <= 32
    assert max(map(len, below(node))) <= 80
    assert (SLOWER in below(node)[1]) == (for_s < 10)
    assert where(node.rovers[1]).startswith("blue: x ")


def test_the_names_are_those_of_the_card() -> None:
    """A card that is changed for a new term changes the race, or this test."""
    card = lab(LIMITER.lab).card
    launch = written(card.of(LaunchWords).launch, LIMITER.lab)
    assert launch.name == LAUNCH_FILE
    assert [each.namespace for each in launch.namespaces] == [f"/{lane.colour}" for lane in LANES]
    limiter, beacon = card.node("speed_limiter"), card.node("beacon")
    assert [each.topic for each in limiter.subscribes] == [f"/{WANTED}"]
    assert [each.topic for each in limiter.publishes] == [f"/{ALLOWED}"]
    assert [each.topic for each in beacon.publishes] == [f"/{TAG}"]
    assert limiter.of(ParameterWords).parameter("careful") and " careful " in SLOWER


def test_task_and_page_type_what_the_map_tells() -> None:
    """The command that makes red careful, and the one that starts the race."""
    page = root() / "site/pages/reference/my-rover.md"
    for text in (page.read_text("utf-8"), lab(LIMITER.lab).task.read_text("utf-8")):
        assert f"\n{SLOWER}\n" in text and "\n./roslings my-rover --race\n" in text
