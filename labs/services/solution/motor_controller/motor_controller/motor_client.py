"""The motor client: asks once for the speed limit, says the answer, and ends."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_srvs.srv import SetBool


class MotorClient(Node):
    """Asks the motor controller to switch the limit on."""

    def __init__(self):
        super().__init__('motor_client')
        self.client = self.create_client(SetBool, 'set_max_speed')

    def limit_speed(self):
        """Ask, wait for the answer and log it; False where there is no server."""
        if not self.client.wait_for_service(timeout_sec=2.0):
            self.get_logger().error('No server for /set_max_speed')
            return False
        request = SetBool.Request()
        request.data = True
        future = self.client.call_async(request)
        rclpy.spin_until_future_complete(self, future)
        self.get_logger().info(f"Answer: '{future.result().message}'")
        return True


def main(args=None):
    """Ask once; the exit code is 0 after an answer, and 1 without a server."""
    try:
        rclpy.init(args=args)
        return 0 if MotorClient().limit_speed() else 1
    except (KeyboardInterrupt, ExternalShutdownException):
        return 1
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    raise SystemExit(main())
