"""The distance subscriber: says how far it is, and warns of obstacles.

Go on here when the sensor publishes distances.
"""

# TODO 10: import what you need, as in distance_sensor.py.


# TODO 11: make this class a Node, as in distance_sensor.py.
class DistanceSubscriber:
    """Hears each distance, and publishes whether something is in the way."""

    # TODO 12: write __init__. Give the node its name from the card. Create a
    #          subscription to the distance, with self.hear_distance, and a
    #          publisher for the warning. Keep self.obstacle; it starts False.

    def hear_distance(self, reading):
        """Judge one distance. NaN changes nothing: it says nothing."""
        # TODO 13: nearer than the first number of the card: an obstacle.
        #          Farther than the second one: none. Between: as before.
        # TODO 14: log the distance in whole millimetres, but only where
        #          math.isfinite(reading.range) is true.
        # TODO 15: publish self.obstacle, once for each distance that comes in.


def main(args=None):
    """Run the node until Ctrl-C."""
    # TODO 16: the same as in distance_sensor.py, for the DistanceSubscriber.


if __name__ == '__main__':
    main()
