"""What can be wrong with frames, with points on walls, and with a map, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from graders.frames.record import MapSlip, WayWrong
from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import SentencePart, one_of, plural

StepSlip = Literal["swapped", "slash", "none"]
LaserSlip = Literal["degrees", "no_turn", "other_way", "half", "place", "turn"]
BodySlip = Literal["turn", "place"]
OtherStamp = Literal["zero", "now", "none"]
MovingPart = Literal["standing", "moving"]
UnknownPart = Literal["before", "after"]


@dataclass(frozen=True)
class TreeStep(SentencePart):
    """One step of the tree."""

    parent: str
    child: str
    text = "{parent} -> {child}"


@dataclass(frozen=True)
class Nowhere(SentencePart):
    """No step at all."""

    text = "none"


# --- the tree ----------------------------------------------------------------------------------


@dataclass(eq=False)
class StepMissing(Fault):
    """A step of the tree is told by nobody."""

    topic: str
    step: TreeStep
    found: tuple[TreeStep | Nowhere, ...]
    slip: StepSlip
    why = "A chain of steps leads from the walls to the room. Where one is missing, none is there."
    expected = "{topic} says the step {step}: the parent in header.frame_id, the child behind it"
    measured = "it says: {found}"
    hint = one_of(
        swapped="Parent and child are swapped: which of the two carries the other one?",
        slash="The name of a frame has no slash in front: it is no topic.",
        none="Compare the names of both frames with the card, letter by letter.",
    )
    mend = one_of(
        swapped="header.frame_id is the parent, and child_frame_id is what sits on it.",
        slash="Write the name without the slash.",
        none="The header.frame_id is '{parent}', and the child_frame_id is '{child}'.",
    )

    @property
    def parent(self) -> str:
        """Of the step."""
        return self.step.parent

    @property
    def child(self) -> str:
        """Of the step."""
        return self.step.child

    @property
    def which_hint(self) -> str:
        """The likely slip."""
        return self.slip

    which_mend = which_hint


@dataclass(eq=False)
class TwoParents(Fault):
    """A frame has more than one parent."""

    child: str
    parents: tuple[str, ...]
    was_seen = True
    why = "A frame with two parents is at two places: who looks it up gets now one, now the other."
    expected = "the frame {child} has one parent"
    measured = "it has several: {parents}"
    hint = "Which two places of your code say where this frame is?"


@dataclass(eq=False)
class NoQuaternion(Fault):
    """Four numbers that are no rotation."""

    step: TreeStep
    length: float
    was_seen = True
    why = "A rotation is told by four numbers whose squares add up to 1. Others mean nothing."
    expected = "the rotation of {step} has the length 1"
    measured = "its length is {length:.3f}"
    hint = "A yaw is an angle. It does not stand in rotation.z as it is: see day 6."
    mend = "rotation.z = math.sin(yaw / 2), rotation.w = math.cos(yaw / 2)"


@dataclass(eq=False)
class NoNumbers(Fault):
    """Some of a step's numbers are inf or NaN."""

    step: TreeStep
    was_seen = True
    why = "Who looks up a frame counts with these numbers. Nothing comes out of inf and NaN."
    expected = "each number of {step} is finite"
    measured = "one is inf or NaN"
    hint = "Which of these numbers is set by your code? Print them."


@dataclass(eq=False)
class LaserElsewhere(Fault):
    """The laser is not where the parameters say."""

    step: TreeStep
    wanted: tuple[str, ...]
    found: tuple[str, ...]
    slip: LaserSlip
    was_seen = True
    why = "Each point on a wall goes through this step. Where it is wrong, all of them are."
    expected = "{step} with {wanted}, as the parameters say"
    measured = "{found}"
    hint = one_of(
        degrees="sin and cos got degrees here. In which unit are angles in ROS?",
        no_turn="The turn is missing: what becomes of laser_yaw in your code?",
        other_way="The sign of the turn is the wrong one. Which way round is positive?",
        half="The turn is half or twice as large: look at both lines of the rotation.",
        place="What becomes of laser_x and laser_y? Look at each line with translation.",
        turn="Look at both lines with the rotation: the z and the w of a yaw.",
    )

    @property
    def which_hint(self) -> str:
        """The likely slip."""
        return self.slip


