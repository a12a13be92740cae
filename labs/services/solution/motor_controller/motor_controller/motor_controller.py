"""The motor controller: limits the rover's speed, and takes the limit away."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

FULL_SPEED = 1.0  # m/s
LIMITED_SPEED = 0.3


class MotorController(Node):
    """Keeps the maximum speed, serves those who change it, and publishes it."""

    def __init__(self):
        super().__init__('motor_controller')
        self.max_speed = FULL_SPEED
        self.create_service(SetBool, 'set_max_speed', self.set_max_speed)
        self.create_service(Trigger, 'reset', self.reset)
        self.publisher = self.create_publisher(Float64, 'motor_state', 10)
        self.timer = self.create_timer(0.1, self.tell_state)  # seconds

    def set_max_speed(self, request, response):
        """Switch the limit on (true) or off (false)."""
        self.max_speed = LIMITED_SPEED if request.data else FULL_SPEED
        response.success = True
        response.message = f'max speed: {self.max_speed} m/s'
        return response

    def reset(self, request, response):
        """Take the limit away, where there is one."""
        if self.max_speed == FULL_SPEED:
            response.success = False
            response.message = 'nothing to reset'
            return response
        self.max_speed = FULL_SPEED
        response.success = True
        response.message = 'the limit is off'
        return response

    def tell_state(self):
        """Publish the maximum speed that holds now."""
        state = Float64()
        state.data = self.max_speed
        self.publisher.publish(state)


def main(args=None):
    """Run the server until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(MotorController())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
