"""The distance subscriber: says how far it is, and warns of obstacles."""

import math

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import Range
from std_msgs.msg import Bool

NEAR = 0.30  # m: nearer than this is an obstacle
CLEAR = 0.40  # m: farther than this is none


class DistanceSubscriber(Node):
    """Hears each distance, and publishes whether something is in the way."""

    def __init__(self):
        super().__init__('distance_subscriber')
        self.obstacle = False
        topic = 'distance_sensor/distance'
        self.create_subscription(Range, topic, self.hear_distance, 10)
        self.publisher = self.create_publisher(Bool, 'obstacle', 10)

    def hear_distance(self, reading):
        """Judge one distance. NaN changes nothing: it says nothing."""
        if reading.range < NEAR:
            self.obstacle = True
        elif reading.range > CLEAR:
            self.obstacle = False
        if math.isfinite(reading.range):
            self.get_logger().info(f'Distance: {round(reading.range * 1000)} mm')
        self.publisher.publish(Bool(data=self.obstacle))


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(DistanceSubscriber())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
