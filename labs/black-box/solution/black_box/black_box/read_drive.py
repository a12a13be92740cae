"""Tell what a bag holds: its topics, its gaps, and how the rover drove."""

import math
import statistics
import sys

import rosbag2_py
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message

ODOMETRY = '/odom'
GAP_PERIODS = 4.0


def open_bag(path):
    """Open the bag at this path."""
    reader = rosbag2_py.SequentialReader()
    storage = rosbag2_py.StorageOptions(uri=path, storage_id='')
    reader.open(storage, rosbag2_py.ConverterOptions('', ''))
    return reader


def read_messages(reader):
    """Return the times of each topic in seconds, and all odometry."""
    times = {topic.name: [] for topic in reader.get_all_topics_and_types()}
    odometry = []
    while reader.has_next():
        topic, data, time_ns = reader.read_next()
        times[topic].append(time_ns / 1e9)
        if topic == ODOMETRY:
            odometry.append(deserialize_message(data, Odometry))
    return times, odometry


def usual_period(moments):
    """Return the median of the times between two messages, in seconds."""
    between = [later - earlier for earlier, later in zip(moments, moments[1:])]
    return statistics.median(between) if between else 0.0


def tell_topic(topic, moments):
    """Write how many messages came, and how often."""
    period = usual_period(moments)
    rate = 1.0 / period if period else 0.0
    print(f'topic {topic}: {len(moments)} messages, {rate:.2f} Hz')


def tell_gaps(topic, moments, start):
    """Write each time in which the topic was silent for too long."""
    longest = GAP_PERIODS * usual_period(moments)
    for earlier, later in zip(moments, moments[1:]):
        silence = later - earlier
        if silence > longest:
            print(f'gap {topic}: {silence:.2f} s, from {earlier - start:.2f} s')


def tell_drive(odometry):
    """Write how far the rover went, and how fast it was."""
    distance = 0.0
    places = [message.pose.pose.position for message in odometry]
    for here, there in zip(places, places[1:]):
        distance += math.hypot(there.x - here.x, there.y - here.y)
    speeds = [abs(message.twist.twist.linear.x) for message in odometry]
    print(f'distance: {distance:.2f} m')
    print(f'top speed: {max(speeds):.2f} m/s')


def tell(path):
    """Read the bag, write what it holds, and return the exit code."""
    try:
        reader = open_bag(path)
    except RuntimeError:
        print(f'no bag: {path}')
        return 1
    times, odometry = read_messages(reader)
    if not odometry:
        print(f'no drive: no message on {ODOMETRY}')
        return 2
    every = [moment for moments in times.values() for moment in moments]
    start = min(every)
    print(f'duration: {max(every) - start:.2f} s')
    for topic, moments in times.items():
        tell_topic(topic, moments)
        tell_gaps(topic, moments, start)
    tell_drive(odometry)
    return 0


def main():
    """Tell about the bag whose path stands behind the program's name."""
    if len(sys.argv) < 2:
        print('usage: read_drive PATH')
        return 2
    return tell(sys.argv[1])


if __name__ == '__main__':
    sys.exit(main())
