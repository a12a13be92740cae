"""The bridge: wheel speeds from the board to ROS, commands from ROS to the board."""

import math

import rclpy
import serial
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import JointState

from serial_bridge.lines import LineReader, frame
from serial_bridge.wheels import Place, Wheels

LARGEST_PWM = 255
COMMAND_LASTS = 0.5  # seconds
LONGEST_GAP = 0.2  # seconds between two lines that odometry bridges


class SerialBridge(Node):
    """One board on one serial port."""

    def __init__(self):
        super().__init__('serial_bridge')
        self.port_name = self.declare_parameter('port', '/dev/ttyACM0').value
        self.baud = self.declare_parameter('baud', 115200).value
        radius = self.declare_parameter('wheel_radius', 0.035).value
        separation = self.declare_parameter('wheel_separation', 0.16).value
        self.fastest = self.declare_parameter('max_wheel_speed', 17.0).value
        self.wheels = Wheels(radius, separation)
        self.place = Place()
        self.port = None
        self.reader = LineReader()
        self.last_ms = None
        self.motion = (0.0, 0.0)
        self.told = None  # when the last command came
        self.sequence = 0
        self.speed_publisher = self.create_publisher(JointState, 'wheel_speed', 10)
        self.odom_publisher = self.create_publisher(Odometry, 'odom', 10)
        self.create_subscription(Twist, 'cmd_vel', self.take_command, 10)
        self.create_timer(0.01, self.read_board)
        self.create_timer(0.05, self.send_command)
        self.create_timer(0.5, self.connect)
        self.connect()

    def connect(self):
        """Open the port, if it is not open; called again and again."""
        if self.port is not None:
            return
        try:
            self.port = serial.Serial(
                self.port_name,
                self.baud,
                timeout=0,
                write_timeout=0.2,
                exclusive=True,
            )
        except OSError as error:
            self.get_logger().warning(
                f'No board yet: {error}', throttle_duration_sec=5.0
            )
            return
        self.reader = LineReader()
        self.last_ms = None
        self.get_logger().info(f'The board is on {self.port_name}')

    def disconnect(self, error):
        """Give the port up; connect() tries again."""
        self.get_logger().error(f'The board is gone: {error}')
        self.port.close()
        self.port = None

    def read_board(self):
        """Publish what the board says."""
        if self.port is None:
            return
        try:
            piece = self.port.read(4096)
        except OSError as error:
            self.disconnect(error)
            return
        for body in self.reader.feed(piece):
            if body.startswith('W,'):
                _, _, ms, left, right = body.split(',')
                self.publish(int(ms), int(left) / 1000, int(right) / 1000)

    def publish(self, ms, left, right):
        """Publish one line of wheel speeds (rad/s) and the place after it."""
        seconds = 0.0 if self.last_ms is None else (ms - self.last_ms) / 1000
        self.last_ms = ms
        stamp = self.get_clock().now().to_msg()
        speed = JointState(name=['left_wheel', 'right_wheel'], velocity=[left, right])
        speed.header.stamp = stamp
        self.speed_publisher.publish(speed)
        forward, turn = self.wheels.motion_of(left, right)
        if 0.0 < seconds <= LONGEST_GAP:
            self.place.move(forward, turn, seconds)
        self.odom_publisher.publish(self.odometry(stamp, forward, turn))

    def odometry(self, stamp, forward, turn):
        """Make the message for the place and the motion of now."""
        odom = Odometry(child_frame_id='base_link')
        odom.header.stamp = stamp
        odom.header.frame_id = 'odom'
        odom.pose.pose.position.x = self.place.x
        odom.pose.pose.position.y = self.place.y
        odom.pose.pose.orientation.z = math.sin(self.place.heading / 2)
        odom.pose.pose.orientation.w = math.cos(self.place.heading / 2)
        odom.twist.twist.linear.x = forward
        odom.twist.twist.angular.z = turn
        return odom

    def take_command(self, twist):
        """Remember a command, if it is one that a robot can follow."""
        motion = (twist.linear.x, twist.angular.z)
        if not all(math.isfinite(part) for part in motion):
            self.get_logger().warning('A command was no number. It is not followed.')
            return
        self.motion = motion
        self.told = self.get_clock().now()

    def send_command(self):
        """Tell the board the command of now; zero when none came for a while."""
        if self.port is None:
            return
        left, right = self.wheels.speeds_for(*self.motion_of_now())
        too_fast = max(1.0, abs(left) / self.fastest, abs(right) / self.fastest)
        scale = LARGEST_PWM / self.fastest / too_fast
        body = f'M,{self.sequence},{round(left * scale)},{round(right * scale)}'
        self.sequence = (self.sequence + 1) % 65536
        try:
            self.port.write(frame(body))
        except OSError as error:
            self.disconnect(error)

    def motion_of_now(self):
        """The last command while it is fresh, else zero."""
        if self.told is None:
            return 0.0, 0.0
        age = (self.get_clock().now() - self.told).nanoseconds / 1e9
        return self.motion if age < COMMAND_LASTS else (0.0, 0.0)


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(SerialBridge())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
