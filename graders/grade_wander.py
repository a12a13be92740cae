"""What counts as done in the lab "wander": a rover that follows a wall in a room it has never seen.

The numbers, names and points stand in labs/wander/card.yaml. Experiments run the student's node;
in rooms it drives a rover, in lockstep. Checks read what was seen.
"""

from graders.wander.act import rooms_to_drive
from roslings.capabilities.parameters.act import list_parameters
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.parameters.demands import declare_its_parameters
from roslings.capabilities.rooms.act import drive_rooms
from roslings.capabilities.rooms.contract import RoomWords
from roslings.capabilities.rooms.demands import (
    cover,
    drive_each,
    follow_its_wall,
    stop_before_what_moves,
    touch_at_most,
)
from roslings.capabilities.rooms.drivers import NodeDriver
from roslings.course import lab
from roslings.course.files import written
from roslings.experiment import Scene, experiment
from roslings.judge import (
    ExperimentView,
    PackageView,
    be_built_as,
    be_named,
    be_the_only_one,
    be_there,
    carry_its_type,
    check,
    come_up,
    depends,
    end_within,
    exit_cleanly,
    install,
    match_qos,
    outlast_the_soak,
    stay_up,
    well_formed,
)

CARD = lab("wander").card
WANDER = CARD.node("wander")
SCAN, COMMAND = WANDER.subscribes[0], WANDER.publishes[0]
SIDE = WANDER.of(ParameterWords).parameter("side")
ROOMS = written(WANDER.of(RoomWords).rooms, WANDER.node)
WALL, STOPS = written(ROOMS.wall, WANDER.node), written(ROOMS.stops, WANDER.node)
COVERS_M = written(ROOMS.covers_m, WANDER.node)


# --- experiments -------------------------------------------------------------------------------


@experiment
def waiting(scene: Scene) -> None:
    """The node alone, where nothing says a scan."""
    with scene.run(WANDER):
        list_parameters(scene, WANDER)


@experiment
def rooms(scene: Scene) -> None:
    """The node drives in each room, with a wall on one side or the other."""
    drive_rooms(scene, NodeDriver(WANDER), rooms_to_drive(ROOMS, scene.seed), ROOMS)


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, with {WANDER.executable}."""
    package.must(be_built_as(CARD.build_type), install([WANDER.executable]))


# --- the node ----------------------------------------------------------------------------------


@check(needs=["builds"])
def test_runs(waiting: ExperimentView) -> None:
    """The node starts and runs until Ctrl-C."""
    waiting.process(WANDER).must(come_up, stay_up, outlast_the_soak)


@check(needs=["runs"])
def test_name(waiting: ExperimentView) -> None:
    """Its node is called {WANDER.node}."""
    waiting.node(WANDER).must(be_named)


@check(needs=["runs"])
def test_topics(waiting: ExperimentView) -> None:
    """It subscribes to {SCAN.topic}, as to a sensor, and publishes {COMMAND.topic}."""
    waiting.subscription(WANDER, SCAN).must(be_there, carry_its_type, match_qos)
    publisher = waiting.publisher(WANDER, COMMAND)
    publisher.must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["runs"])
def test_side(waiting: ExperimentView) -> None:
    """It has the parameter {SIDE.name}, with its type and its default."""
    waiting.must(declare_its_parameters(WANDER))


# --- the rooms ---------------------------------------------------------------------------------


@check(needs=["topics"])
def test_drives(rooms: ExperimentView) -> None:
    """It drives the rover in each room, to the end."""
    rooms.must(drive_each)


@check(needs=["drives"])
def test_touches(rooms: ExperimentView) -> None:
    """It touches nothing."""
    rooms.must(touch_at_most(0))


@check(needs=["drives"])
def test_covers(rooms: ExperimentView) -> None:
    """It goes {COVERS_M:g} m over new ground in each room."""
    rooms.must(cover(COVERS_M))


@check(needs=["drives", "side"])
def test_follows(rooms: ExperimentView) -> None:
    """It is {WALL.at_m:g} m from the wall; {WALL.side_parameter!r} says on which side."""
    rooms.must(follow_its_wall(WALL))


@check(needs=["drives"])
def test_stops(rooms: ExperimentView) -> None:
    """It stands {STOPS.from_m:g} m before what moves into its way."""
    rooms.must(stop_before_what_moves(STOPS))


# --- the end -----------------------------------------------------------------------------------


@check(needs=["runs"])
def test_ends(waiting: ExperimentView) -> None:
    """The node ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    waiting.process(WANDER).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(waiting: ExperimentView) -> None:
    """After Ctrl-C the node ends without an error."""
    waiting.process(WANDER).must(stay_up, exit_cleanly)
