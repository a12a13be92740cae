"""A lab of another course has its package's own node driven through rooms, inside the walls.

Real nodes, real sandboxes where this machine has them, and short drives. What is wrong in a package
is written into its solution.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from roslings.capabilities.rooms.record import RoomDriveSeen, RoomsSeen
from roslings.capabilities.rooms.seeds import OWN, SECRET
from roslings_class.gradebook import Gradebook, gradebook
from roslings_class.grading import unpacked
from roslings_class.result import GradingResult
from roslings_class.signed_gradebook import take_key
from until_told import Checked, checked

pytestmark = pytest.mark.slow

COURSE = Path(__file__).with_name("courses") / "harbour"
SOLUTION = COURSE / "labs/pilot/solution/pilotage"
CODE = "pilotage/pilot.py"
SPIN = "        rclpy.spin(Pilot())\n"
SLEEPS = """\
        pilot = Pilot()
        while rclpy.ok():
            rclpy.spin_once(pilot, timeout_sec=0.0)
            time.sleep(0.02)
"""
SAYS = "        command = Twist()\n"
COMPUTES = """\
        until_s = time.thread_time() + 0.7
        while time.thread_time() < until_s:
            pass
"""
ENDS = """\
        self.looked = getattr(self, 'looked', 0) + 1
        if self.looked > 20:
            raise ValueError('there is no quay')
"""
TURNS_AWAY = "        return 0.0, -sign * TURNS_RAD_S / 2\n"


@dataclass(frozen=True)
class Found:
    """What came of a check: its verdict, and the drives of each experiment."""

    checked: Checked
    drives: dict[str, list[RoomDriveSeen]]
    wrote: dict[str, str]
    """All that each process of the student's own rooms has written."""

    def outcome(self, name: str) -> dict[str, Any]:
        """Of one check."""
        return next(each for each in self.checked.verdict["checks"] if each["id"] == name)

    @property
    def all(self) -> list[RoomDriveSeen]:
        """Those of all experiments."""
        return [each for drives in self.drives.values() for each in drives]


def found(folder: Path, rooms: str, *edits: tuple[str, str]) -> Found:
    """Check the solution with these edits, in rooms that are chosen, and in secret ones."""
    folder.mkdir(exist_ok=True)
    package = shutil.copytree(SOLUTION, folder / "pilotage")
    code = package / CODE
    for old, new in edits:
        text = code.read_text("utf-8")
        assert text.count(old) == 1
        code.write_text(text.replace(old, new), "utf-8")
    environment = {**os.environ, "ROSLINGS_COURSE": str(COURSE), OWN: rooms, SECRET: "quay"}
    shutil.rmtree(folder / "kept", ignore_errors=True)
    done = checked("pilot", package, "--evidence", "kept", folder=folder, env=environment)
    evidence = json.loads((folder / "kept/evidence.json").read_bytes())
    experiments = evidence["experiments"]
    parts = {name: seen["parts"].get("rooms") for name, seen in experiments.items()}
    return Found(
        done,
        {name: RoomsSeen.model_validate(part).drives for name, part in parts.items() if part},
        {name: json.dumps(each["lines"]) for name, each in experiments["own"]["processes"].items()},
    )


WITH_TIME = ("import math\n", "import math\nimport time\n")


def test_a_follower_is_believed_and_drives_the_same_each_time(tmp_path: Path) -> None:
    """All points; tick for tick the same evidence; and a launch file drives as its node does."""
    one, two = (found(tmp_path / name, "17 3 1") for name in ("one", "two"))
    assert one.checked.verdict["score"] == 100, one.checked.ran.stdout
    assert [each.seed for each in one.drives["own"]] == [17, 3, 1]
    assert len({each.seed for each in one.all}) == 4
    assert {(each.clock, each.why_wall, each.ended) for each in one.all} == {("lockstep", None, "")}
    assert all(len(each.ticks) == 300 for each in one.all)
    assert one.drives == two.drives
    assert one.drives["launched"] == one.drives["own"][:1]


def test_who_touches_is_told_where(tmp_path: Path) -> None:
    """In lockstep, with the place and the moment."""
    blind = found(tmp_path, "17", (TURNS_AWAY, "        return FAST_M_S, 0.0\n"))
    assert {each.clock for each in blind.all} == {"lockstep"}
    touches = blind.outcome("touches")
    assert (touches["outcome"], touches["fault"]) == ("fail", "BumpsIntoThings")
    assert touches["fields"]["room"] == 17
    assert touches["fields"]["bumps"] == len(blind.drives["own"][0].bumps)


