"""A phone: a node called phone. It gives /charge (rover_interfaces/action/Charge) the
goal 50 percent, waits for the result, prints "charged to 50 percent", and ends."""

import rclpy
from rclpy.action import ActionClient
from rover_interfaces.action import Charge


def main():
    rclpy.init()
    phone = rclpy.create_node("phone")
    charger = ActionClient(phone, Charge, "charge")
    charger.wait_for_server(timeout_sec=5.0)
    future = charger.send_goal_async(Charge.Goal(target=50.0))
    rclpy.spin_until_future_complete(phone, future)
    answer = future.result()
    print(f"charged to {answer.result.level:.0f} percent")
    rclpy.shutdown()


main()
