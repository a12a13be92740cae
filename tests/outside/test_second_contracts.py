"""What is a concept of ROS works by a contract of others, with other names, types and numbers.

Each course of `courses/` has a lab whose solution has all points, and wrong packages that lose
those of the checks that say so.
"""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass
from pathlib import Path

import pytest
from from_outside import CONFORMS, run

from until_told import Checked, checked

COURSES = Path(__file__).with_name("courses")


@dataclass(frozen=True)
class Wrong:
    """The solution with one thing wrong, and the checks that must fail."""

    name: str
    file: str
    find: str
    replace: str
    fails: tuple[str, ...]


@dataclass(frozen=True)
class Contract:
    """A lab of another course."""

    course: str
    lab: str
    package: str
    wrong: tuple[Wrong, ...]

    @property
    def environment(self) -> dict[str, str]:
        """Of a command that uses the course."""
        return {**os.environ, "ROSLINGS_COURSE": str(COURSES / self.course)}

    def check(self, package: Path, folder: Path) -> Checked:
        """What comes of it."""
        return checked(self.lab, package, folder=folder, env=self.environment)

    def copy(self, folder: Path) -> Path:
        """Of the solution."""
        solution = COURSES / self.course / "labs" / self.lab / "solution" / self.package
        return shutil.copytree(solution, folder / self.package)


CODE = "harbour/almanac.py"
ALMANAC = Contract(
    "harbour",
    "almanac",
    "harbour",
    (
        Wrong("one_kept", CODE, "depth=3", "depth=1", ("kept",)),
        Wrong("old_tide_last", CODE, "in TIDES_CM:", "in reversed(TIDES_CM):", ("kept",)),
        Wrong(
            "lives_by_itself",
            CODE,
            "LivelinessPolicy.MANUAL_BY_TOPIC",
            "LivelinessPolicy.AUTOMATIC",
            ("asks",),
        ),
        Wrong(
            "no_lease",
            CODE,
            "            liveliness_lease_duration=Duration(seconds=2.5),\n",
            "",
            ("offers",),
        ),
        Wrong("warns_of_each_breeze", CODE, "> 20.0", "> 10.0", ("warns",)),
    ),
)
LIGHTS = "lights/lighthouse.py"
LIGHTHOUSE = Contract(
    "harbour",
    "lighthouse",
    "lights",
    (
        Wrong(
            "deaf_to_what_is_set",
            LIGHTS,
            "        self.destroy_timer(self.timer)\n        self.timer = self.new_timer()\n",
            "        pass\n",
            ("follows",),
        ),
        Wrong("takes_too_many", LIGHTS, "to_value=20", "to_value=200", ("refuses",)),
        Wrong("changes_its_colour", LIGHTS, "read_only=True", "read_only=False", ("colour",)),
        Wrong("five_at_first", LIGHTS, "'flashes', 4,", "'flashes', 5,", ("parameters",)),
    ),
)
SEA = "masthead/lookout.py"
LOOKOUT = Contract(
    "harbour",
    "lookout",
    "masthead",
    (
        Wrong(
            "blue_first",
            SEA,
            "        seen[0::3], seen[2::3] = seen[2::3], seen[0::3]\n",
            "",
            ("picture",),
        ),
        Wrong("one_level_a_point", SEA, "LEVELS = 3", "LEVELS = 1", ("light",)),
        Wrong("light_of_any_number", SEA, "to_value=40", "to_value=400", ("refuses",)),
        Wrong(
            "says_nothing_when_blind",
            SEA,
            "            except OSError as error:\n"
            "                self.get_logger().error(f'Blind: {error}')\n",
            "            except OSError:\n                pass\n",
            ("troubles",),
        ),
    ),
)
QUAY = "pilotage/pilot.py"
PILOT = Contract(
    "harbour",
    "pilot",
    "pilotage",
    (
        Wrong(
            "asks_for_reliable_scans",
            QUAY,
            "look, qos_profile_sensor_data",
            "look, 10",
            ("drives",),
        ),
    ),
)
CONTRACTS = (ALMANAC, LIGHTHOUSE, LOOKOUT, PILOT)
WRONG = [(each, wrong) for each in CONTRACTS for wrong in each.wrong]


def test_what_lies_beside_a_grader_conforms() -> None:
    """As capabilities of roslings."""
    package = f"graders.{ALMANAC.lab}"
    assert "13 hold" in run(ALMANAC.environment, "-c", CONFORMS.format(package=package))


@pytest.mark.parametrize("contract", CONTRACTS, ids=lambda each: each.lab)
def test_its_task_says_what_its_card_says(contract: Contract) -> None:
    """Words of the engine, and those of its own."""
    assert "unchanged" in run(contract.environment, "-m", "roslings.course.task", contract.lab)


@pytest.mark.slow
@pytest.mark.parametrize("contract", CONTRACTS, ids=lambda each: each.lab)
def test_its_solution_has_all_points(contract: Contract, tmp_path: Path) -> None:
    """Live."""
    found = contract.check(contract.copy(tmp_path), tmp_path)
    assert found.verdict["score"] == 100, found.ran.stdout


@pytest.mark.slow
@pytest.mark.parametrize(("contract", "wrong"), WRONG, ids=lambda each: getattr(each, "name", ""))
def test_a_wrong_package_fails_where_it_says(
    contract: Contract, wrong: Wrong, tmp_path: Path
) -> None:
    """There, and nowhere else."""
    package = contract.copy(tmp_path)
    code = package / wrong.file
    text = code.read_text("utf-8")
    assert text.count(wrong.find) == 1
    code.write_text(text.replace(wrong.find, wrong.replace), "utf-8")
    assert contract.check(package, tmp_path).outcomes("fail") == [*wrong.fails]