def test_what_is_said_beside_the_drive_is_told_and_kept(tmp_path: Path) -> None:
    """A field that drives no wheel costs no check but of the drive; and what the node wrote."""
    more = "        command.angular.y = math.nan\n        print('I have looked', flush=True)\n"
    told = found(tmp_path, "17", (SAYS, SAYS + more))
    assert {each.stray for each in told.all} == {"angular.y is nan"}
    failed = [each["id"] for each in told.checked.verdict["checks"] if each["outcome"] != "pass"]
    assert failed == ["drives", "unseen", "launches"]
    assert told.outcome("drives")["fault"] == "SaysMoreThanItDrives"
    assert "I have looked" in told.wrote["pilot in room 17"]


def test_who_sleeps_on_the_wall_clock_is_named_and_driven_in_real_time(tmp_path: Path) -> None:
    """It may have its points there, and the verdict says so. No two such drives are equal."""
    asleep = found(tmp_path, "17", WITH_TIME, (SPIN, SLEEPS))
    assert {(each.clock, each.why_wall) for each in asleep.all} == {("wall", "sleeps")}
    assert {sleeper.thread for each in asleep.all for sleeper in each.sleepers} == {""}
    assert all(len(each.ticks) == 300 for each in asleep.all)
    drives = asleep.outcome("drives")
    assert drives["outcome"] == "pass"
    assert "the main thread of your node sleeps on the wall clock" in drives["measured"]


def test_who_computes_too_long_has_no_more_time_than_there_is(tmp_path: Path) -> None:
    """The budget of a room ends the drive in lockstep; real time tells what that is worth."""
    busy = found(tmp_path, "17", WITH_TIME, (SAYS, COMPUTES + SAYS))
    assert {(each.clock, each.why_wall) for each in busy.all} == {("wall", "over budget")}
    assert all("have computed for more than 30 s after" in each.told for each in busy.all)


def test_who_ends_in_a_room_is_told_with_its_last_words(tmp_path: Path) -> None:
    """No second drive, and no real time, is needed for that."""
    ended = found(tmp_path, "17", (SAYS, ENDS + SAYS))
    assert {each.clock for each in ended.all} == {"lockstep"}
    assert all(each.ended.endswith(f"in room {each.seed}") for each in ended.all)
    drives = ended.outcome("drives")
    assert (drives["outcome"], drives["fault"]) == ("fail", "EndsInARoom")
    assert any("ValueError: there is no quay" in line for line in drives["log"])


def test_each_of_a_class_drives_in_rooms_of_its_own(tmp_path: Path) -> None:
    """With --rooms each; a second command drives what was handed in since by the same secret."""
    hand_ins, book = tmp_path / "hand-ins", tmp_path / "grades"
    for name in ("anna", "ben"):
        shutil.copytree(SOLUTION, hand_ins / name / "pilotage")
    words = ["grade", "pilot", str(hand_ins), "--out", str(book), "--soak", "0"]
    first = graded([*words, "--rooms", "each"], book)
    assert first.keys() == {"anna", "ben"}
    assert first["anna"] != first["ben"]
    shutil.copytree(SOLUTION, hand_ins / "cleo/pilotage")
    second = graded(words, book)
    assert {name: second[name] for name in first} == first
    assert len({*second.values()}) == 3


def graded(words: list[str], book: Path) -> dict[str, tuple[int, ...]]:
    """The secret rooms that each hand-in has driven in; all of them have full marks."""
    environment = {**os.environ, "ROSLINGS_COURSE": str(COURSE)}
    environment.pop(SECRET, None)
    command = [sys.executable, "-m", "roslings", *words]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    with gradebook(book, "pilot") as kept:
        take_key(kept, book)
        return {name: secret_seeds(kept, result) for name, result in kept.latest().items()}


def secret_seeds(kept: Gradebook, result: GradingResult) -> tuple[int, ...]:
    """As the evidence has them."""
    assert result.verdict is not None
    assert result.verdict.score == 100
    content = kept.evidence(result)
    assert content is not None
    drives = unpacked(content).experiments["secret"].part(RoomsSeen).drives
    return tuple(drive.seed for drive in drives)
