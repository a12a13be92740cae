"""The rover: its map, and how to drive it."""

from __future__ import annotations

import base64
import math
import time
from collections.abc import Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

from nicegui import ui

from ros2_on_pip.problem import CommandProblem
from roslings_desk.controls import (
    CheckField,
    Notice,
    PageText,
    SelectField,
    StatusLine,
    TextField,
    button,
    part,
    told,
)
from roslings_desk.driver import TwistPublisher
from roslings_desk.hub import GraphTopic, SharedSubscription
from roslings_desk.odometry import ODOM, ODOMETRY, pose_in
from roslings_desk.publisher import Publisher
from roslings_desk.room_heard import RoomHeard
from roslings_desk.tab import OpenTab
from roslings_rover.models.differential_drive import Body, Pose
from roslings_rover.rover.moving_map import moving_map, place_under
from roslings_rover.rover.rover import PATH_STEP_M, TURN_STEP_RAD, RoverMoment

CMD_VEL, GOAL_POSE = "/cmd_vel", "/goal_pose"
"""The last one is where rviz2 publishes a goal that was clicked."""
POSE_STAMPED = "geometry_msgs/msg/PoseStamped"
CLICKED = """(event) => {
  const map = event.target;
  const scale = Math.min(map.clientWidth / map.naturalWidth, map.clientHeight / map.naturalHeight);
  emit([0.5 + (event.offsetX - map.clientWidth / 2) / (scale * map.naturalWidth),
        0.5 + (event.offsetY - map.clientHeight / 2) / (scale * map.naturalHeight)]);
}"""
"""Parts of the map's width and height; a map of another shape stands in the middle of its place."""
KEYS = Path(__file__).with_name("drive.js")
SPEEDS_M_S, TURNS_RAD_S = ("0.1", "0.3", "0.5"), ("0.5", "1.0", "1.5")
A_PRESS_S = 0.5
STALE_S = 1.5
SPOKEN_EVERY_S = 3.0
LONGEST_TRAIL = 1_000
PRESSES = (("Left", 0, 1), ("Ahead", 1, 0), ("Back", -1, 0), ("Right", 0, -1))
"""Words, and what they are of the chosen speeds: ahead, and to the left."""


class NoPlace(CommandProblem):
    """What was typed is no place."""

    def __init__(self, typed: str) -> None:
        super().__init__(f"'{typed}' is no place. Type metres as a number, for example 1.5")


