"""A main that puts nodes together from a list, as a launch file does."""

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from std_msgs.msg import String


def talker():
    """A node that talks."""
    node = rclpy.create_node("talker")
    voice = node.create_publisher(String, "chatter", 10)
    state = {"count": 0}

    def talk():
        voice.publish(String(data=f"Hello robotics {state['count']}"))
        state["count"] += 1

    node.create_timer(0.5, talk)
    return node


def listener():
    """A node that listens."""
    node = rclpy.create_node("listener")
    node.create_subscription(String, "chatter", lambda _: None, 10)
    return node


PLAN = [talker, listener]

rclpy.init()
executor = SingleThreadedExecutor()
nodes = [make() for make in PLAN]
for each in nodes:
    executor.add_node(each)
try:
    executor.spin()
except (KeyboardInterrupt, ExternalShutdownException):
    pass
finally:
    rclpy.try_shutdown()
