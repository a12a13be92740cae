"""The arithmetic of a robot with two wheels. Metres, seconds, radians."""


class Wheels:
    """Turns motions into wheel speeds, and wheel speeds into motions."""

    def __init__(self, radius, separation):
        self.radius = radius
        self.separation = separation

    def speeds_for(self, forward, turn):
        """Left and right wheel speed in rad/s for a motion in m/s and rad/s."""
        # TODO 5: a wheel's way is its angle times its radius. When the robot turns
        #         left, the right wheel runs turn x separation / 2 faster than the
        #         robot's middle, the left wheel as much slower.
        return 0.0, 0.0

    def motion_of(self, left, right):
        """Motion in m/s and rad/s for two wheel speeds in rad/s."""
        # TODO 6: the other way round. Forward is the mean of both wheels, turn is
        #         their difference, divided by the separation.
        return 0.0, 0.0


class Place:
    """Where the robot is, when it started at zero."""

    def __init__(self):
        self.x = 0.0
        self.y = 0.0
        self.heading = 0.0

    def move(self, forward, turn, seconds):
        """Go on for a short time."""
        # TODO 7: add the turn to the heading, and the way to x and y. The way's
        #         direction is the heading in the middle of this short time.
