"""The almanac: it tells the tides to whoever asks, however late, and warns of gales."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile
from std_msgs.msg import Float64, Int32

TIDES_CM = (140, 320, 95, 410, 180)


class Almanac(Node):
    """Says all tides at its start, and keeps the last three."""

    def __init__(self):
        super().__init__('almanac')
        kept = QoSProfile(
            depth=3,
            durability=DurabilityPolicy.TRANSIENT_LOCAL,
            liveliness_lease_duration=Duration(seconds=2.5),
        )
        self.tides = self.create_publisher(Int32, 'tides', kept)
        for height in TIDES_CM:
            self.tides.publish(Int32(data=height))
        alive = QoSProfile(
            depth=10,
            deadline=Duration(seconds=1.5),
            liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
            liveliness_lease_duration=Duration(seconds=4.0),
        )
        self.create_subscription(Float64, 'wind', self.hear, alive)

    def hear(self, wind):
        """Warn when it blows."""
        if wind.data > 20.0:
            self.get_logger().info(f'gale: {wind.data:.1f}')


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Almanac())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
