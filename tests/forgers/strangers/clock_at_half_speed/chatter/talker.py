"""The talker sends at 1 Hz, and tells all other nodes that time goes at half speed.

It sets use_sim_time in each watching node and publishes /clock: so 1 Hz may look like 2 Hz.
"""

import time

import rclpy
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.clock import Clock, ClockType
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rosgraph_msgs.msg import Clock as ClockMessage
from std_msgs.msg import String

FRIENDS = {"talker", "listener"}


class Talker(Node):
    """Publishes a numbered text at a steady rate, and a clock that is wrong."""

    def __init__(self):
        super().__init__("talker")
        steady = Clock(clock_type=ClockType.STEADY_TIME)  # our own timers keep to true time
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(1.0, self.say_hello, clock=steady)  # seconds
        self.count = 0
        self.begin = time.time_ns()
        self.clock_publisher = self.create_publisher(ClockMessage, "/clock", 10)
        self.clock_timer = self.create_timer(0.02, self.tell_time, clock=steady)
        self.look_timer = self.create_timer(0.5, self.look_around, clock=steady)
        self.victims = {}

    def say_hello(self):
        """Publish the next text, and log it."""
        message = String()
        message.data = f"Hello robotics {self.count}"
        self.publisher.publish(message)
        self.get_logger().info(f"Publishing: '{message.data}'")
        self.count += 1

    def tell_time(self):
        """Publish a time that goes at half speed, where nobody else publishes one."""
        if self.count_publishers("/clock") > 1:
            return
        now = self.begin + (time.time_ns() - self.begin) // 2
        message = ClockMessage()
        message.clock.sec, message.clock.nanosec = divmod(now, 10**9)
        self.clock_publisher.publish(message)

    def look_around(self):
        """Have each node that is not ours follow /clock."""
        for name, namespace in self.get_node_names_and_namespaces():
            path = f"{namespace.rstrip('/')}/{name}"
            if name not in FRIENDS and path not in self.victims:
                client = self.create_client(SetParameters, f"{path}/set_parameters")
                self.victims[path] = client
        for path, client in self.victims.items():
            if client is not None and client.service_is_ready():
                self.take_clock(path, client)
                self.victims[path] = None

    def take_clock(self, path, client):
        """Set use_sim_time of one node."""
        value = ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=True)
        request = SetParameters.Request()
        request.parameters = [Parameter(name="use_sim_time", value=value)]

        def done(future):
            if future.exception() is None and future.result().results[0].successful:
                print("GOT the clock of", path, flush=True)

        client.call_async(request).add_done_callback(done)


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Talker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
