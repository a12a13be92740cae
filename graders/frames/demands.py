"""Demands on frames, on points on walls, and on a map.

All is judged by stamps, and whoever tells a drive waits for the node. So a busy computer bends none
of it.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence

from graders.frames import faults
from graders.frames.contract import TreeContract
from graders.frames.reasons import NoDriveTold, NotSeenToHear
from graders.frames.record import (
    HEARS_ON,
    BodySeen,
    FramesDriveSeen,
    FramesSeen,
    MapSeen,
    Part,
    Source,
    StepSeen,
    WallsSeen,
)
from roslings.course import TopicContract
from roslings.judge.demands import require_its_time
from roslings.judge.faults.moments import Awaited
from roslings.judge.views import Demand, ExperimentView

NEAR_M, NEAR_RAD = 0.001, 0.001
LENGTH_OFF = 0.001
MOST_LOST = 0.05
"""So many messages of a drive may find no answer, whatever the reason is."""

MOST_BESIDE: dict[faults.MovingPart, float] = {"standing": 0.25, "moving": 0.1}
"""So many scans of a part may be off. The first one after a turn counts as standing. Who takes it a
little too early is told so by the part in which the rover moves."""

KNOWN: tuple[Part, ...] = ("standing", "moving")
VALUES = {-1, 0, 100}


def _drive(experiment: ExperimentView) -> FramesDriveSeen:
    """Raises NothingToJudge where the node was not told of one, for it ended.

    One that runs on and is not seen to hear raises Inconclusive. If it has no such subscription at
    all, the check of its topics says so.
    """
    drive = experiment.seen.part(FramesSeen).drive
    if drive is not None and drive.heard:
        return drive
    for process in experiment.seen.processes.values():
        if not process.ended_by_itself:
            raise NotSeenToHear(process.executable)
    raise NoDriveTold("not_told")


# --- the tree ----------------------------------------------------------------------------------


def say_where_the_laser_is(topic: TopicContract, tree: TreeContract) -> Demand[ExperimentView]:
    """The step from the rover to its laser is what the parameters say.

    >>> moved.must(say_where_the_laser_is(TF_STATIC, TREE))
    """
    wanted = faults.TreeStep(tree.body, tree.laser)

    def demand(experiment: ExperimentView) -> None:
        drive = _drive(experiment)
        step = _step(experiment, topic, wanted, ("tf_static",))
        _require_numbers(step, wanted)
        off_m = math.hypot(step.x_m - drive.laser_x_m, step.y_m - drive.laser_y_m)
        off_rad = _apart_rad(step.yaw_rad, drive.laser_yaw_rad)
        if off_m > NEAR_M or off_rad > NEAR_RAD or step.tilted:
            place = (drive.laser_x_m, drive.laser_y_m, drive.laser_yaw_rad)
            slip = "place" if off_m > NEAR_M else _turn_slip(step.yaw_rad, drive.laser_yaw_rad)
            told = _numbers(step.x_m, step.y_m, step.yaw_rad)
            raise faults.LaserElsewhere(wanted, _numbers(*place), told, slip)

    return demand


def _apart_rad(one: float, two: float) -> float:
    return abs(math.remainder(one - two, math.tau))


def _numbers(x_m: float, y_m: float, yaw_rad: float) -> tuple[str, ...]:
    return f"x {x_m:.3f} m", f"y {y_m:.3f} m", f"yaw {yaw_rad:.3f} rad"


def _turn_slip(found: float, wanted: float) -> faults.LaserSlip:
    guesses: dict[faults.LaserSlip, Sequence[float]] = {
        "no_turn": (0.0,),
        "other_way": (-wanted,),
        "degrees": (math.degrees(wanted),),
        "half": (wanted / 2, wanted * 2),
    }
    for slip, turns in guesses.items():
        if any(_apart_rad(found, turn) <= NEAR_RAD for turn in turns):
            return slip
    return "turn"


def _require_numbers(step: StepSeen | BodySeen, wanted: faults.TreeStep) -> None:
    if not step.is_finite:
        raise faults.NoNumbers(wanted)
    if abs(step.length - 1.0) > LENGTH_OFF:
        raise faults.NoQuaternion(wanted, step.length)


def _step(
    experiment: ExperimentView,
    topic: TopicContract,
    wanted: faults.TreeStep,
    sources: Sequence[Source],
) -> StepSeen:
    """The last step of these two frames. Raises StepMissing."""
    told = [each for each in experiment.seen.part(FramesSeen).steps if each.source in sources]
    for step in reversed(told):
        if (step.parent, step.child) == (wanted.parent, wanted.child):
            return step
    found = tuple(dict.fromkeys(faults.TreeStep(each.parent, each.child) for each in told))
    raise faults.StepMissing(topic.topic, wanted, found or (faults.Nowhere(),), _slip(told, wanted))


def _slip(told: Sequence[StepSeen], wanted: faults.TreeStep) -> faults.StepSlip:
    pairs = {(each.parent, each.child) for each in told}
    if (wanted.child, wanted.parent) in pairs:
        return "swapped"
    bare = {tuple(name.lstrip("/") for name in pair) for pair in pairs}
    return "slash" if (wanted.parent, wanted.child) in bare else "none"


def be_latched(topic: TopicContract, tree: TreeContract) -> Demand[ExperimentView]:
    """Who comes late gets the step to the laser, before any odometry came."""
    wanted = faults.TreeStep(tree.body, tree.laser)

    def demand(experiment: ExperimentView) -> None:
        told = experiment.seen.part(FramesSeen).steps
        late = {(each.parent, each.child) for each in told if each.source == "late"}
        if (wanted.parent, wanted.child) not in late:
            raise faults.NothingLatched(topic.topic, wanted)

    return demand


def hear_on(experiment: ExperimentView) -> None:
    """No callback holds the node up."""
    if limit_s := _drive(experiment).blocked_s:
        require_its_time(experiment.seen, HEARS_ON, limit_s, Awaited("node_answer"))
        raise faults.Blocked(limit_s)


def be_a_tree(topic: TopicContract, tree: TreeContract) -> Demand[ExperimentView]:
    """The step to the rover is there, and each frame has one parent."""
    wanted = faults.TreeStep(tree.odometry, tree.body)

    def demand(experiment: ExperimentView) -> None:
        _drive(experiment)
        _step(experiment, topic, wanted, ("tf",))
        parents = defaultdict[str, dict[str, None]](dict)
        for step in experiment.seen.part(FramesSeen).steps:
            parents[step.child][step.parent] = None
        for child, found in parents.items():
            if len(found) > 1:
                raise faults.TwoParents(child, tuple(found))

    return demand


def follow_the_odometry(topic: TopicContract, tree: TreeContract) -> Demand[ExperimentView]:
    """Each odometry is told as a step, with its stamp and its place."""
    wanted = faults.TreeStep(tree.odometry, tree.body)

    def demand(experiment: ExperimentView) -> None:
        drive = _drive(experiment)
        body = [each for each in drive.body if each.child == tree.body]
        own = [each for each in body if each.stamp == "own"]
        if drive.told < (1 - MOST_LOST) * drive.odometry:
            raise faults.StepsMissing(
                topic.topic, wanted, drive.odometry, drive.told, _other_stamp(drive)
            )
        for each in own:
            _require_numbers(each, wanted)
        off_m, off_rad = max(each.off_m for each in own), max(each.off_rad for each in own)
        if off_m > NEAR_M or off_rad > NEAR_RAD:
            slip: faults.BodySlip = "place" if off_m > NEAR_M else "turn"
            raise faults.BodyElsewhere(wanted, off_m, off_rad, slip)

    return demand


def _other_stamp(drive: FramesDriveSeen) -> faults.OtherStamp:
    stamps = {each.stamp for each in drive.body}
    return "zero" if "zero" in stamps else "now" if "other" in stamps else "none"


# --- walls -------------------------------------------------------------------------------------


def answer_scans(topic: TopicContract, tree: TreeContract) -> Demand[ExperimentView]:
    """Points in the fixed frame, with the stamps of scans, for most of those that can be placed."""

    def demand(experiment: ExperimentView) -> None:
        drive = _drive(experiment)
        for each in drive.walls:
            if each.frame != tree.odometry:
                raise faults.OtherFrame(topic.topic, tree.odometry, each.frame)
            if each.stamp != "own":
                raise faults.NotTheScansStamp(topic.topic, each.stamp == "zero")
        scans = [scan for scan in drive.scans if scan.part in KNOWN]
        answered = sum(scan.answers > 0 for scan in scans)
        wanted = math.ceil(tree.walls.answered * len(scans))
        if answered < wanted:
            raise faults.ScansUnanswered(topic.topic, wanted, answered, len(scans))

    return demand


def say_each_once(tf: TopicContract, walls: TopicContract) -> Demand[ExperimentView]:
    """No step and no points with a stamp that they had already, and no message without a step."""

    def demand(experiment: ExperimentView) -> None:
        drive = _drive(experiment)
        # The evidence keeps how many steps a message has: see SIZES.
        if empty := sum(each.content == 0 for each in experiment.topic(tf).messages):
            raise faults.StepsAreNone(tf.topic, empty)
        again = sum(max(0, scan.answers - 1) for scan in drive.scans)
        if drive.told_again:
            raise faults.ToldAgain(tf.topic, "odometry", drive.told_again)
        if again:
            raise faults.ToldAgain(walls.topic, "scan", again)

    return demand


def have_a_point_for_each(topic: TopicContract) -> Demand[ExperimentView]:
    """As many points as a scan has distances, and all of them numbers."""

    def demand(experiment: ExperimentView) -> None:
        drive = _drive(experiment)
        for scan, walls in _answers(drive, KNOWN):
            if walls.points != scan or walls.endless:
                raise faults.OtherCount(topic.topic, scan, walls.points, walls.endless)

    return demand


def _answers(drive: FramesDriveSeen, parts: Sequence[Part]) -> list[tuple[int, WallsSeen]]:
    """How many distances the scan had, and the points that were said of it."""
    found = [each for each in drive.walls if each.stamp == "own" and each.part in parts]
    if not found:
        raise NoDriveTold("no_walls")
    return [(each.distances, each) for each in found]


def lie_on_walls(tree: TreeContract, part: faults.MovingPart) -> Demand[ExperimentView]:
    """In this part of the drive, the points of nearly every scan lie on walls."""
    limit_m = tree.walls.off_m

    def demand(experiment: ExperimentView) -> None:
        said = [each for _, each in _answers(_drive(experiment), (part,))]
        beside = [each for each in said if each.off_m > limit_m]
        if len(beside) > MOST_BESIDE[part] * len(said):
            names = [each.like for each in beside]
            worst = max(each.off_m for each in beside)
            likely = max(set(names), key=names.count)
            raise faults.OffTheWalls(part, limit_m, worst, likely)

    return demand


def say_nothing_unknown(topic: TopicContract, part: faults.UnknownPart) -> Demand[ExperimentView]:
    """Of this part of the drive nobody can know where the rover was: there are no points."""

    def demand(experiment: ExperimentView) -> None:
        walls = _drive(experiment).walls
        said = [each for each in walls if each.stamp == "own" and each.part == part and each.points]
        if said:
            raise faults.SaysTheUnknown(topic.topic, part, len(said))

    return demand


# --- the map -----------------------------------------------------------------------------------


def _map(experiment: ExperimentView) -> MapSeen:
    """Raises NothingToJudge where none came."""
    found = _drive(experiment).map
    if found is None:
        raise NoDriveTold("no_map")
    return found


def come_in_time(topic: TopicContract) -> Demand[ExperimentView]:
    """A map came."""

    def demand(experiment: ExperimentView) -> None:
        if _drive(experiment).map is None:
            raise faults.NoMap(topic.topic)

    return demand


def be_a_grid(topic: TopicContract, tree: TreeContract) -> Demand[ExperimentView]:
    """Its frame, the size and the number of its cells, and what a cell says."""

    def demand(experiment: ExperimentView) -> None:
        seen = _map(experiment)
        if seen.frame != tree.odometry:
            raise faults.OtherFrame(topic.topic, tree.odometry, seen.frame)
        if abs(seen.cell_m - tree.map.cell_m) > NEAR_M:
            raise faults.BadGrid("cell", f"{tree.map.cell_m:g}", f"{seen.cell_m:g}")
        if seen.cells != seen.width * seen.height:
            raise faults.BadGrid("count", f"{seen.width * seen.height}", f"{seen.cells}")
        _require_level(seen)
        if others := set(seen.values) - VALUES:
            raise faults.BadGrid("values", "-1, 0 or 100", ", ".join(map(str, sorted(others))))

    return demand


def _require_level(seen: MapSeen) -> None:
    """Its corner lies on the floor, and it is not turned."""
    if not seen.is_finite:
        raise faults.BadGrid("numbers", "", "")
    if abs(seen.length - 1.0) > LENGTH_OFF:
        raise faults.BadGrid("rotation", "1", f"{seen.length:.3f}")
    if seen.tilted or abs(seen.yaw_rad) > NEAR_RAD:
        raise faults.BadGrid("tilted" if seen.tilted else "turned", "0", f"{seen.yaw_rad:.3f}")
    if abs(seen.z_m) > NEAR_M:
        raise faults.BadGrid("height", "0", f"{seen.z_m:g}")


def show_walls(tree: TreeContract) -> Demand[ExperimentView]:
    """Cells with points on walls are 100, and no others."""
    wanted = tree.map.right

    def demand(experiment: ExperimentView) -> None:
        seen = _map(experiment)
        if seen.walls < wanted:
            raise faults.WallsElsewhere(wanted, seen.walls, seen.like)
        if seen.true_walls < wanted:
            raise faults.WallsInTheAir(wanted, seen.true_walls)

    return demand


def show_what_is_free(tree: TreeContract) -> Demand[ExperimentView]:
    """Cells on the way to walls are 0."""

    def demand(experiment: ExperimentView) -> None:
        if (found := _map(experiment).free) < tree.map.right:
            raise faults.CellsWrong("free", tree.map.right, found)

    return demand


def leave_the_unknown(tree: TreeContract) -> Demand[ExperimentView]:
    """Cells that no beam came near are -1."""

    def demand(experiment: ExperimentView) -> None:
        if (found := _map(experiment).unknown) < tree.map.right:
            raise faults.CellsWrong("unknown", tree.map.right, found)

    return demand