@dataclass(eq=False)
class NothingLatched(Fault):
    """Who comes late hears nothing of the laser."""

    topic: str
    step: TreeStep
    why = "The laser never moves, so its place is said once. RViz may be started an hour later."
    expected = "who subscribes late to {topic} gets {step}, also before any odometry came"
    measured = "nothing came"
    hint = "When does your node say it for the first time? What does it wait for?"
    mend = "Say it once in __init__, by a StaticTransformBroadcaster that the node keeps."


@dataclass(eq=False)
class Blocked(Fault):
    """A callback waits."""

    seconds: float
    why = "A node runs one callback at a time. While one waits, it hears nothing, /tf neither."
    expected = "after each scan the node hears on within {seconds:g} s"
    measured = "a callback took longer"
    hint = "Is there a timeout in your look-up, a sleep, or a loop that waits?"
    mend = "Look up without a timeout. What is not known yet is tried again at the next message."


@dataclass(eq=False)
class StepsMissing(Fault):
    """Not every odometry leads to a step."""

    topic: str
    step: TreeStep
    wanted: int
    found: int
    other: OtherStamp
    why = "A step holds for one moment. Who looks up that moment needs its stamp."
    expected = "for each of {wanted} messages of odometry, {step} on {topic} with its stamp"
    measured = one_of(
        zero="{found} have one; others have no stamp at all",
        now="{found} have one; others have another time",
        none="{found} have one",
    )
    hint = one_of(
        zero="What stands in header.stamp of your step?",
        now="Which time stands in header.stamp of your step? The rover was there at another one.",
        none="How often is a step sent, and by which function?",
    )
    mend = "In the callback of the odometry: step.header.stamp = odometry.header.stamp"

    @property
    def which_measured(self) -> str:
        """What the stamps are."""
        return self.other

    which_hint = which_measured


@dataclass(eq=False)
class BodyElsewhere(Fault):
    """The rover is said to be elsewhere."""

    step: TreeStep
    off_m: float
    off_rad: float
    slip: BodySlip
    was_seen = True
    why = "The odometry says where the rover is. The step says the same, in another form."
    expected = "{step} is at the place that the odometry of its stamp says"
    measured = "it is {off_m:.3f} m and {off_rad:.3f} rad off"
    hint = one_of(
        turn="The place is right, the turn is not. What becomes of the orientation?",
        place="Compare translation.x and translation.y with the position of the odometry.",
    )

    @property
    def which_hint(self) -> str:
        """The likely slip."""
        return self.slip


# --- walls -------------------------------------------------------------------------------------


@dataclass(eq=False)
class OtherFrame(Fault):
    """Points or cells are said to be in another frame."""

    topic: str
    wanted: str
    found: str
    was_seen = True
    why = "Numbers mean something only in the frame that the header names."
    expected = "header.frame_id of {topic} is {wanted}"
    measured = "it is '{found}'"
    hint = "In which frame are the numbers that you publish?"


@dataclass(eq=False)
class NotTheScansStamp(Fault):
    """Points carry a time at which there was no scan."""

    topic: str
    zero: bool
    was_seen = True
    why = (
        "The points are what the laser saw at the time of the scan. Another time is another place."
    )
    expected = "header.stamp of {topic} is that of a scan"
    measured = one_of(zero="there is no stamp: it is 0", other="no scan has this time")
    hint = "Which time stands in the header of your points?"
    mend = "walls.header.stamp = scan.header.stamp"

    @property
    def which_measured(self) -> str:
        """What it is."""
        return "zero" if self.zero else "other"


@dataclass(eq=False)
class ScansUnanswered(Fault):
    """Too few scans lead to points."""

    topic: str
    wanted: int
    found: int
    scans: int
    why = "A map with holes is no map. The place of a scan is known a moment after the scan came."
    expected = "points on {topic} for at least {wanted} of {scans} scans"
    measured = plural("found", one="for {found} scan", other="for {found} scans")
    hint = (
        "Log what the look-up says. A scan may come before the odometry of its time: what does your"
        " node do with it then?"
    )
    mend = (
        "Keep a scan whose time is not known yet, and try again when the next message has come."
        " Catch TransformException."
    )


