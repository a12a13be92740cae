"""What can be wrong with a drive through a room, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.capabilities.rooms.record import Side
from roslings.judge.faults import Fault
from roslings.judge.faults.sentences import one_of, plural


@dataclass(eq=False)
class EndsInARoom(Fault):
    """A node ended while it drove."""

    room: int
    after_s: float
    was_seen = True
    why = "A rover whose program has ended stands where it is until somebody comes."
    expected = "your node drives in room {room} until the end"
    measured = "it ended after {after_s:.1f} s of robot time"
    hint = "What is the last thing that it wrote? It stands below."


@dataclass(eq=False)
class NeverDrives(Fault):
    """No command ever moved the rover."""

    room: int
    refused: int
    why = "The rover goes nowhere by itself: it does what /cmd_vel says."
    expected = "in room {room} your node lets the rover drive"
    measured = one_of(
        silent="no command on /cmd_vel moved it",
        refused="its commands on /cmd_vel were no finite numbers",
    )
    hint = (
        "Does your node get a scan? /scan is best effort, as all sensors are: a subscription that"
        " asks for a reliable one hears nothing."
    )

    @property
    def which_measured(self) -> str:
        """What it said."""
        return "refused" if self.refused else "silent"


@dataclass(eq=False)
class SaysMoreThanItDrives(Fault):
    """A command asks for what no rover with two wheels can do."""

    room: int
    stray: str
    blocks = False
    why = "Some robots drive to the side, too: there the same node would let it happen."
    expected = "in room {room} all fields of a command are 0, but linear.x and angular.z"
    measured = "in one of its commands {stray}"
    hint = "A rover with two wheels drives ahead and turns. Do you fill another field of the Twist?"


@dataclass(eq=False)
class BumpsIntoThings(Fault):
    """The rover ran into something."""

    room: int
    most: int
    bumps: int
    first_s: float
    x_m: float
    y_m: float
    into: Literal["moving", "standing"]
    blocks = False
    was_seen = True
    why = "A bump breaks the front of a real rover, and hurts whoever stands before it."
    expected = plural(
        "most",
        one="at most {most} bump in room {room}",
        other="at most {most} bumps in room {room}",
    )
    measured = one_of(
        moving="{bumps} in all; the first one after {first_s:.1f} s, at x {x_m:.2f} m, y"
        " {y_m:.2f} m, into something that moves",
        standing="{bumps} in all; the first one after {first_s:.1f} s, at x {x_m:.2f} m, y"
        " {y_m:.2f} m, into something that stands there",
    )
    hint = "What did /scan say of this place, shortly before? The picture shows where it is."

    @property
    def which_measured(self) -> str:
        """What it ran into."""
        return self.into


@dataclass(eq=False)
class CoversLittle(Fault):
    """The rover hardly got anywhere."""

    room: int
    least_m: float
    found_m: float
    way_m: float
    blocks = False
    why = "Who stands still, or drives in circles, touches nothing, and is of no use."
    expected = "in room {room} it goes {least_m:g} m over new ground, at least"
    measured = one_of(
        stands="it goes {way_m:.2f} m in all",
        circles="it goes {way_m:.2f} m in all, but only {found_m:.2f} m of them over new ground",
    )
    hint = "Where does it turn back, or stop for good? The picture shows the way that it went."

    @property
    def which_measured(self) -> str:
        """Whether it went anywhere."""
        return "circles" if self.way_m > self.least_m else "stands"


@dataclass(eq=False)
class NoWallFound(Fault):
    """It never came near a wall on the side that it should follow."""

    room: int
    side: Side
    at_m: float
    within_m: float
    nearest_m: float
    blocks = False
    why = "Only who has come to a wall can follow it."
    expected = one_of(
        left="in room {room} a wall on the left, {at_m:g} m away, give or take {within_m:g} m",
        right="in room {room} a wall on the right, {at_m:g} m away, give or take {within_m:g} m",
    )
    measured = "the nearest that it came to one there is {nearest_m:.2f} m"
    hint = "In which direction does your node look for its wall at the start?"

    @property
    def which_expected(self) -> str:
        """The side."""
        return self.side


@dataclass(eq=False)
class OffTheWall(Fault):
    """It follows a wall, too near or too far, or up and down."""

    room: int
    side: Side
    at_m: float
    what: Literal["mean", "p95"]
    most_off_m: float
    off_m: float
    mean_m: float
    blocks = False
    why = "Where a way is narrow, a rover that keeps its distance gets through."
    expected = one_of(
        mean="in room {room} it is {at_m:g} m from the wall, off by {most_off_m:.2f} m in the mean",
        p95="in room {room} it is {at_m:g} m from the wall, off by {most_off_m:.2f} m in 95 of 100"
        " cases at most",
    )
    measured = one_of(
        left="it is off by {off_m:.2f} m; it was {mean_m:.2f} m from the wall on its left, in the"
        " mean",
        right="it is off by {off_m:.2f} m; it was {mean_m:.2f} m from the wall on its right, in the"
        " mean",
    )
    hint = "Is it too near, too far, or now this and now that? The picture shows its way."

    @property
    def which_expected(self) -> str:
        """What was reckoned."""
        return self.what

    @property
    def which_measured(self) -> str:
        """The side."""
        return self.side


@dataclass(eq=False)
class DrivesOn(Fault):
    """Something that moves came into its way, and it did not stop in time."""

    room: int
    from_m: float
    at_s: float
    how: Literal["bumped", "on", "late"]
    found_m: float
    blocks = False
    was_seen = True
    why = "What moves may be a foot, or a hand: a rover stops, and lets it pass."
    expected = (
        "in room {room} it stands before something that moves into its way is nearer than"
        " {from_m:.2f} m"
    )
    measured = one_of(
        bumped="after {at_s:.1f} s it ran into it",
        on="after {at_s:.1f} s it drove on, and came as near as {found_m:.2f} m",
        late="after {at_s:.1f} s it stood, {found_m:.2f} m before it",
    )
    hint = "How old is the scan by which your node decides, and how wide does it look ahead?"

    @property
    def which_measured(self) -> str:
        """What it did."""
        return self.how
