"""The distance sensor: turns the time of a sonar's echo into a distance."""

import math

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import Range
from std_msgs.msg import Float64

SPEED_OF_SOUND = 343.0  # m/s, in air of 20 degrees
MIN_RANGE = 0.02  # m
MAX_RANGE = 4.0


class DistanceSensor(Node):
    """Hears how long each echo took, and publishes the distance at a steady rate."""

    def __init__(self):
        super().__init__('distance_sensor')
        self.distance = math.nan  # nothing is known before the first echo
        self.create_subscription(Float64, 'sonar_echo', self.hear_echo, 10)
        self.publisher = self.create_publisher(Range, 'distance_sensor/distance', 10)
        self.timer = self.create_timer(0.1, self.tell_distance)  # seconds

    def hear_echo(self, echo):
        """Keep the distance that belongs to an echo's time, in seconds."""
        self.distance = echo.data * SPEED_OF_SOUND / 2  # there and back

    def tell_distance(self):
        """Publish the distance; what is out of range is infinite (REP 117)."""
        reading = Range()
        reading.header.stamp = self.get_clock().now().to_msg()
        reading.header.frame_id = 'sonar_link'
        reading.radiation_type = Range.ULTRASOUND
        reading.field_of_view = 0.26
        reading.min_range = MIN_RANGE
        reading.max_range = MAX_RANGE
        reading.range = self.distance
        if self.distance < MIN_RANGE:
            reading.range = -math.inf
        elif self.distance > MAX_RANGE:
            reading.range = math.inf
        self.publisher.publish(reading)


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(DistanceSensor())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
