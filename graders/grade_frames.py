"""What counts as done in the lab "frames": where a rover and its laser are, its walls, and a map.

The names, numbers and points stand in labs/frames/card.yaml. Experiments tell the student's node
of drives that nobody knows; checks read what it said of them, and run nothing.
"""

from collections.abc import Mapping

from graders.frames.act import FrameTopics, hearing, join_late, tell_of_a_drive
from graders.frames.contract import FramesWords
from graders.frames.demands import (
    answer_scans,
    be_a_grid,
    be_a_tree,
    be_latched,
    come_in_time,
    follow_the_odometry,
    have_a_point_for_each,
    hear_on,
    leave_the_unknown,
    lie_on_walls,
    say_each_once,
    say_nothing_unknown,
    say_where_the_laser_is,
    show_walls,
    show_what_is_free,
)
from graders.frames.drive import LaserMount
from roslings.capabilities.parameters.act import list_parameters
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.parameters.demands import declare_its_parameters
from roslings.course import lab
from roslings.course.files import written
from roslings.experiment import Scene, experiment
from roslings.experiment.start import Start
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
    have_just_this_qos,
    install,
    match_qos,
    outlast_the_soak,
    stay_up,
    well_formed,
)

CARD = lab("frames").card
FRAMES = CARD.node("frames")
ODOMETRY, SCAN = FRAMES.subscribes
TF_STATIC, TF, WALLS, MAP = FRAMES.publishes
ROADS = FrameTopics(ODOMETRY, SCAN, TF_STATIC, TF, WALLS, MAP)
LASER_X, LASER_Y, LASER_YAW = FRAMES.of(ParameterWords).named("laser_x", "laser_y", "laser_yaw")
TREE = written(FRAMES.of(FramesWords).frames, FRAMES.node)

# --- one mistake, one check --------------------------------------------------------------------

Faults = Mapping[str, str | tuple[str, ...]]
"""Another check's name to faults there."""

TOLD_WRONG: Faults = {
    "topics": (
        "NoTopic",
        "WrongTopic",
        "TwoPublishers",
        "WrongType",
        "QosCannotMatch",
        "NotThisQos",
    ),
    "parameters": ("NoParameter", "WrongParameterType", "WrongDefault"),
}
"""What may keep a node from being told of a drive, and us from hearing what it says of it."""

LASER_WRONG = ("StepMissing", "NoNumbers", "NoQuaternion", "LaserElsewhere")
BODY_WRONG = ("StepsMissing", "NoNumbers", "NoQuaternion", "BodyElsewhere")
WALLS_WRONG = ("OtherFrame", "NotTheScansStamp", "ScansUnanswered", "SaysTheUnknown")
STEPS_WRONG: Faults = {**TOLD_WRONG, "laser": LASER_WRONG, "body": BODY_WRONG}
"""Where a step is wrong, the points that are put through it lie elsewhere, and so does the map."""

POINTS_WRONG: Faults = {**STEPS_WRONG, "walls": WALLS_WRONG, "distances": "OtherCount"}
MAP_WRONG: Faults = {
    **POINTS_WRONG,
    "tree": ("StepMissing", "TwoParents"),
    "standing": "OffTheWalls",
    "turning": "OffTheWalls",
}
CELLS_WRONG: Faults = {**MAP_WRONG, "map_walls": ("WallsElsewhere", "WallsInTheAir")}


# --- experiments: tell the node of drives ------------------------------------------------------


@experiment
def waiting(scene: Scene) -> None:
    """The node alone, where nobody says odometry or scans; somebody comes late."""
    with hearing(scene, ROADS), scene.run(FRAMES):
        list_parameters(scene, FRAMES)
        join_late(scene, TF_STATIC)


@experiment
def middle(scene: Scene) -> None:
    """A drive with the laser where it is when nobody says anything."""
    mount = LaserMount(float(LASER_X.default), float(LASER_Y.default), float(LASER_YAW.default))
    with hearing(scene, ROADS) as heard, scene.run(FRAMES):
        tell_of_a_drive(scene, FRAMES, ROADS, TREE, mount, heard)


