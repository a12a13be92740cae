"""Says the frames of a rover, puts what its laser sees into them, and draws a map.

Do the TODOs in the order of their numbers. The names and numbers that you need
stand on the card, in labs/frames/task.md.
"""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

# TODO 3: import math, the messages of the card, TransformStamped and Point32 of
#         geometry_msgs, and the QoS profile for sensors. Of tf2_ros: Buffer,
#         TransformListener, TransformException, and both broadcasters.

# TODO 11: numbers of the map: how wide a cell is, how many there are along each
#          side, and where the corner of the first cell lies in odom.


def yaw_of(rotation):
    """Return the turn about z in radians."""
    # TODO 7: as on day 6.
    return 0.0


class Frames(Node):
    """Knows where the rover and its laser are, at each time."""

    def __init__(self):
        # TODO 4: the name of the card. A buffer and its listener, both broadcasters,
        #         an empty list of scans that wait, a publisher for the walls.
        #         Subscriptions: /odom calls self.hear, /scan calls self.look.
        #         Then call self.say_where_the_laser_is().
        # TODO 12: all cells of the map, a publisher that keeps the last map, and a
        #          timer that calls self.publish_map.
        super().__init__('change_me')

    def say_where_the_laser_is(self):
        """Say once where the laser sits on the rover."""
        # TODO 5: declare the three parameters. Fill a TransformStamped: parent, child,
        #         x, y, and the rotation of the yaw. Send it by the broadcaster for
        #         what never moves.

    def hear(self, odometry):
        """Say where the rover was; then more scans may have a place."""
        # TODO 6: fill a TransformStamped with what the odometry says, its stamp, too,
        #         and send it by the other broadcaster.
        # TODO 10: try the scans that wait once more: self.place(scan) is True where
        #          the place was known.

    def look(self, scan):
        """Keep the scan: what the rover does meanwhile is told after it."""
        # TODO 8: put it to the scans that wait. Do not keep more than ten.

    def place(self, scan):
        """Say the walls of a scan; return whether its place was known."""
        # TODO 9: where was the laser in odom, at the time of the scan? Ask the buffer.
        #         When it raises a TransformException, the place is not known.
        #         Each distance of the scan becomes a point: turn it and shift it to
        #         where the laser was. What is no distance becomes none.
        # TODO 13: draw the beam of each point.
        return False

    def draw(self, x, y, wall_x, wall_y):
        """Mark the cells of one beam: free ones, and the wall at its end."""
        # TODO 14: go from (x, y) to the wall in steps of half a cell.

    def mark(self, x, y, value):
        """Mark the cell at a place; a wall stays a wall."""
        # TODO 15: which column and which row is it? What lies outside is left out.

    def publish_map(self):
        """Say all cells, row by row."""
        # TODO 16: fill an OccupancyGrid: header, info and data.


def main(args=None):
    """Run the node until Ctrl-C."""
    # This part is complete.
    try:
        rclpy.init(args=args)
        rclpy.spin(Frames())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
