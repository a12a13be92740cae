"""Tell what a bag holds: its topics, its gaps, and how the rover drove."""

import sys

import rosbag2_py

# TODO 3: import what you need besides: deserialize_message from
# rclpy.serialization, and the message type of the drive.


def open_bag(path):
    """Open the bag at this path."""
    reader = rosbag2_py.SequentialReader()
    # TODO 4: open the bag with StorageOptions and ConverterOptions. An empty
    # storage_id lets the reader look how the bag is stored.
    return reader


def read_messages(reader):
    """Return the times of each topic in seconds, and all odometry."""
    # TODO 5: go through all messages, once. For each topic keep the times.
    # Of the drive's topic keep the messages, too; deserialize no other one.


def tell_topic(topic, moments):
    """Write how many messages came, and how often."""
    # TODO 6: reckon the usual period, and print the line of the card.


def tell_gaps(topic, moments, start):
    """Write each time in which the topic was silent for too long."""
    # TODO 7: compare each time between two messages with the usual period.


def tell_drive(odometry):
    """Write how far the rover went, and how fast it was."""
    # TODO 8: add up the ways between two positions; find the largest speed.


def tell(path):
    """Read the bag, write what it holds, and return the exit code."""
    # TODO 9: use the functions above; write the duration. A bag that cannot
    # be opened is a RuntimeError. The card says what to do then, and what to
    # do with a bag without a drive.
    return 0


def main():
    """Tell about the bag whose path stands behind the program's name."""
    if len(sys.argv) < 2:
        print('usage: read_drive PATH')
        return 2
    return tell(sys.argv[1])


if __name__ == '__main__':
    sys.exit(main())
