"""Verdicts written by hand, as a grading of the lab `topics` would give them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from roslings.verdict import (
    CheckResult,
    Environment,
    Timings,
    Verdict,
    outcome_of,
    score_of,
)

TITLES: Mapping[str, tuple[float, str]] = {
    "well_formed": (5, "package.xml, setup.py, setup.cfg and the marker file say the same thing."),
    "depends": (5, "package.xml lists the packages that the code imports."),
    "builds": (5, "colcon builds the package."),
    "talker_runs": (5, "The executable talker starts and keeps running."),
    "talker_name": (5, "The talker's node is called /talker."),
    "talker_topic": (5, "The talker publishes on /chatter."),
    "talker_type": (5, "/chatter carries std_msgs/msg/String."),
    "talker_qos": (3, "The talker offers reliable delivery."),
    "rate": (15, "/chatter carries two messages a second."),
    "text": (8, "Each message says Hello robotics and a number."),
    "counting": (7, "The numbers count up by one, with none twice and none left out."),
    "talker_logs": (4, "The talker logs what it publishes."),
    "listener_runs": (3, "The executable listener starts and keeps running."),
    "listener_name": (3, "The listener's node is called /listener."),
    "listener_topic": (5, "The listener subscribes to /chatter, with the right type and QoS."),
    "hears": (10, "The listener logs a sentence that it cannot know before."),
    "together": (2, "The graph holds these two nodes and this edge, and nothing else."),
    "ends": (2, "Both nodes end within two seconds of Ctrl-C."),
    "clean_exit": (1, "Both nodes end without a traceback."),
    "figure": (2, "figures/day3_rqt_graph.png shows the running graph."),
}

HINTS = (
    "Look at the line in talker.py that makes the timer.",
    "A timer takes its period: the time between two calls, not how many calls a second.",
    "def blink(self):\n    # 4 times a second\n    self.create_timer(1 / 4, self.toggle_lamp)",
)

TOO_SLOW: Mapping[str, Any] = {
    "expected": "2 Hz, from 1.9 to 2.1 Hz",
    "measured": "1.00 Hz: 12 messages, one each 1.00 s",
    "why": "A robot that steers on these messages would react half as quickly as it should.",
    "hint": "The period is twice as long as it should be. Which number sets it?",
    "fault": "TooSlow",
    "fields": {"topic": "/chatter", "wanted_hz": 2.0, "within": 0.05},
    "lesson": "days/03-topics#timers",
    "hints": HINTS,
}

TRACEBACK = (
    "Traceback (most recent call last):",
    '  File "/home/anna/roslings_ws/install/chatter/lib/chatter/talker", line 33, in <module>',
    "    sys.exit(load_entry_point('chatter==0.0.0', 'console_scripts', 'talker')())",
    '  File "/home/anna/roslings_ws/install/chatter/lib/python3.12/site-packages/chatter/talker.py"'
    ", line 24, in main",
    "    node = Talker()",
    "           ^^^^^^^^",
    '  File "/home/anna/roslings_ws/install/chatter/lib/python3.12/site-packages/chatter/talker.py"'
    ", line 12, in __init__",
    "    self.publisher = self.create_publisher('String', '/chatter', 10)",
    "                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^",
    '  File "/opt/ros/jazzy/lib/python3.12/site-packages/rclpy/node.py", line 1622, in create_pub',
    "    check_is_valid_msg_type(msg_type)",
    "AttributeError: type object 'str' has no attribute '_TYPE_SUPPORT'",
)

CRASHED: Mapping[str, Any] = {
    "expected": "talker runs until Ctrl-C",
    "measured": "talker ended by itself after 0.3 s with exit code 1",
    "why": "A node that ends cannot publish anything.",
    "hint": "Read the last line of the traceback first: it names the mistake.",
    "fault": "Crashed",
    "lesson": "days/03-topics#first-node",
    "log": TRACEBACK,
    "hints": HINTS,
}


def passing(check: str) -> CheckResult:
    """The check of that name, passed."""
    points, title = TITLES[check]
    return CheckResult(id=check, title=title, outcome="pass", points=points, max_points=points)


def failing(check: str, **parts: Any) -> CheckResult:
    """The check of that name, failed, with what there is to say of it."""
    return passing(check).model_copy(update={"outcome": "fail", "points": 0.0, **parts})


def skipped(check: str, need: str) -> CheckResult:
    """The check of that name, skipped since `need` failed."""
    why = f"This waits for {need}: mend that first."
    return passing(check).model_copy(update={"outcome": "skip", "points": 0.0, "why": why})


def left_open(check: str, why: str) -> CheckResult:
    """The check of that name, which nobody could judge."""
    return passing(check).model_copy(update={"outcome": "inconclusive", "points": 0.0, "why": why})


def verdict(*changed: CheckResult, advice: tuple[str, ...] = ()) -> Verdict:
    """A verdict in which all checks pass but `changed`."""
    by_id = {check.id: check for check in changed}
    checks = tuple(by_id.get(check) or passing(check) for check in TITLES)
    return Verdict(
        lab="topics",
        package="chatter",
        outcome=outcome_of(checks),
        score=score_of(checks),
        checks=checks,
        advice=advice,
        seconds=Timings(build=1.5, discovery=0.2, watching=6.0, ending=0.4, total=8.4),
        environment=Environment(
            roslings="0.1.0",
            ros_distro="jazzy",
            rmw="rmw_fastrtps_cpp",
            python="3.12.1",
            platform="Linux-6.8-x86_64",
            isolation="namespace",
            clock="wall",
            seed=20814,
        ),
    )


def full_score() -> Verdict:
    """Everything right."""
    return verdict()


def too_slow() -> Verdict:
    """One check failed."""
    return verdict(failing("rate", **TOO_SLOW))


def crashed() -> Verdict:
    """One check failed, with a traceback, and what needs it is skipped."""
    waiting = ("talker_name", "talker_topic", "talker_type", "talker_qos", "rate", "text")
    also = ("counting", "talker_logs", "together")
    return verdict(
        failing("talker_runs", **CRASHED),
        *(skipped(check, "talker_runs") for check in (*waiting, *also)),
    )


def syntax_error() -> Verdict:
    """The first check failed and nothing else could be judged."""
    return verdict(
        failing(
            "builds",
            expected="colcon builds the package",
            measured="chatter/talker.py:14: '(' was never closed",
            why="Python cannot read the file, so nothing can run.",
            hint="Close the bracket in line 14.",
            lesson="days/03-topics#build",
            hints=HINTS,
        ),
        *(skipped(check, "builds") for check in list(TITLES)[3:-1]),
    )


def three_faults() -> Verdict:
    """Three failures that do not hang together, and a remark."""
    return verdict(
        failing("rate", **TOO_SLOW),
        failing(
            "clean_exit",
            expected="no traceback after Ctrl-C",
            measured="talker wrote a traceback that ends in KeyboardInterrupt",
            why="Who reads the log cannot tell your traceback from a real crash.",
            hint="Catch KeyboardInterrupt around the line that spins.",
            log=("Traceback (most recent call last):", "KeyboardInterrupt"),
            hints=HINTS,
        ),
        failing(
            "figure",
            expected="a PNG of at least 200 x 200 px at figures/day3_rqt_graph.png",
            measured="there is no such file; figures/ holds graph.png",
            why="A picture of the graph is how you show others what your nodes do.",
            hint="Is the file's name spelt as the card has it?",
            hints=HINTS,
        ),
        advice=("package.xml still has the description TODO.",),
    )


def inconclusive() -> Verdict:
    """The machine was too busy to judge one check."""
    return verdict(
        left_open("rate", "This machine was too busy: the observer itself stood still for 2.1 s.")
    )