@dataclass(eq=False)
class ToldAgain(Fault):
    """The same step, or the points of the same scan, came more than once."""

    topic: str
    of: Literal["odometry", "scan"]
    count: int
    was_seen = True
    why = "Who hears the same again does the same work again. tf2 warns of each such step."
    expected = one_of(
        odometry="one step on {topic} for each odometry",
        scan="one message on {topic} for each scan",
    )
    measured = plural(
        "count",
        one="{count} had a stamp that was told already",
        other="{count} had a stamp that was told already",
    )
    hint = "From how many places of your code is it published, and what calls them?"

    @property
    def which_expected(self) -> str:
        """What it is said of."""
        return self.of


@dataclass(eq=False)
class StepsAreNone(Fault):
    """A message of steps holds none."""

    topic: str
    count: int
    was_seen = True
    why = "Everybody who hears it takes each message, and looks for a step in it."
    expected = "each message on {topic} has a step"
    measured = plural("count", one="{count} has none", other="{count} have none")
    hint = "What does your node send where it has no odometry to tell of?"


@dataclass(eq=False)
class OtherCount(Fault):
    """There are more points than distances, or fewer."""

    topic: str
    wanted: int
    found: int
    endless: int
    was_seen = True
    why = "inf, NaN and what is out of range are no distances: nothing is known to be there."
    expected = plural(
        "wanted",
        one="{wanted} point on {topic}: as many as the scan has distances",
        other="{wanted} points on {topic}: as many as the scan has distances",
    )
    measured = one_of(
        endless="{found} points, and {endless} of them are no numbers at all",
        more="{found} points",
    )
    hint = one_of(
        endless="What becomes of inf and NaN in your code?",
        more="Which numbers in ranges are distances? Look at range_min and range_max, too.",
    )
    mend = "if scan.range_min <= distance <= scan.range_max: NaN and inf do not come through that."

    @property
    def which_measured(self) -> str:
        """Whether some are no numbers."""
        return "endless" if self.endless else "more"

    which_hint = which_measured


@dataclass(eq=False)
class OffTheWalls(Fault):
    """Points are not on walls."""

    part: MovingPart
    limit_m: float
    off_m: float
    like: WayWrong
    was_seen = True
    why = one_of(
        standing="All that a rover plans rests on these points: it drives where there are none.",
        moving="A rover that turns with 2 rad/s turns by 6 degrees in a twentieth of a second.",
    )
    expected = one_of(
        standing="while the rover stands, the points lie on walls: {limit_m:g} m off at most",
        moving="while it drives and turns, the points lie on walls: {limit_m:g} m off at most",
    )
    measured = "they are {off_m:.2f} m off, in the mean of a scan"
    hint = one_of(
        other_time=(
            "Right while it stands, wrong while it turns: the points lie where the rover was at"
            " another time. Which time does your look-up ask for?"
        ),
        beam_angles="The directions are off by one angle. Where does the first beam look?",
        mount="The laser is not where your points begin. Which frames does the look-up name?",
        heading="The points are not turned as the rover is. What becomes of the yaw?",
        inverse="Target and source are swapped: which of the two frames are your points in?",
        laser_frame="These numbers are in the frame of the laser. What takes them to the other?",
        none=(
            "Which one is wrong before one single wall: the distance, the angle of the beam, the"
            " place of the laser, or its turn?"
        ),
    )
    mend = one_of(
        other_time="Ask for scan.header.stamp, and for no other time.",
        beam_angles="The angle of beam n is scan.angle_min + n * scan.angle_increment.",
        inverse="lookup_transform(TARGET, SOURCE, TIME): the target is where you want the points.",
        other="",
    )

    @property
    def which_why(self) -> str:
        """By the part of the drive."""
        return self.part

    which_expected = which_why

    @property
    def which_hint(self) -> str:
        """By the mistake that explains it."""
        return self.like or "none"

    @property
    def which_mend(self) -> str:
        """The same, where more can be said."""
        return self.like if self.like in ("other_time", "beam_angles", "inverse") else "other"


@dataclass(eq=False)
class SaysTheUnknown(Fault):
    """Points for a time of which nobody knows where the rover was."""

    topic: str
    part: UnknownPart
    count: int
    was_seen = True
    why = "A guess looks like the truth, for everybody who reads it."
    expected = one_of(
        before="no points on {topic} for scans from before the first odometry",
        after="no points on {topic} for scans from after the last odometry",
    )
    measured = plural("count", one="for {count} of them", other="for {count} of them")
    hint = one_of(
        before="Where does your node take the rover to be, when nobody has told it yet?",
        after="Which time does your look-up ask for? Nobody has said where the rover is then.",
    )

    @property
    def which_expected(self) -> str:
        """Which of them."""
        return self.part

    which_hint = which_expected


