"""Broadcasters and listeners on /tf, with real nodes."""

from __future__ import annotations

import gc
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import rclpy
from frame_messages import NEWEST, at, for_s, step
from frame_stand_ins import tf2_ros
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor

from ros2_on_pip.domain_lease import leased_domain
from skips import needs

WITH_TF = needs("module tf2_msgs")
PATIENCE_S = 60.0
"""Only a test that fails waits so long."""
SHORT_S = 0.05


class Ros:
    """Nodes of one context, and what spins them: one thread, this one."""

    def __init__(self, context: Any) -> None:
        self.context = context
        self.executor = SingleThreadedExecutor(context=context)

    def node(self, name: str, spun: bool = True) -> Any:
        """A new one."""
        made = rclpy.create_node(name, context=self.context)
        if spun:
            self.executor.add_node(made)
        return made

    def spin_until(self, holds: Callable[[], Any], again: Callable[[], Any] = lambda: None) -> None:
        """Do `again` and what is due, until it holds."""
        clock = rclpy.clock.Clock()
        end = clock.now() + for_s(PATIENCE_S)
        while not holds():
            assert clock.now() < end, "what is waited for never comes"
            again()
            self.executor.spin_once(timeout_sec=0.02)


@pytest.fixture
def ros() -> Iterator[Ros]:
    """On a domain of its own."""
    with leased_domain() as domain:
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        yield Ros(context)
        context.try_shutdown()


def told_late(node: Any) -> Callable[[], None]:
    """Says once a look where base_link is, now."""
    broadcaster = tf2_ros.TransformBroadcaster(node)

    def tell() -> None:
        moved = step("odom", "base_link")
        moved.header.stamp = node.get_clock().now().to_msg()
        broadcaster.sendTransform(moved)

    return tell


@WITH_TF
def test_a_listener_in_a_local_variable_goes_on_hearing(ros: Ros) -> None:
    """The node holds its subscriptions, and they hold it."""
    node, other = ros.node("listener"), ros.node("teller")
    buffer = tf2_ros.Buffer()

    def listen() -> None:
        tf2_ros.TransformListener(buffer, node)

    listen()
    gc.collect()
    tell = told_late(other)
    ros.spin_until(lambda: buffer.can_transform("odom", "base_link", NEWEST), tell)


@WITH_TF
def test_several_in_one_message(ros: Ros) -> None:
    """A list, or another iterable."""
    node = ros.node("both")
    buffer = tf2_ros.Buffer(node=node)
    listener = tf2_ros.TransformListener(buffer, node)
    broadcaster = tf2_ros.TransformBroadcaster(node, 10)
    steps = [step("odom", "base_link", 1.0), step("base_link", "laser", 1.0)]
    ros.spin_until(
        lambda: buffer.can_transform("odom", "laser", at(1.0)),
        lambda: broadcaster.sendTransform(iter(steps)),
    )
    assert listener.buffer is buffer


@WITH_TF
def test_who_comes_late_hears_all_that_never_moves(ros: Ros) -> None:
    """Also what was sent before the last call; of the same frame the last word."""
    broadcaster = tf2_ros.StaticTransformBroadcaster(ros.node("teller"))
    broadcaster.sendTransform(step("base_link", "laser", x_m=9.0))
    broadcaster.sendTransform(step("base_link", "camera"))
    broadcaster.sendTransform([step("base_link", "laser", x_m=0.1)])
    late = ros.node("late")
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, late)
    ros.spin_until(lambda: buffer.can_transform("camera", "laser", at(77.0)))
    found = buffer.lookup_transform("base_link", "laser", NEWEST)
    assert found.transform.translation.x == pytest.approx(0.1)


@WITH_TF
def test_the_quality_of_service_can_be_said(ros: Ros) -> None:
    """A depth, as a number; the topics are /tf and /tf_static, also within a namespace."""
    node = rclpy.create_node("deep", namespace="robot", context=ros.context)
    tf2_ros.TransformListener(tf2_ros.Buffer(), node, qos=7, static_qos=8)
    (moving,) = node.get_subscriptions_info_by_topic("/tf")
    (still,) = node.get_subscriptions_info_by_topic("/tf_static")
    assert moving.node_namespace == still.node_namespace == "/robot"
    assert [each.qos_profile.depth for each in node.subscriptions] == [7, 8]


@WITH_TF
def test_a_listener_that_was_unregistered_hears_nothing(ros: Ros) -> None:
    """Of the topics of its node none is left."""
    node = ros.node("deaf", spun=False)
    listener = tf2_ros.TransformListener(tf2_ros.Buffer(), node, spin_thread=True)
    assert len(list(node.subscriptions)) == 2
    listener.unregister()
    assert not listener.dedicated_listener_thread.is_alive()
    assert list(node.subscriptions) == []


@WITH_TF
def test_a_thread_of_its_own_hears_while_a_look_up_waits(ros: Ros) -> None:
    """Nothing else spins the node."""
    node = ros.node("waiting", spun=False)
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer, node, spin_thread=True)
    broadcaster = tf2_ros.StaticTransformBroadcaster(ros.node("teller"))
    broadcaster.sendTransform(step("base_link", "laser"))
    found = buffer.lookup_transform("base_link", "laser", NEWEST, for_s(PATIENCE_S))
    assert found.child_frame_id == "laser"
    listener.unregister()