class RoverTab:
    """Shows where /odom says that the robot is, in its room; drives it by /cmd_vel.

    It listens and publishes only where somebody is at the other side: a page that is open makes no
    topic appear in anybody's list.
    """

    title, every_s = "Rover", 0.05

    def __init__(self) -> None:
        self._trail: list[RoverMoment] = []
        self._drawn = 0
        self._spoken_s = 0.0
        self._goal = self._goal_told = ""
        """The goal that was sent, in words, until something else is spoken."""

    def show(self, open_tab: OpenTab) -> None:
        """The map, and beside it what drives."""
        self._hub = open_tab.hub
        self._open = open_tab
        self._odom: SharedSubscription | None = None
        self._room = RoomHeard(open_tab)
        self._driver: TwistPublisher | None = None
        self._drivers = open_tab.ends.enter_context(ExitStack())
        self._goals = open_tab.ends.enter_context(Publisher(self._hub, GOAL_POSE, POSE_STAMPED))
        with part("div", "sides"):
            self._map = part(
                "img", "map drawing", alt="Map: nothing is known yet", src=self._picture()
            )
            self._map.on("click", lambda event: self._click(*event.args), js_handler=CLICKED)
            with part("div", "column"):
                self._place = PageText("p", "", "value")
                self._state = PageText("p", "Looking for nodes ...", "hint", id="state")
                self._controls()
        ui.on("desk-drive", lambda event: self._by_keys(event.args))
        ui.on("desk-stop", lambda _: self._stop())
        ui.run_javascript(KEYS.read_text("utf-8"))

    def _controls(self) -> None:
        button("Stop", self._stop, "stop")
        with part(
            "div",
            "pad",
            id="drive-pad",
            tabindex=0,
            role="application",
            aria_label="Drive by arrow keys",
        ):
            PageText("p", "Drive: click here, then hold an arrow key. Space stops.")
            PageText(
                "p", "A gamepad drives while this field has the focus: its left stick.", "hint"
            )
        PageText("p", "Escape stops it, too, wherever you are on this page.", "hint")
        with part("div", "row"):
            self._speed = SelectField("Speed, m/s", SPEEDS_M_S, "0.3")
            self._turn = SelectField("Turn, rad/s", TURNS_RAD_S, "1.0")
        PageText("p", f"Or press a button: each press drives {A_PRESS_S:g} s.", "hint")
        with part("div", "row", role="group", aria_label=f"Drive for {A_PRESS_S:g} s"):
            for word, ahead, left in PRESSES:
                button(word, partial(self._drive, ahead, left, A_PRESS_S))
        self._show_goal()
        with part("div", "row"):
            button("Say where it is", self._say)
            self._says = CheckField("Say it every 3 s")
        self._spoken = StatusLine()

    def _show_goal(self) -> None:
        PageText("p", f"A goal is published on {GOAL_POSE}: click on the map, or type it.", "hint")
        trouble = Notice()
        with part("div", "row"):
            self._goal_x = TextField("Goal x, m", "0.0", inputmode="decimal")
            self._goal_y = TextField("Goal y, m", "0.0", inputmode="decimal")
            button("Send the goal", told(trouble, self._send_typed))

    # --- goals -----------------------------------------------------------------------------

    def _click(self, right: float, down: float) -> None:
        x_m, y_m = place_under(self._room.world, right, down)
        self._goal_x.put(f"{x_m:.2f}")
        self._goal_y.put(f"{y_m:.2f}")
        self._send_goal(x_m, y_m)

    def _send_typed(self) -> None:
        """Raises NoPlace."""
        self._send_goal(_metres(self._goal_x.value), _metres(self._goal_y.value))

    def _send_goal(self, x_m: float, y_m: float) -> None:
        from geometry_msgs.msg import PoseStamped

        newest = self._odom.newest() if self._odom else None
        goal = PoseStamped()
        goal.header.frame_id = newest.header.frame_id if newest else "odom"
        goal.pose.position.x, goal.pose.position.y = x_m, y_m
        goal.pose.orientation.w = 1.0
        self._goals.publish(goal, [partial(setattr, goal.header, "stamp")])
        self._goal_told = ""
        self._goal = f"Goal x {x_m:.2f} m, y {y_m:.2f} m is published on {GOAL_POSE}"
        self._tell_goal()

    def _tell_goal(self) -> None:
        """A publisher that is new meets who listens a moment later: then it is told anew."""
        words = f"{self._goal}; {_who_hears(self._goals.listeners)}."
        if words != self._goal_told:
            self._goal_told = words
            self._spoken.say(words)

    # --- driving ---------------------------------------------------------------------------

    def _by_keys(self, ways: Any) -> None:
        ahead, left = ways
        self._drive(ahead, left)

    def _drive(self, ahead: float, left: float, for_s: float | None = None) -> None:
        forward_m_s = ahead * float(self._speed.value)
        turn_rad_s = left * float(self._turn.value)
        if self._driver is None:
            return  # nobody listens, and the page says so
        if for_s is None:
            self._driver.drive(forward_m_s, turn_rad_s)
        else:
            self._driver.drive(forward_m_s, turn_rad_s, for_s)

    def _stop(self) -> None:
        if self._driver is not None:
            self._driver.stop()

    # --- showing ---------------------------------------------------------------------------

    def refresh(self) -> None:
        """Move the rover on its map, where something new has come."""
        there = {seen.name: seen for seen in self._hub.topics()}
        self._join(there)
        self._state.say(self._said_of(there))
        if self._goal:
            self._tell_goal()
        is_another = self._room.look()
        if self._odom and self._odom.count != self._drawn:
            self._drawn = self._odom.count
            is_another = self._follow(self._odom) or is_another
        if is_another:
            self._draw()

    def _follow(self, odom: SharedSubscription) -> bool:
        """Go where /odom says; whether the map is another one now."""
        pose = pose_in(odom.newest())
        if pose is None:
            self._place.say("The numbers of /odom are not finite.")
            return False
        self._place.say(position(pose))
        has_gone = self._goes_to(pose)
        if self._says.value and time.monotonic() - self._spoken_s >= SPOKEN_EVERY_S:
            self._say()
        return has_gone

    def _draw(self) -> None:
        self._map.props["src"] = self._picture()
        if self._trail:
            where = position(self._trail[-1].pose)
            self._map.props["alt"] = f"Map of the room. The rover is at {where}."
        self._map.update()

    def _picture(self) -> str:
        """The map as the address of an image; before the first news the rover is at the start."""
        trail = self._trail or [RoverMoment(0.0, Pose())]
        drawn = moving_map(self._room.world, trail, Body().radius_m, moves=False)
        return f"data:image/svg+xml;base64,{base64.b64encode(drawn.encode()).decode()}"

    def _join(self, there: Mapping[str, GraphTopic]) -> None:
        """Be there for those who are there now."""
        says = ODOM in there and there[ODOM].publishers > 0
        hears = CMD_VEL in there and there[CMD_VEL].subscriptions > 0
        if says and self._odom is None:
            self._odom, self._drawn = self._open.hear(ODOM, ODOMETRY), 0
        elif self._odom and not says:
            self._open.leave(self._odom)
            self._odom = None
        if hears and self._driver is None:
            self._driver = self._drivers.enter_context(TwistPublisher(self._hub, CMD_VEL))
        elif self._driver and not hears:
            self._drivers.close()
            self._driver = None
        if GOAL_POSE in there and there[GOAL_POSE].subscriptions:
            self._goals.announce()

    def _goes_to(self, pose: Pose) -> bool:
        """Whether the map is another one now."""
        new = RoverMoment(time.monotonic(), pose)
        if not self._trail:
            self._trail = [new, new]
            return True
        moved = self._trail[-1].pose != pose
        if _is_far(self._trail[-2].pose, pose):
            self._trail = [*self._trail[-LONGEST_TRAIL:-1], new, new]
        else:
            self._trail[-1] = new
        return moved

    def _said_of(self, there: Mapping[str, GraphTopic]) -> str:
        if ODOM not in there or not there[ODOM].publishers:
            return "No node publishes /odom. Start the rover, in a terminal: ./roslings rover"
        if not (self._driver and self._driver.listeners):
            return "No node listens on /cmd_vel, so nothing drives."
        comes = self._odom and self._odom.per_second()[0]
        return "" if comes else "Nothing comes on /odom at the moment."

    def _say(self) -> None:
        self._spoken_s = time.monotonic()
        self._goal = self._goal_told = ""
        pose = self._trail[-1].pose if self._trail else None
        self._spoken.say(position(pose) if pose else "Nothing is known yet.")


def _metres(typed: str) -> float:
    """Raises NoPlace."""
    try:
        metres = float(typed)
    except ValueError:
        raise NoPlace(typed) from None
    if not math.isfinite(metres):
        raise NoPlace(typed)
    return metres


def position(pose: Pose) -> str:
    """Where it is, in one line."""
    degrees = math.degrees(pose.heading_rad)
    return f"x {pose.x_m:.2f} m, y {pose.y_m:.2f} m, heading {degrees:.0f} degrees"


def _is_far(one: Pose, other: Pose) -> bool:
    turned_rad = abs(math.remainder(other.heading_rad - one.heading_rad, math.tau))
    far_m = math.hypot(other.x_m - one.x_m, other.y_m - one.y_m)
    return far_m >= PATH_STEP_M or turned_rad >= TURN_STEP_RAD


def _who_hears(count: int) -> str:
    if count == 1:
        return "1 subscription hears it"
    return f"{count} subscriptions hear it" if count else "no node listens there"