# --- the map -----------------------------------------------------------------------------------


@dataclass(eq=False)
class NoMap(Fault):
    """No map came."""

    topic: str
    why = "A map that nobody gets is none."
    expected = "a message on {topic} within 3 s of the last scan"
    measured = "none came"
    hint = "When does your node publish the map?"


@dataclass(eq=False)
class BadGrid(Fault):
    """The numbers of a map do not belong together."""

    what: Literal["cell", "count", "numbers", "rotation", "turned", "tilted", "height", "values"]
    wanted: str
    found: str
    was_seen = True
    why = "Who reads a map finds each cell by these numbers."
    expected = one_of(
        cell="info.resolution is {wanted}",
        count="data has info.width * info.height = {wanted} numbers",
        numbers="each number of info.origin is finite",
        rotation="the rotation of info.origin has the length {wanted}",
        turned="info.origin is not turned",
        tilted="info.origin is not turned",
        height="info.origin.position.z is {wanted}",
        values="each cell is {wanted}",
    )
    measured = one_of(
        cell="it is {found}",
        count="it has {found}",
        numbers="one is inf or NaN",
        rotation="its length is {found}",
        turned="its yaw is {found} rad",
        tilted="it is turned about x or y",
        height="it is {found}",
        values="some are {found}",
    )
    hint = "Compare the fields of info with the cells that your node counts."

    @property
    def which_expected(self) -> str:
        """What is wrong."""
        return self.what

    which_measured = which_expected


@dataclass(eq=False)
class WallsElsewhere(Fault):
    """Walls of the map are not where points fell."""

    wanted: float
    found: float
    like: MapSlip
    was_seen = True
    why = "Who drives by this map runs into walls."
    expected = "of the cells with points on walls, {wanted:.0%} are 100"
    measured = "{found:.0%} are"
    hint = one_of(
        rows_and_columns="Rows and columns are swapped. Which of x and y counts rows?",
        cut_towards_zero="West and south of (0, 0) walls are a cell off. What is int(-0.5)?",
        elsewhere="All walls are shifted alike. Is info.origin the corner of your first cell?",
        none="Log the cell of one point, and compare. Does a beam that comes later wipe it out?",
    )
    mend = one_of(
        rows_and_columns="data[row * width + column]: x gives the column, y gives the row.",
        cut_towards_zero="math.floor() goes down, also below 0.",
        other="",
    )

    @property
    def which_hint(self) -> str:
        """By the mistake that explains it."""
        return self.like or "none"

    @property
    def which_mend(self) -> str:
        """The same, where more can be said."""
        return self.like if self.like in ("rows_and_columns", "cut_towards_zero") else "other"


@dataclass(eq=False)
class WallsInTheAir(Fault):
    """Walls of the map where there are none."""

    wanted: float
    found: float
    was_seen = True
    why = "A rover stays away from walls, also from those that are not there."
    expected = "of the cells that are 100, {wanted:.0%} are at a wall"
    measured = "{found:.0%} are"
    hint = "Which cells does your node mark with 100, besides those of points on walls?"


@dataclass(eq=False)
class CellsWrong(Fault):
    """Cells of the map are not what is known of them."""

    kind: Literal["free", "unknown"]
    wanted: float
    found: float
    was_seen = True
    why = one_of(
        free="Only where a map says 0, a planner lets the rover drive.",
        unknown="-1 says: look there first. A 0 would say: drive there, all is free.",
    )
    expected = one_of(
        free="of the cells through which beams went to a wall, {wanted:.0%} are 0",
        unknown="of the cells of which nothing is known, {wanted:.0%} are -1",
    )
    measured = "{found:.0%} are"
    hint = one_of(
        free="Which cells lie between the laser and a point? Follow one beam, cell by cell.",
        unknown="With which number does your map begin, and where does each beam end?",
    )

    @property
    def which_why(self) -> str:
        """Of which cells."""
        return self.kind

    which_expected = which_hint = which_why
