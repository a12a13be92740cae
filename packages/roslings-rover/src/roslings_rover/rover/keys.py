"""Drive the rover by the keys of its own terminal: a node beside it, which says /cmd_vel."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from ros2_on_pip.keyboard import Hands, Keys, NoKeys, Steering, keys_of
from roslings_rover.errors import DeviceTrouble
from roslings_rover.rover.messages import QUIET

NAME = "keyboard"


class NoTerminal(DeviceTrouble):
    """`--keys` was asked for where no keys can be read."""

    def __init__(self, error: NoKeys) -> None:
        super().__init__(f"--keys: {error}")


class KeyboardDriver:
    """Says on /cmd_vel what was pressed."""

    def __init__(self, node: Any, keys: Keys) -> None:
        from geometry_msgs.msg import Twist

        self._make, self._keys, self._hands = Twist, keys, Hands()
        self._publisher = node.create_publisher(Twist, "cmd_vel", 10)

    def look(self) -> None:
        """Follow the key that was pressed since the last look."""
        if key := self._keys.next(0.0):
            self.press(key)

    def press(self, key: str) -> None:
        """Say what this key says."""
        self._hands = self._hands.press(key)
        self._say(self._hands.steering)

    def _say(self, steering: Steering) -> None:
        twist = self._make()
        twist.linear.x, twist.angular.z = steering.forward_m_s, steering.turn_rad_s
        self._publisher.publish(twist)


@contextmanager
def driving(wanted: bool) -> Iterator[Callable[[], None]]:
    """What looks for keys, in the terminal of this program. Raises NoTerminal."""
    if not wanted:
        yield _look_for_nothing
        return
    try:
        with keys_of() as keys, keyboard_node() as node:
            yield KeyboardDriver(node, keys).look
    except NoKeys as error:
        raise NoTerminal(error) from error


def _look_for_nothing() -> None:
    """Nobody asked for keys."""


@contextmanager
def keyboard_node() -> Iterator[Any]:
    """A node of its own context, until the block ends; nothing spins it."""
    import rclpy
    from rclpy.signals import SignalHandlerOptions

    context = rclpy.Context()
    rclpy.init(args=QUIET, context=context, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node(NAME, context=context)
    try:
        yield node
    finally:
        node.destroy_node()
        context.try_shutdown()
