"""What counts as done in the lab "black-box": a program that reads bags, and a diagnosis.

The lines, numbers and points stand in labs/black-box/card.yaml. Experiments give the student's
program bags that nobody could know; checks read what was seen and run nothing.
"""

from graders.black_box.act import Giver
from graders.black_box.contract import BagWords
from graders.black_box.demands import (
    be_of_its_own_rover,
    find,
    read_to_the_end,
    tell,
    tell_counts,
    tell_gaps,
    tell_no_bag,
    tell_no_drive,
    tell_rates,
)
from roslings.course import lab
from roslings.course.files import written
from roslings.experiment import Scene, experiment
from roslings.judge import (
    ExperimentView,
    PackageView,
    be_built_as,
    check,
    depends,
    install,
    well_formed,
)

CARD = lab("black-box").card
READER = written(CARD.of(BagWords).reads_bags, CARD.package)
DIAGNOSIS = written(CARD.of(BagWords).diagnosis, CARD.package)
(FILE,) = CARD.documents
FIRST, OTHER = READER.storages
SPLIT_AFTER_S = 4.0
"""The bag in the other storage begins a new file after so long."""


# --- experiments: give the program bags --------------------------------------------------------


@experiment
def reading(scene: Scene) -> None:
    """The program with a bag that was made a moment ago."""
    giver = Giver(scene, READER)
    giver.give("drive", giver.drive(), FIRST)


@experiment
def elsewhere(scene: Scene) -> None:
    """The program with a bag that is stored otherwise, in several files."""
    giver = Giver(scene, READER)
    giver.give("other", giver.drive(), OTHER, SPLIT_AFTER_S)


@experiment
def nothing(scene: Scene) -> None:
    """The program without a bag, and with one that tells of no drive."""
    giver = Giver(scene, READER)
    giver.give_none("missing")
    giver.give_empty("folder")
    giver.give_still("still")


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {READER.executable}."""
    package.must(be_built_as(CARD.build_type), install([READER.executable]))


# --- the program -------------------------------------------------------------------------------


@check(needs=["builds"])
def test_reads(reading: ExperimentView) -> None:
    """It reads a bag that nobody could know, and ends by itself."""
    reading.must(read_to_the_end(READER, "drive", "a bag"))


@check(needs=["reads"])
def test_duration(reading: ExperimentView) -> None:
    """It tells how many seconds the bag lasts."""
    reading.must(tell(READER, "drive", "duration", "seconds"))


@check(needs=["reads"])
def test_counts(reading: ExperimentView) -> None:
    """It tells each topic of the bag, and how many messages it has."""
    reading.must(tell_counts(READER, "drive"))


@check(needs=["counts"])
def test_rates(reading: ExperimentView) -> None:
    """It tells the usual rate of each topic, whatever gaps there are."""
    reading.must(tell_rates(READER, "drive"))


@check(needs=["reads"])
def test_gaps(reading: ExperimentView) -> None:
    """It tells each gap of more than {READER.gap_periods:g} periods, and no other time."""
    reading.must(tell_gaps(READER, "drive"))


@check(needs=["reads"])
def test_distance(reading: ExperimentView) -> None:
    """It tells how far the rover went."""
    reading.must(tell(READER, "drive", "distance", "metres"))


@check(needs=["reads"])
def test_top_speed(reading: ExperimentView) -> None:
    """It tells how fast the rover was at most, forward or backward."""
    reading.must(tell(READER, "drive", "top_speed", "speed"))


@check(needs=["counts"])
def test_other_storage(elsewhere: ExperimentView) -> None:
    """It also reads a bag of {OTHER}, in more than one file."""
    elsewhere.must(read_to_the_end(READER, "other", f"a bag of {OTHER}, in two files or more"))
    elsewhere.must(tell_counts(READER, "other"))


@check(needs=["reads"])
def test_no_bag(nothing: ExperimentView) -> None:
    """With no bag there, it says so: exit code {READER.no_bag.exit_code}."""
    nothing.must(*(tell_no_bag(READER, label) for label in ("missing", "folder")))


@check(needs=["reads"])
def test_no_drive(nothing: ExperimentView) -> None:
    """With no message on {READER.odometry}, too: exit code {READER.no_drive.exit_code}."""
    nothing.must(tell_no_drive(READER, "still"))


# --- the sick rover ----------------------------------------------------------------------------


@check()
def test_diagnosis(package: PackageView) -> None:
    """{FILE} can be read, and is about your own rover."""
    package.must(be_of_its_own_rover(FILE, DIAGNOSIS))


@check(needs=["diagnosis"])
def test_fault_1(package: PackageView) -> None:
    """A fault is named, with its topic and its number."""
    package.must(find(1, FILE, DIAGNOSIS))


@check(needs=["fault_1"])
def test_fault_2(package: PackageView) -> None:
    """At least two entries more are right than wrong."""
    package.must(find(2, FILE, DIAGNOSIS))


@check(needs=["fault_2"])
def test_fault_3(package: PackageView) -> None:
    """At least three entries more are right than wrong."""
    package.must(find(3, FILE, DIAGNOSIS))


@check(needs=["fault_3"])
def test_fault_4(package: PackageView) -> None:
    """At least four entries more are right than wrong."""
    package.must(find(4, FILE, DIAGNOSIS))


@check(needs=["fault_4"])
def test_fault_5(package: PackageView) -> None:
    """All {DIAGNOSIS.faults} faults are named, and nothing else."""
    package.must(find(DIAGNOSIS.faults, FILE, DIAGNOSIS))
