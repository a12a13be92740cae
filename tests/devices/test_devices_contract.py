"""What every board must do: one suite for the board in Python and for the emulated sketch.

Time passes in explicit steps on both, so that no test here knows how fast this machine is.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest

from roslings.course import root
from roslings_rover.board import Chip, DriveCommand, LineReader, Mega, Speeds, Spoiler, framed
from roslings_rover.emulated import EmulatedMega, built
from roslings_rover.models.board_lines import LONGEST_LINE
from roslings_rover.models.differential_drive import moved
from roslings_rover.rover import Body, Box, Motion, Pose, Rover, Wheels, World
from skips import needs

SKETCH = root() / "labs" / "serial-bridge" / "firmware" / "rover_mega" / "rover_mega.ino"
FLOOR = World(room=Box(-50, -50, 50, 50))
without_emulator = needs("emulated board")


@pytest.fixture(params=["python", pytest.param("emulated", marks=without_emulator)])
def chip(request: pytest.FixtureRequest) -> Iterator[Chip]:
    """A board that was switched on 5 ms ago: the sketch has set up its port by then."""
    if request.param == "python":
        yield switched_on(Mega(Rover(FLOOR)))
    else:
        with EmulatedMega(built(SKETCH)) as emulated:
            yield switched_on(emulated)


def switched_on(chip: Chip) -> Chip:
    """After its first moments."""
    chip.step(0.005)
    return chip


def bodies(said: bytes, kind: str) -> list[str]:
    """The good lines of one kind."""
    return [body for body in LineReader().feed(said) if body.startswith(kind + ",")]


def speeds(said: bytes) -> list[Speeds]:
    """The wheel speeds in what a board said."""
    return [Speeds.read(body) for body in bodies(said, "W")]


def report(chip: Chip) -> tuple[int, int, int]:
    """Accepted, rejected and stops, as the board itself tells within two seconds."""
    last = bodies(chip.step(2.0), "S")[-1]
    accepted, rejected, stops = map(int, last.split(",")[2:])
    return accepted, rejected, stops


@pytest.mark.slow
def test_speeds_come_every_20_ms_of_its_clock_and_none_is_left_out(chip: Chip) -> None:
    """50 Hz, counted from zero."""
    seen = speeds(chip.step(4.01))
    assert [line.seq for line in seen] == list(range(200))
    assert {b.ms - a.ms for a, b in pairwise(seen)} == {20}


def test_every_line_has_its_checksum(chip: Chip) -> None:
    """Nothing but whole lines comes out."""
    reader = LineReader()
    chip.receive(DriveCommand(1, 200, -200).line())
    said = chip.step(3.0)
    said = said[: said.rindex(b"\n") + 1]
    assert len(reader.feed(said)) == said.count(b"\n")
    assert reader.rejected == 0


def test_a_command_turns_the_wheels_and_is_acknowledged(chip: Chip) -> None:
    """PWM 255 is the fastest; the speed told is the speed that is."""
    said = b""
    for seq in range(8):
        chip.receive(DriveCommand(seq, 255, -102).line())
        said += chip.step(0.1)
    assert bodies(said, "A") == [f"A,{seq}" for seq in range(8)]
    fastest = Body().fastest_wheel_rad_s
    assert (chip.truth.left_pwm, chip.truth.right_pwm) == (255, -102)
    assert chip.truth.left_rad_s == pytest.approx(fastest, rel=0.01)
    told = speeds(said)[-1]
    assert told.left_mrad_s == pytest.approx(1000 * fastest, abs=250)
    assert told.right_mrad_s == pytest.approx(-400 * fastest, abs=250)


@pytest.mark.parametrize(("left", "right"), [(0, 0), (1, -1), (255, 255), (-255, 254), (128, 0)])
def test_the_motors_get_exactly_what_was_sent(chip: Chip, left: int, right: int) -> None:
    """Also the two ends, which the sketch switches without a timer."""
    chip.receive(DriveCommand(7, 9, 9).line())
    chip.step(0.05)
    chip.receive(DriveCommand(8, left, right).line())
    chip.step(0.05)
    assert (chip.truth.left_pwm, chip.truth.right_pwm) == (left, right)


def test_half_a_second_without_a_command_stops_the_motors(chip: Chip) -> None:
    """Once, and counted once."""
    chip.receive(DriveCommand(1, 80, 80).line())
    chip.step(0.45)
    assert chip.truth.left_pwm == 80
    chip.step(0.1)
    assert (chip.truth.left_pwm, chip.truth.right_pwm) == (0, 0)
    assert 0.49 < chip.applied[1].time_s - chip.applied[0].time_s < 0.51
    assert report(chip) == (1, 0, 1)


def test_a_command_in_time_keeps_them_going(chip: Chip) -> None:
    """Every 0.4 s is enough."""
    for seq in range(10):
        chip.receive(DriveCommand(seq, 80, 80).line())
        chip.step(0.4)
    assert len(chip.applied) == 1


SPOILT = {
    "wrong checksum": b"$M,1,200,200*0000\n",
    "no checksum": b"$M,1,200,200\n",
    "checksum in small letters": DriveCommand(1, 200, 200).line().lower().replace(b"$m", b"$M"),
    "a digit changed": DriveCommand(1, 100, 100).line().replace(b"100", b"200", 1),
    "too fast": framed("M,1,256,0"),
    "too slow": framed("M,1,0,-999"),
    "one number": framed("M,1,200"),
    "four numbers": framed("M,1,200,200,200"),
    "comma at the end": framed("M,1,200,200,"),
    "not a number": framed("M,1,2x0,200"),
    "a fraction": framed("M,1,200.0,200"),
    "empty": b"$\n",
    "another kind": framed("Q,1,200,200"),
    "too long": b"$" + b"M" * (LONGEST_LINE + 1) + b"\n",
}


@pytest.mark.parametrize("line", SPOILT.values(), ids=SPOILT.keys())
def test_a_spoilt_command_is_counted_and_moves_nothing(chip: Chip, line: bytes) -> None:
    """The motors keep what they had; the next good command counts."""
    chip.receive(DriveCommand(1, 60, 60).line() + line)
    chip.step(0.1)
    assert (chip.truth.left_pwm, chip.truth.right_pwm) == (60, 60)
    chip.receive(DriveCommand(2, -30, 30).line())
    chip.step(0.1)
    assert (chip.truth.left_pwm, chip.truth.right_pwm) == (-30, 30)
    assert report(chip)[:2] == (2, 1)


def test_half_a_line_costs_only_itself(chip: Chip) -> None:
    """A `$` begins anew, without an end of line between."""
    chip.receive(b"$M,1,200,20" + DriveCommand(2, 50, 50).line())
    chip.step(0.1)
    assert chip.truth.left_pwm == 50
    assert report(chip)[:2] == (1, 1)


def test_a_command_in_single_bytes_is_one_command(chip: Chip) -> None:
    """With pauses between them, and with the end of line of a Windows computer."""
    for byte in DriveCommand(3, 70, 71).line().replace(b"\n", b"\r\n"):
        chip.receive(bytes([byte]))
        chip.step(0.005)
    assert (chip.truth.left_pwm, chip.truth.right_pwm) == (70, 71)


def test_bytes_between_the_lines_are_passed_over(chip: Chip) -> None:
    """As long as none of them begins a line."""
    nonsense = bytes(b for b in range(256) if b != ord("$")) * 3
    chip.receive(nonsense + DriveCommand(4, 33, 33).line() + nonsense)
    chip.step(0.4)
    assert chip.truth.left_pwm == 33


@pytest.mark.slow
def test_no_wrong_command_ever_reaches_the_motors(chip: Chip) -> None:
    """300 commands through a bad cable: what the motors got was sent, or was a stop."""
    chance, spoil = random.Random(5), Spoiler(6, noise=0.004, half_lines=0.1, wrong_checksums=0.1)
    sent = {(0, 0)}
    for seq in range(300):
        drive = DriveCommand(seq, chance.randrange(-255, 256), chance.randrange(-255, 256))
        sent.add((drive.left_pwm, drive.right_pwm))
        chip.receive(spoil(drive.line()))
        chip.step(0.01)
    got = [(a.left_pwm, a.right_pwm) for a in chip.applied]
    assert len(got) > 150
    assert set(got) <= sent
    assert report(chip)[1] > 30


def test_a_flood_of_commands_ends_with_the_last_one(chip: Chip) -> None:
    """As fast as the cable carries them."""
    flood = b"".join(DriveCommand(i, i % 200, -i % 200).line() for i in range(400))
    for begin in range(0, len(flood), 115):
        chip.receive(flood[begin : begin + 115])
        chip.step(0.01)
    chip.step(0.05)
    assert (chip.truth.left_pwm, chip.truth.right_pwm) == (399 % 200, -399 % 200)
    assert report(chip)[:2] == (400, 0)


DRIVES = {"straight": (120, 120), "turn": (-80, 80), "arc": (90, 150), "back": (-100, -60)}


@pytest.mark.slow
@pytest.mark.parametrize("pwm", DRIVES.values(), ids=DRIVES.keys())
def test_its_speeds_add_up_to_where_the_rover_is(chip: Chip, pwm: tuple[int, int]) -> None:
    """Odometry from the lines alone, compared with the truth: 1 cm and 1 degree after 3 s."""
    said = b""
    for seq in range(15):
        chip.receive(DriveCommand(seq, *pwm).line())
        said += chip.step(0.2)
    said += chip.step(1.0)
    there = odometry(speeds(said))
    truth = chip.truth.pose
    assert math.dist((there.x_m, there.y_m), (truth.x_m, truth.y_m)) < 0.01
    assert there.heading_rad == pytest.approx(truth.heading_rad, abs=math.radians(1))


def odometry(told: list[Speeds]) -> Pose:
    """Where the rover should be by its wheels."""
    pose, body = Pose(), Body()
    for before, line in pairwise([Speeds(0, 0, 0, 0), *told]):
        wheels = Wheels(line.left_mrad_s / 1000, line.right_mrad_s / 1000)
        pose = moved(pose, body.motion_of(wheels), (line.ms - before.ms) / 1000)
    return pose


# --- the board in Python alone -----------------------------------------------------------------


def test_a_rover_at_a_wall_tells_that_its_wheels_stand() -> None:
    """The motors are driven, and nothing turns."""
    mega = Mega(Rover(World(room=Box(-1, -1, 0.5, 1))))
    said = b""
    for seq in range(20):
        mega.receive(DriveCommand(seq, 255, 255).line())
        said += mega.step(0.2)
    assert mega.truth.left_pwm == 255
    assert speeds(said)[-1].left_mrad_s == 0
    assert mega.rover.touches


def test_steps_of_any_length_give_the_same_lines() -> None:
    """Time is kept in whole microseconds, so nothing is lost between steps."""
    fine, coarse = Mega(Rover(FLOOR)), Mega(Rover(FLOOR))
    for mega in (fine, coarse):
        mega.receive(DriveCommand(1, 100, 50).line())
    in_one = coarse.step(1.0)
    in_many = b"".join(fine.step(1 / 3000) for _ in range(3000)) + fine.step(1e-6)
    assert [s.seq for s in speeds(in_many)] == [s.seq for s in speeds(in_one)]
    assert speeds(in_many)[-1].ms == 1000


def test_the_model_rover_and_the_wheels_agree() -> None:
    """A command for a motion gives that motion."""
    body = Body()
    wheels = body.wheels_for(Motion(0.3, 0.5))
    pwm = [
        round(w / body.fastest_wheel_rad_s * 255) for w in (wheels.left_rad_s, wheels.right_rad_s)
    ]
    mega = Mega(Rover(FLOOR))
    mega.receive(DriveCommand(0, *pwm).line())
    mega.step(0.45)
    assert mega.rover.motion.forward_m_s == pytest.approx(0.3, rel=0.02)
    assert mega.rover.motion.turn_rad_s == pytest.approx(0.5, rel=0.02)


# --- building the sketch -----------------------------------------------------------------------


@without_emulator
def test_the_sketch_is_built_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The second time nothing is compiled; a changed sketch is another one."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    first = built(SKETCH)
    stamp = first.sketch.stat().st_mtime_ns
    assert built(SKETCH) == first
    assert first.sketch.stat().st_mtime_ns == stamp
    changed = tmp_path / "changed.ino"
    changed.write_text(SKETCH.read_text("utf-8") + "\n// another\n", "utf-8")
    assert built(changed).sketch != first.sketch


@without_emulator
def test_a_sketch_that_does_not_compile_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the compiler's own words."""
    from roslings_rover.emulated import CannotBuild

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    wrong = tmp_path / "wrong.ino"
    wrong.write_text("void setup() { nonsense }\nvoid loop() {}\n", "utf-8")
    with pytest.raises(CannotBuild, match="nonsense"):
        built(wrong)
    assert not list((tmp_path / "roslings" / "firmware").glob("*"))


def test_missing_packages_are_told_with_the_apt_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where there is no compiler on the path."""
    from roslings_rover.emulated import CannotBuild

    monkeypatch.setenv("PATH", "")
    with pytest.raises(CannotBuild, match="sudo apt install gcc-avr"):
        built(SKETCH)
