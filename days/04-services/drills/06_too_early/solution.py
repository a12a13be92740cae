"""A visitor: a node called visitor. It calls /what_time (std_srvs/srv/Trigger) once,
writes "The tower says: " and the answer's message, and ends.

The tower is a little slow: it comes up after the visitor.
"""

import rclpy
from std_srvs.srv import Trigger


def main():
    rclpy.init()
    visitor = rclpy.create_node("visitor")
    tower = visitor.create_client(Trigger, "what_time")
    tower.wait_for_service(timeout_sec=5.0)
    future = tower.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(visitor, future)
    print(f"The tower says: {future.result().message}")
    rclpy.shutdown()


main()
