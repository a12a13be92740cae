"""What the rarer options look at, in one process: odd values, a map, events, a quick clock."""

from __future__ import annotations

from contextlib import suppress

import rclpy
from geometry_msgs.msg import TwistStamped
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, ByteMultiArray, Float64MultiArray, String
from std_srvs.srv import SetBool

TURN_S = 0.02
SIM_NS_A_TURN = 200_000_000
"""The simulated time runs ten times as fast as the real one."""

AGE_NS = 500_000_000


class Maker(Node):
    """Publishes what is odd to print, and has parameters of rarer kinds."""

    def __init__(self) -> None:
        super().__init__("maker")
        self.declare_parameter("unset", Parameter.Type.INTEGER)
        self.declare_parameter("spare", 5, ParameterDescriptor(dynamic_typing=True))
        self.declare_parameter("pid.p", 1.0)
        self.declare_parameter("pid.i", 0.5)
        self.declare_parameter("names", ["a", "b"])
        self.flag = self.create_publisher(Bool, "flag", 10)
        self.joints = self.create_publisher(JointState, "joints", 10)
        self.bytes = self.create_publisher(ByteMultiArray, "bytes", 10)
        self.numbers = self.create_publisher(Float64MultiArray, "numbers", 10)
        self.pose = self.create_publisher(TwistStamped, "pose", 10)
        kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.plan = self.create_publisher(String, "plan", kept)
        self.plan.publish(String(data="the way"))
        self.timer = self.create_timer(TURN_S, self.talk)

    def talk(self) -> None:
        """One of each; the pose is half a second old."""
        self.flag.publish(Bool(data=True))
        self.joints.publish(JointState(name=["left"], position=[1.0, 2.0]))
        self.bytes.publish(ByteMultiArray(data=[b"\x01", b"\x02"]))
        self.numbers.publish(Float64MultiArray(data=[0.0, 1.0, 2.0]))
        pose = TwistStamped()
        seen = self.get_clock().now().nanoseconds - AGE_NS
        pose.header.stamp.sec, pose.header.stamp.nanosec = divmod(seen, 10**9)
        self.pose.publish(pose)


class Sun(Node):
    """Makes the time on /clock, and says /tick with each step of it."""

    def __init__(self) -> None:
        super().__init__("sun")
        self.now_ns = 0
        self.clock = self.create_publisher(Clock, "/clock", 10)
        self.tick = self.create_publisher(String, "tick", 10)
        self.timer = self.create_timer(TURN_S, self.turn)

    def turn(self) -> None:
        """One step."""
        self.now_ns += SIM_NS_A_TURN
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(self.now_ns, 10**9)
        self.clock.publish(message)
        self.tick.publish(String(data=str(self.now_ns)))


class Lamp(Node):
    """A service that tells what it is asked, and a hidden one."""

    def __init__(self) -> None:
        super().__init__("lamp")
        self.lamp = self.create_service(SetBool, "lamp", self.switch)
        self.lamp.configure_introspection(
            self.get_clock(), qos_profile_system_default, ServiceIntrospectionState.CONTENTS
        )
        self.quiet = self.create_service(SetBool, "_quiet", self.switch)

    def switch(self, request: SetBool.Request, answer: SetBool.Response) -> SetBool.Response:
        """Switch it."""
        answer.success, answer.message = request.data, "on" if request.data else "off"
        return answer


def main() -> None:
    """Run all of them until Ctrl-C."""
    rclpy.init()
    executor = SingleThreadedExecutor()
    nodes = [Maker(), Sun(), Lamp(), LifecycleNode("_valve")]
    for node in nodes:
        executor.add_node(node)
    print("ready", flush=True)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


if __name__ == "__main__":
    main()
