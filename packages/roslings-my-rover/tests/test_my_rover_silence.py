"""Who is silent: a program that was heard and is no more, or that never was."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from roslings_my_rover.parts import PARTS
from roslings_my_rover.silence import AGAIN_WITHIN_S, FIRST_WITHIN_S, Silence
from roslings_my_rover.wiring import Steady, wired

PACE = Steady("motor_controller", "/motor_state", "std_msgs/msg/Float64")
BRIDGE = Steady("serial_bridge", "/odom", "nav_msgs/msg/Odometry", by_cable=True)


@dataclass
class Clock:
    """Time that a test lets go on."""

    now_s: float = 1000.0

    def __call__(self) -> float:
        """Now."""
        return self.now_s


@pytest.fixture
def clock() -> Clock:
    """A new one."""
    return Clock()


@pytest.fixture
def silence(clock: Clock) -> Silence:
    """That waits for a motor controller and a bridge."""
    silence = Silence(clock)
    silence.expect([PACE, BRIDGE])
    return silence


def passed(silence: Silence, clock: Clock, seconds: float, plugged: bool = True) -> list[str]:
    """Who is silent when so much time has passed, in which somebody looked all the time."""
    until_s = clock.now_s + seconds
    while clock.now_s < until_s:
        clock.now_s += 0.2
        found = silence.look(plugged)
    return [each.line for each in found]


def test_who_goes_on_is_not_silent(silence: Silence, clock: Clock) -> None:
    """However long it does."""
    for _ in range(30):
        silence.hear("/motor_state")
        silence.hear("/odom")
        assert passed(silence, clock, AGAIN_WITHIN_S - 1) == []


def test_who_was_heard_and_is_no_more_is_silent(silence: Silence, clock: Clock) -> None:
    """Until it is heard again."""
    silence.hear("/motor_state")
    (line,) = passed(silence, clock, AGAIN_WITHIN_S + 1)
    assert line == "motor_controller hangs? It says nothing on /motor_state any more."
    silence.hear("/motor_state")
    assert silence.look() == ()


def test_who_never_says_anything_has_longer(silence: Silence, clock: Clock) -> None:
    """It may still be starting."""
    assert passed(silence, clock, FIRST_WITHIN_S - 1) == []
    assert passed(silence, clock, 2)[0].endswith("It says nothing on /motor_state yet.")


def test_who_is_started_anew_has_time_anew(silence: Silence, clock: Clock) -> None:
    """The wiring has changed."""
    silence.hear("/motor_state")
    assert passed(silence, clock, AGAIN_WITHIN_S + 1)
    silence.expect([PACE])
    assert passed(silence, clock, FIRST_WITHIN_S - 1) == []


def test_a_pulled_cable_blames_nobody(silence: Silence, clock: Clock) -> None:
    """And gives the bridge time to come back."""
    silence.hear("/odom")
    silence.hear("/motor_state")
    lines = passed(silence, clock, 60, plugged=False)
    assert len(lines) == 1 and lines[0].startswith("motor_controller")
    silence.hear("/motor_state")
    assert passed(silence, clock, AGAIN_WITHIN_S - 1) == []
    assert any(line.startswith("serial_bridge") for line in passed(silence, clock, 2))


def test_who_did_not_look_blames_nobody(silence: Silence, clock: Clock) -> None:
    """The rover itself was stopped, or had no processor."""
    silence.hear("/motor_state")
    silence.hear("/odom")
    clock.now_s += 100
    assert silence.look() == ()
    assert len(passed(silence, clock, AGAIN_WITHIN_S + 1)) == 2


def test_each_line_fits_on_the_map(clock: Clock) -> None:
    """Of each program of a whole rover."""
    silence = Silence(clock)
    silence.expect(wired(PARTS, mark="_1a2b3c").robot.steady)
    clock.now_s += 0.5
    lines = passed(silence, clock, FIRST_WITHIN_S + 1)
    assert len(lines) == 8 and max(map(len, lines)) <= 80, lines
    assert "1a2b3c" not in " ".join(lines)
