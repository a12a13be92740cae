"""Proofs: two real processes exchange a message; live topics fit together."""

from __future__ import annotations

import json

from ros_doctor.finding import Finding, do, fault, not_applicable, ok, say, unknown, warning
from ros_doctor.live import conversation
from ros_doctor.machine import ExaminedMachine
from ros_doctor.mends import install_package
from ros_doctor.registry import check
from ros_doctor.ros import Ros, find_ros
from ros_doctor.texts import said

SPEAKING_FOR_S = 8.0
LOOKING_FOR_S = 3.0
LAST_LINE = 200  # characters of an error that fit into a message


@check(
    "talk",
    "A talker and a listener exchange a message",
    looks_at="two real ROS processes on this computer, in a quiet domain",
    lesson="01-install#proof",
    needs=("ros-found", "rclpy-python", "middleware", "shared-memory"),
    live=True,
)
def talk(machine: ExaminedMachine) -> Finding:
    """The talker says 'Publishing', and the listener stays silent."""
    ros = find_ros(machine)
    if ros is None:
        return not_applicable(
            said("doctor.live.talk.not_applicable", "ROS 2 Jazzy is not installed")
        )
    outcome = conversation.exchange(machine, ros, SPEAKING_FOR_S)
    if outcome.heard:
        return ok(said("doctor.live.talk.ok", "A word went from one process to another."))
    if outcome.error:
        return _crashed(machine, ros, outcome.error)
    return fault(
        said(
            "doctor.live.talk.fault",
            "Two ROS processes ran for {speaking_for_s:.0f} seconds, and no message arrived.",
            speaking_for_s=SPEAKING_FOR_S,
        ),
        say(
            said(
                "doctor.live.talk.say",
                "Look at the findings on multicast and /dev/shm. Then try with all defaults:",
            )
        ),
        do("env -u RMW_IMPLEMENTATION -u ROS_DISCOVERY_SERVER ./roslings doctor --only talk"),
    )


def _crashed(machine: ExaminedMachine, ros: Ros, error: str) -> Finding:
    words = error.strip().splitlines()[-1][-LAST_LINE:]
    if "std_msgs" in words:
        return fault(
            said("doctor.live.crashed.fault", "The standard messages of ROS are missing."),
            *install_package(
                machine, "ros-jazzy-common-interfaces", "ros-jazzy-common-interfaces==5.3.6"
            ),
        )
    return fault(
        said(
            "doctor.live.crashed.fault_2", "A ROS process ended with an error: {words}", words=words
        ),
        say(
            said("doctor.live.crashed.say", "See the whole error, and show it to your instructor:")
        ),
        do(f"{ros.python} -c 'import rclpy; rclpy.init()'"),
    )


@check(
    "qos",
    "Publishers and subscriptions that run now fit together",
    looks_at="the nodes that run on this computer now, and their QoS settings",
    lesson="03-topics#qos",
    rows=(24,),
    needs=("ros-found", "rclpy-python", "middleware", "domain-id"),
    live=True,
)
def qos(machine: ExaminedMachine) -> Finding:
    """The node is there, the topic is there, and no message arrives."""
    ros = find_ros(machine)
    if ros is None:
        return not_applicable(
            said("doctor.live.qos.not_applicable", "ROS 2 Jazzy is not installed")
        )
    if machine.env.get("ROS_AUTOMATIC_DISCOVERY_RANGE") == "OFF":
        return unknown(said("doctor.live.qos.unknown", "the discovery range is OFF"))
    running = conversation.participants(machine, conversation.domain_of(machine))
    if not running:
        return not_applicable(
            said("doctor.live.qos.not_applicable_2", "no ROS node runs on this computer now")
        )
    seen = conversation.look(machine, ros, running, LOOKING_FOR_S)
    if seen is None:
        return unknown(
            said("doctor.live.qos.unknown_2", "the observer did not answer; see the check talk")
        )
    clashes = [json.loads(line) for line in seen if '"why"' in line]
    if not clashes:
        return ok(said("doctor.live.qos.ok", "No pair of running nodes is at odds."))
    first = clashes[0]
    return warning(
        said(
            "doctor.live.qos.warning",
            "On {topic}, {subscription} cannot hear {publisher}. Their QoS differs: {why}.",
            topic=first["topic"],
            subscription=first["subscription"],
            publisher=first["publisher"],
            why=_plain(first["why"]),
        ),
        say(
            said(
                "doctor.live.qos.say",
                "Give the subscription the same QoS. For a sensor, this one fits:",
            )
        ),
        do(
            "from rclpy.qos import qos_profile_sensor_data\n"
            "self.create_subscription(Type, topic, callback,\n"
            "                         qos_profile_sensor_data)"
        ),
    )


def _plain(why: str) -> str:
    """Take the marks away that ROS puts around its reasons."""
    return why.replace("ERROR:", "").strip().rstrip(";").lower()