@experiment
def beside(scene: Scene) -> None:
    """A drive in another room, with the laser elsewhere on the rover, and turned."""
    told = {each.name: float(each.tried) for each in (LASER_X, LASER_Y, LASER_YAW)}
    with hearing(scene, ROADS) as heard, scene.run(FRAMES, start=Start(parameters=told)):
        tell_of_a_drive(scene, FRAMES, ROADS, TREE, LaserMount(*told.values()), heard)


@experiment
def anywhere(scene: Scene) -> None:
    """A drive in a third room, with the laser where nobody can know before."""
    mount = LaserMount(
        scene.between(-0.15, -0.05), scene.between(0.02, 0.1), scene.between(-2.9, -0.5)
    )
    names = (LASER_X.name, LASER_Y.name, LASER_YAW.name)
    told = dict(zip(names, (mount.x_m, mount.y_m, mount.yaw_rad), strict=True))
    with hearing(scene, ROADS) as heard, scene.run(FRAMES, start=Start(parameters=told)):
        tell_of_a_drive(scene, FRAMES, ROADS, TREE, mount, heard)


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, with {FRAMES.executable}."""
    package.must(be_built_as(CARD.build_type), install([FRAMES.executable]))


# --- the node ----------------------------------------------------------------------------------


@check(needs=["builds"])
def test_runs(waiting: ExperimentView) -> None:
    """The node starts and runs until Ctrl-C."""
    waiting.process(FRAMES).must(come_up, stay_up, outlast_the_soak)


@check(needs=["runs"])
def test_name(waiting: ExperimentView) -> None:
    """Its node is called {FRAMES.node}."""
    waiting.node(FRAMES).must(be_named)


@check(needs=["runs"])
def test_topics(waiting: ExperimentView) -> None:
    """It hears {ODOMETRY.topic} and {SCAN.topic}, and publishes all but the map."""
    for heard in (ODOMETRY, SCAN):
        waiting.subscription(FRAMES, heard).must(be_there, carry_its_type, match_qos)
    for said in (TF_STATIC, TF, WALLS):
        publisher = waiting.publisher(FRAMES, said)
        publisher.must(be_there, be_the_only_one, carry_its_type, match_qos)
    waiting.publisher(FRAMES, TF_STATIC).must(have_just_this_qos)


@check(needs=["runs"])
def test_parameters(waiting: ExperimentView) -> None:
    """It has the parameters {LASER_X.name}, {LASER_Y.name} and {LASER_YAW.name}."""
    waiting.must(declare_its_parameters(FRAMES))


# --- the tree ----------------------------------------------------------------------------------


@check(needs=["runs"], explained_by=TOLD_WRONG)
def test_laser(middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView) -> None:
    """{TREE.body} to {TREE.laser} is what the parameters say."""
    for drive in (middle, beside, anywhere):
        drive.must(say_where_the_laser_is(TF_STATIC, TREE))


@check(needs=["runs"], explained_by={**TOLD_WRONG, "laser": "StepMissing"})
def test_latched(waiting: ExperimentView) -> None:
    """Who comes late gets it, too."""
    waiting.must(be_latched(TF_STATIC, TREE))


@check(needs=["runs"], explained_by=TOLD_WRONG)
def test_drives(middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView) -> None:
    """It runs on and hears on, whatever is not known yet."""
    for drive in (middle, beside, anywhere):
        drive.process(FRAMES).must(stay_up)
        drive.must(hear_on)


@check(needs=["drives"], explained_by={**TOLD_WRONG, "laser": "StepMissing"})
def test_tree(middle: ExperimentView, beside: ExperimentView) -> None:
    """{TREE.odometry} to {TREE.body} is there, and each frame has one parent."""
    for drive in (middle, beside):
        drive.must(be_a_tree(TF, TREE))


@check(needs=["tree"], explained_by=TOLD_WRONG)
def test_body(middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView) -> None:
    """Each odometry is told on {TF.topic}, with its stamp and its place."""
    for drive in (middle, beside, anywhere):
        drive.must(follow_the_odometry(TF, TREE))


# --- the walls ---------------------------------------------------------------------------------


@check(needs=["tree"], explained_by=STEPS_WRONG)
def test_walls(middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView) -> None:
    """{WALLS.topic} has points for most scans, with their stamps; none where nothing is known."""
    for drive in (middle, beside, anywhere):
        drive.must(answer_scans(WALLS, TREE), say_nothing_unknown(WALLS, "before"))


@check(needs=["walls"])
def test_once(middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView) -> None:
    """Each odometry has one step on {TF.topic}, and each scan one message on {WALLS.topic}."""
    for drive in (middle, beside, anywhere):
        drive.must(say_each_once(TF, WALLS))


@check(needs=["tree"], explained_by={**STEPS_WRONG, "walls": WALLS_WRONG})
def test_distances(
    middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView
) -> None:
    """There is a point for each distance of a scan, and for nothing else."""
    for drive in (middle, beside, anywhere):
        drive.must(have_a_point_for_each(WALLS))


@check(needs=["tree"], explained_by=POINTS_WRONG)
def test_standing(middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView) -> None:
    """While the rover stands, the points are on walls."""
    for drive in (middle, beside, anywhere):
        drive.must(lie_on_walls(TREE, "standing"))


@check(needs=["standing"], explained_by=POINTS_WRONG)
def test_turning(middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView) -> None:
    """While it drives and turns, too: each scan is at the place of its own time."""
    for drive in (middle, beside, anywhere):
        drive.must(lie_on_walls(TREE, "moving"), say_nothing_unknown(WALLS, "after"))


# --- the map -----------------------------------------------------------------------------------


@check(needs=["drives"], explained_by=TOLD_WRONG)
def test_map_topic(waiting: ExperimentView, middle: ExperimentView) -> None:
    """It publishes {MAP.type} on {MAP.topic}, and who comes late gets the last one."""
    waiting.publisher(FRAMES, MAP).must(
        be_there, be_the_only_one, carry_its_type, have_just_this_qos
    )
    middle.must(come_in_time(MAP))


@check(needs=["map_topic"])
def test_map_cells(middle: ExperimentView, beside: ExperimentView) -> None:
    """The map is in {TREE.odometry}, and its cells are {TREE.map.cell_m:g} m wide."""
    for drive in (middle, beside):
        drive.must(be_a_grid(MAP, TREE))


@check(needs=["map_cells"], explained_by=MAP_WRONG)
def test_map_walls(
    middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView
) -> None:
    """Cells with points on walls are 100, and no others."""
    for drive in (middle, beside, anywhere):
        drive.must(show_walls(TREE))


@check(needs=["map_cells"], explained_by=CELLS_WRONG)
def test_map_free(middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView) -> None:
    """Cells on the way to walls are 0."""
    for drive in (middle, beside, anywhere):
        drive.must(show_what_is_free(TREE))


@check(needs=["map_free"], explained_by=CELLS_WRONG)
def test_map_unknown(
    middle: ExperimentView, beside: ExperimentView, anywhere: ExperimentView
) -> None:
    """Cells of which nothing is known are -1."""
    for drive in (middle, beside, anywhere):
        drive.must(leave_the_unknown(TREE))


# --- the end -----------------------------------------------------------------------------------


@check(needs=["runs"])
def test_ends(waiting: ExperimentView) -> None:
    """The node ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    waiting.process(FRAMES).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(waiting: ExperimentView) -> None:
    """After Ctrl-C the node ends without an error."""
    waiting.process(FRAMES).must(stay_up, exit_cleanly)
