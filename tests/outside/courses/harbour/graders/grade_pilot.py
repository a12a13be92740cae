"""What counts as done in this lab: a rover that follows a quay through rooms nobody has seen."""

from roslings.capabilities.rooms.act import drive_rooms
from roslings.capabilities.rooms.contract import RoomWords
from roslings.capabilities.rooms.demands import (
    cover,
    drive_each,
    follow_its_wall,
    stop_before_what_moves,
    touch_at_most,
)
from roslings.capabilities.rooms.drivers import LaunchDriver, NodeDriver
from roslings.capabilities.rooms.seeds import own_rooms, secret_rooms
from roslings.course import lab, written
from roslings.experiment import Scene, experiment
from roslings.judge import (
    ExperimentView,
    PackageView,
    be_built_as,
    be_well_formed,
    check,
    come_up,
    end_within,
    exit_cleanly,
    install,
    list_what_it_imports,
    stay_up,
)

CARD = lab("pilot").card
PILOT = CARD.node("pilot")
ROOMS = written(PILOT.of(RoomWords).rooms, PILOT.node)
WALL, STOPS = written(ROOMS.wall, PILOT.node), written(ROOMS.stops, PILOT.node)
COVERS_M = written(ROOMS.covers_m, PILOT.node)
LAUNCHED = LaunchDriver(CARD.package, "launch/pilot.launch.py", [PILOT], side_argument="quay")


@experiment
def mooring(scene: Scene) -> None:
    """The node alone."""
    with scene.run(PILOT):
        pass


@experiment
def own(scene: Scene) -> None:
    """The node in rooms that the student has chosen."""
    drive_rooms(scene, NodeDriver(PILOT), own_rooms(ROOMS), ROOMS)


@experiment
def secret(scene: Scene) -> None:
    """The node in rooms that nobody has seen."""
    drive_rooms(scene, NodeDriver(PILOT), secret_rooms(ROOMS, scene.seed), ROOMS)


@experiment
def launched(scene: Scene) -> None:
    """The launch file, in one room."""
    drive_rooms(scene, LAUNCHED, own_rooms(ROOMS)[:1], ROOMS)


@check()
def test_well_formed(package: PackageView) -> None:
    """The package has all its files, and ROS and Python can read them."""
    package.must(be_well_formed(CARD.build_type), list_what_it_imports)


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {PILOT.executable}."""
    package.must(be_built_as(CARD.build_type), install([PILOT.executable]))


@check(needs=["builds"])
def test_runs(mooring: ExperimentView) -> None:
    """The node runs until Ctrl-C, and ends well within {CARD.ends_within_s:g} s."""
    mooring.process(PILOT).must(come_up, stay_up, end_within(CARD.ends_within_s), exit_cleanly)


@check(needs=["runs"])
def test_drives(own: ExperimentView) -> None:
    """It drives the rover in each room, to the end."""
    own.must(drive_each)


@check(needs=["drives"])
def test_touches(own: ExperimentView) -> None:
    """It touches nothing."""
    own.must(touch_at_most(0))


@check(needs=["drives"])
def test_covers(own: ExperimentView) -> None:
    """It goes {COVERS_M:g} m over new ground in each room."""
    own.must(cover(COVERS_M))


@check(needs=["drives"])
def test_follows(own: ExperimentView) -> None:
    """It is {WALL.at_m:g} m from a wall on the side that {WALL.side_parameter} says."""
    own.must(follow_its_wall(WALL))


@check(needs=["drives"])
def test_stops(own: ExperimentView) -> None:
    """It stops {STOPS.from_m:g} m before what moves into its way."""
    own.must(stop_before_what_moves(STOPS))


@check(needs=["drives"])
def test_unseen(secret: ExperimentView) -> None:
    """It does the same in rooms that nobody has seen."""
    secret.must(drive_each, touch_at_most(0), cover(COVERS_M), follow_its_wall(WALL))


@check(needs=["drives"])
def test_launches(launched: ExperimentView) -> None:
    """The launch file does it, too."""
    launched.must(drive_each, touch_at_most(0), follow_its_wall(WALL))
