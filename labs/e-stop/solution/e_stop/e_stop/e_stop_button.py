"""The button: tells everybody whether the rover must stand still."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)
from std_msgs.msg import Bool
from std_srvs.srv import SetBool

LATCHED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
    liveliness=LivelinessPolicy.AUTOMATIC,
    liveliness_lease_duration=Duration(seconds=2.0),
)


class EStopButton(Node):
    """Keeps the last press for those who come late."""

    def __init__(self):
        super().__init__('e_stop_button')
        self.publisher = self.create_publisher(Bool, 'e_stop', LATCHED)
        self.create_service(SetBool, 'press', self.press)
        self.tell(True)  # nobody has released it yet

    def press(self, request, response):
        """Press (true) or release (false)."""
        self.tell(request.data)
        response.success = True
        response.message = 'pressed' if request.data else 'released'
        return response

    def tell(self, pressed):
        """Publish what holds from now on."""
        state = Bool()
        state.data = pressed
        self.publisher.publish(state)


def main(args=None):
    """Run the button until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(EStopButton())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
