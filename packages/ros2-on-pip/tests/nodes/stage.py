"""Everything that the words of `ros2` look at, in one process."""

from __future__ import annotations

from contextlib import suppress

import rclpy
from geometry_msgs.msg import TwistStamped
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.action import ActionServer
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, State, TransitionCallbackReturn
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import SetBool
from test_msgs.action import Fibonacci

TALKS_EVERY_S = 0.05


class Talker(Node):
    """Says hello on /chatter, and more quietly on /secret/_whisper."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.count = 0
        self.voice = self.create_publisher(String, "chatter", 10)
        self.whisper = self.create_publisher(String, "_whisper", 10)
        self.timer = self.create_timer(TALKS_EVERY_S, self.talk)

    def talk(self) -> None:
        """One more message."""
        self.voice.publish(String(data=f"Hello World: {self.count}"))
        self.count += 1


class Rover(Node):
    """Messages with parts, lists and a quality of service of their own."""

    def __init__(self) -> None:
        super().__init__("rover", namespace="/field")
        self.twist = self.create_publisher(TwistStamped, "/cmd_vel", 10)
        self.scan = self.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self.timer = self.create_timer(TALKS_EVERY_S, self.talk)

    def talk(self) -> None:
        """One of each."""
        twist = TwistStamped()
        twist.header.frame_id = "base"
        twist.twist.linear.x = 1.5
        self.twist.publish(twist)
        self.scan.publish(LaserScan(ranges=[float(n) for n in range(200)]))


class Ear(Node):
    """Prints what it hears on /heard."""

    def __init__(self) -> None:
        super().__init__("ear")
        self.ear = self.create_subscription(String, "heard", self.hear, 10)

    def hear(self, message: String) -> None:
        """Print it."""
        print(f"heard {message.data}", flush=True)


class Tuner(Node):
    """Parameters, a service and an action."""

    def __init__(self) -> None:
        super().__init__("tuner")
        span = FloatingPointRange(from_value=0.0, to_value=3.0)
        about = ParameterDescriptor(description="How fast", floating_point_range=[span])
        self.declare_parameter("speed", 1.5, about)
        self.declare_parameter("label", "bob")
        self.declare_parameter("wheel.radius", 0.1)
        self.declare_parameter("steps", [1, 2])
        self.light = self.create_service(SetBool, "light", self.switch)
        self.counting = ActionServer(self, Fibonacci, "fibonacci", self.count)

    def switch(self, request: SetBool.Request, answer: SetBool.Response) -> SetBool.Response:
        """Switch the light."""
        answer.success, answer.message = request.data, "on" if request.data else "off"
        return answer

    def count(self, goal: object) -> Fibonacci.Result:
        """The numbers of Fibonacci."""
        numbers = [0, 1]
        for _ in range(goal.request.order - 1):
            numbers.append(numbers[-1] + numbers[-2])
            goal.publish_feedback(Fibonacci.Feedback(sequence=numbers))
        goal.succeed()
        return Fibonacci.Result(sequence=numbers)


class Motor(LifecycleNode):
    """A node with states."""

    def on_configure(self, _: State) -> TransitionCallbackReturn:
        """Always works."""
        return TransitionCallbackReturn.SUCCESS


def main() -> None:
    """Run all of them until Ctrl-C."""
    rclpy.init()
    executor = MultiThreadedExecutor()
    nodes = [Talker(), Rover(), Ear(), Tuner(), Motor("motor"), Node("_hidden")]
    for node in nodes:
        executor.add_node(node)
    print("ready", flush=True)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


if __name__ == "__main__":
    main()
