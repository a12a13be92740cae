"""Says the frames of a rover, puts what its laser sees into them, and draws a map."""

import math

import rclpy
from geometry_msgs.msg import Point32, PolygonStamped, TransformStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from tf2_ros import (
    Buffer,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)

CELL = 0.05  # metres
CELLS = 240  # along each side of the map
WEST = SOUTH = -6.0  # metres: the corner of the map
MOST_WAITING = 10  # scans
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def yaw_of(rotation):
    """Return the turn about z in radians."""
    return 2 * math.atan2(rotation.z, rotation.w)


class Frames(Node):
    """Knows where the rover and its laser are, at each time."""

    def __init__(self):
        super().__init__('frames')
        self.buffer = Buffer(node=self)
        self.listener = TransformListener(self.buffer, self)
        self.moving = TransformBroadcaster(self)
        self.fixed = StaticTransformBroadcaster(self)
        self.waiting = []  # scans whose place is not known yet
        self.cells = [-1] * (CELLS * CELLS)
        self.walls = self.create_publisher(PolygonStamped, 'walls', 10)
        self.map = self.create_publisher(OccupancyGrid, 'map', LATCHED)
        self.create_subscription(Odometry, 'odom', self.hear, 10)
        self.create_subscription(LaserScan, 'scan', self.look, qos_profile_sensor_data)
        self.create_timer(1.0, self.publish_map)
        self.say_where_the_laser_is()

    def say_where_the_laser_is(self):
        """Say once where the laser sits on the rover."""
        step = TransformStamped()
        step.header.stamp = self.get_clock().now().to_msg()
        step.header.frame_id = 'base_link'
        step.child_frame_id = 'laser'
        step.transform.translation.x = self.declare_parameter('laser_x', 0.0).value
        step.transform.translation.y = self.declare_parameter('laser_y', 0.0).value
        yaw = self.declare_parameter('laser_yaw', 0.0).value
        step.transform.rotation.z = math.sin(yaw / 2)
        step.transform.rotation.w = math.cos(yaw / 2)
        self.fixed.sendTransform(step)

    def hear(self, odometry):
        """Say where the rover was; then more scans may have a place."""
        step = TransformStamped()
        step.header = odometry.header
        step.child_frame_id = odometry.child_frame_id
        step.transform.translation.x = odometry.pose.pose.position.x
        step.transform.translation.y = odometry.pose.pose.position.y
        step.transform.rotation = odometry.pose.pose.orientation
        self.moving.sendTransform(step)
        self.waiting = [scan for scan in self.waiting if not self.place(scan)]

    def look(self, scan):
        """Keep the scan: what the rover does meanwhile is told after it."""
        self.waiting = [*self.waiting, scan][-MOST_WAITING:]

    def place(self, scan):
        """Say the walls of a scan; return whether its place was known."""
        try:
            found = self.buffer.lookup_transform(
                'odom', scan.header.frame_id, scan.header.stamp
            )
        except TransformException:
            return False  # not yet, or never
        x, y = found.transform.translation.x, found.transform.translation.y
        yaw = yaw_of(found.transform.rotation)
        walls = PolygonStamped()
        walls.header.frame_id = 'odom'
        walls.header.stamp = scan.header.stamp
        for number, distance in enumerate(scan.ranges):
            if scan.range_min <= distance <= scan.range_max:  # no inf, no NaN
                angle = yaw + scan.angle_min + number * scan.angle_increment
                wall_x = x + distance * math.cos(angle)
                wall_y = y + distance * math.sin(angle)
                walls.polygon.points.append(Point32(x=wall_x, y=wall_y))
                self.draw(x, y, wall_x, wall_y)
        self.walls.publish(walls)
        return True

    def draw(self, x, y, wall_x, wall_y):
        """Mark the cells of one beam: free ones, and the wall at its end."""
        steps = math.ceil(2 * math.hypot(wall_x - x, wall_y - y) / CELL)
        for step in range(steps):
            part = step / steps
            self.mark(x + part * (wall_x - x), y + part * (wall_y - y), 0)
        self.mark(wall_x, wall_y, 100)

    def mark(self, x, y, value):
        """Mark the cell at a place; a wall stays a wall."""
        column = math.floor((x - WEST) / CELL)
        row = math.floor((y - SOUTH) / CELL)
        if 0 <= column < CELLS and 0 <= row < CELLS:
            cell = row * CELLS + column
            self.cells[cell] = max(self.cells[cell], value)

    def publish_map(self):
        """Say all cells, row by row."""
        grid = OccupancyGrid()
        grid.header.stamp = self.get_clock().now().to_msg()
        grid.header.frame_id = 'odom'
        grid.info.resolution = CELL
        grid.info.width = grid.info.height = CELLS
        grid.info.origin.position.x = WEST
        grid.info.origin.position.y = SOUTH
        grid.data = self.cells
        self.map.publish(grid)


def main(args=None):
    """Run the node until Ctrl-C."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Frames())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