@WITH_TF
def test_a_wait_in_a_callback_of_one_thread_waits_in_vain(ros: Ros) -> None:
    """Its listener is behind it in the same queue; after it, the step is there."""
    node, other = ros.node("stuck"), ros.node("teller")
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, node)
    broadcaster = tf2_ros.TransformBroadcaster(other)
    ros.spin_until(lambda: broadcaster.pub_tf.get_subscription_count())
    said: list[str] = []

    def look() -> None:
        if not said:
            broadcaster.sendTransform(step("odom", "base_link", 1.0))
        try:
            buffer.lookup_transform("odom", "base_link", NEWEST, for_s(SHORT_S))
            said.append("found")
        except tf2_ros.TransformException as error:
            said.append(type(error).__name__)

    node.create_timer(0.01, look)
    ros.spin_until(lambda: said[-1:] == ["found"])
    assert said[0] == "LookupException"


@WITH_TF
def test_awaiting_in_a_callback_lets_the_listener_hear(ros: Ros) -> None:
    """The same thread does both, in turns."""
    node = ros.node("awaiting")
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, node)
    found: list[Any] = []

    async def look() -> None:
        timer.cancel()
        found.append(await buffer.lookup_transform_async("odom", "base_link", NEWEST))

    timer = node.create_timer(0.01, look, callback_group=ReentrantCallbackGroup())
    ros.spin_until(lambda: buffer._waiting)
    ros.spin_until(lambda: found, told_late(ros.node("teller")))
    assert found[0].child_frame_id == "base_link"


# --- where the type is not built ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("distro", "of_the_course", "step_told"),
    [
        ("jazzy", False, "sudo apt install ros-jazzy-tf2-msgs"),
        ("", True, "./roslings ready rover --tf"),
        ("", False, "build the package tf2_msgs of geometry2 with colcon"),
    ],
)
def test_without_its_type_the_next_step_is_told(
    ros: Ros,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    distro: str,
    of_the_course: bool,
    step_told: str,
) -> None:
    """Of each that speaks or hears on /tf; a buffer works without."""
    monkeypatch.setitem(sys.modules, "tf2_msgs.msg", None)
    monkeypatch.setitem(sys.modules, "tf2_msgs", None)
    monkeypatch.setenv("ROS_DISTRO", distro)
    monkeypatch.setattr("sys.prefix", str(tmp_path / "environment"))
    if of_the_course:
        (tmp_path / "roslings").touch()
    node = ros.node("poor", spun=False)
    buffer = tf2_ros.Buffer(node=node)
    buffer.set_transform_static(step("base_link", "laser"), "test")
    for make in (
        lambda: tf2_ros.TransformListener(buffer, node),
        lambda: tf2_ros.TransformBroadcaster(node),
        lambda: tf2_ros.StaticTransformBroadcaster(node),
    ):
        with pytest.raises(ImportError, match="/tf has the type tf2_msgs/msg/TFMessage") as raised:
            make()
        assert step_told in str(raised.value)


# --- where the real ones are -------------------------------------------------------------------

NAMES = (
    "rosbag2_py",
    "rosidl_runtime_py",
    "tf2_ros",
    "tf2_py",
    "tf2_geometry_msgs",
    "tf_transformations",
)


def test_each_is_there_by_its_name() -> None:
    """In a Python that nobody has told where ours lie, as a student's node is."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-c", f"import {', '.join(NAMES)}"],
        env=kept,
        text=True,
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", ["tf2_ros", "tf2_py", "tf2_geometry_msgs", "tf_transformations"])
def test_the_real_one_goes_first(tmp_path: Path, name: str) -> None:
    """A sourced ROS has its own on PYTHONPATH, which comes before this environment's packages."""
    real = tmp_path / "opt" / name
    real.mkdir(parents=True)
    (real / "__init__.py").write_text("")
    found = subprocess.run(
        [sys.executable, "-c", f"import {name}; print({name}.__file__)"],
        env=os.environ | {"PYTHONPATH": str(tmp_path / "opt")},
        text=True,
        capture_output=True,
        check=True,
    )
    assert found.stdout.strip() == str(real / "__init__.py")


@pytest.mark.parametrize("name", ["tf_transformations", "tf2_geometry_msgs"])
def test_ours_go_with_a_real_tf2_ros(tmp_path: Path, name: str) -> None:
    """ros-base brings tf2_ros without these two: they need nothing of ours that has its name."""
    real = tmp_path / "opt" / "tf2_ros"
    real.mkdir(parents=True)
    (real / "__init__.py").write_text(
        "class TransformRegistration:\n"
        "    def add(self, key, callback): print(key.__name__)\n"
        "class ConvertRegistration:\n"
        "    def add_to_msg(self, key, callback): pass\n"
        "    add_from_msg = add_to_msg\n"
    )
    found = subprocess.run(
        [sys.executable, "-c", f"import {name}, tf2_ros; print(tf2_ros.__file__)"],
        env=os.environ | {"PYTHONPATH": str(tmp_path / "opt")},
        text=True,
        capture_output=True,
        check=True,
    )
    assert found.stdout.split()[-1] == str(real / "__init__.py")
    assert ("PointStamped" in found.stdout) == (name == "tf2_geometry_msgs")
