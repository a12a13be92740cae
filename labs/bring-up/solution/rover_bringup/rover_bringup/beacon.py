"""The beacon: says again and again which rover this is."""

import rclpy
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Beacon(Node):
    """Publishes the rover's name, so many times a second."""

    def __init__(self):
        super().__init__('beacon')
        fixed = ParameterDescriptor(read_only=True)
        self.declare_parameter('rover_name', 'rover', fixed)
        whole = IntegerRange(from_value=1, to_value=50, step=1)
        limits = ParameterDescriptor(integer_range=[whole])
        self.declare_parameter('beat_rate', 5, limits)  # messages a second
        self.publisher = self.create_publisher(String, 'beacon', 10)
        self.timer = self.new_timer()
        self.add_post_set_parameters_callback(self.follow)

    def new_timer(self):
        """Make the timer that the parameter asks for."""
        rate = self.get_parameter('beat_rate').value
        return self.create_timer(1 / rate, self.tell)

    def follow(self, parameters):
        """Act on parameters that were set; what is refused never comes here."""
        if any(parameter.name == 'beat_rate' for parameter in parameters):
            self.destroy_timer(self.timer)
            self.timer = self.new_timer()

    def tell(self):
        """Publish the name."""
        self.publisher.publish(String(data=self.get_parameter('rover_name').value))


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Beacon())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
