"""Look at one topic of a bag: its times, its stamps, its frames, its values."""

import sys

# TODO 10: import what you need besides: your own open_bag from
# black_box.read_drive, deserialize_message from rclpy.serialization, and
# get_message from rosidl_runtime_py.utilities.


def messages_of(path, topic):
    """Return the second at which the bag begins, and the messages of a topic.

    Each message comes with the second at which it was recorded.
    """
    # TODO 11: open_bag gives the reader. Go through the bag, once. The list of
    # topics tells the name of the type, and get_message its class.
    return 0.0, []


def tell_times(start, found):
    """Write how long after the start the first and the last message came."""
    # TODO 12: two numbers. Does this topic end before the others do?


def tell_stamps(found):
    """Write how old the first, the middle and the last message was."""
    # TODO 13: the age is the second at which a message was recorded, less its
    # stamp. A stamp has whole seconds (sec) and the rest (nanosec).


def tell_frames(found):
    """Write each frame_id, and how many messages have it."""
    # TODO 14: collections.Counter counts for you.


def tell_values(found, field):
    """Write the smallest and the largest value of a field."""
    # TODO 15: value_of gives the value of one message.


def value_of(message, field):
    """Return a field such as 'linear.x', or an element such as 'velocity.0'."""
    for part in field.split('.'):
        message = message[int(part)] if part.isdigit() else getattr(message, part)
    return message


def main():
    """Look at the topic whose name stands behind the path of the bag."""
    if len(sys.argv) < 3:
        print('usage: python3 look.py BAG TOPIC [FIELD ...]')
        return 2
    path, topic, *fields = sys.argv[1:]
    start, found = messages_of(path, topic)
    if not found:
        print(f'no message on {topic}')
        return 1
    tell_times(start, found)
    if hasattr(found[0][1], 'header'):
        tell_stamps(found)
        tell_frames(found)
    for field in fields:
        tell_values(found, field)
    return 0


if __name__ == '__main__':
    sys.exit(main())
