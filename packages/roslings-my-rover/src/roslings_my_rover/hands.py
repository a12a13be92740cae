"""The keys of my rover: driving as always, Space for the stop, p for the cable, f for the ball."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from ros2_on_pip.keyboard import Keys, NoKeys, keys_of
from roslings_rover.rover.keys import KeyboardDriver, NoTerminal, keyboard_node

SPACE, CABLE, BALL = " ", "p", "f"
TOLD = "Space: stop (day 10), p: cable (6), f: ball (7), q and z: faster and slower."


class OwnKeys(KeyboardDriver):
    """Drives, and besides does what a rover of parts can."""

    def __init__(self, node: Any, keys: Keys, own: dict[str, Callable[[], None]]) -> None:
        super().__init__(node, keys)
        self._own = own

    def press(self, key: str) -> None:
        """One of ours, or one that drives."""
        if key in self._own:
            self._own[key]()
        else:
            super().press(key)


class Button:
    """Presses and releases the student's stop, by its service."""

    def __init__(self, node: Any, tell: Callable[[str], None]) -> None:
        from std_srvs.srv import SetBool

        self._request = SetBool.Request
        self._client = node.create_client(SetBool, "/press")
        self._tell, self._pressed = tell, True

    def toggle(self) -> None:
        """The button begins pressed: the first Space releases it."""
        if not self._client.service_is_ready():
            self._tell("Nobody serves /press: no guard is in your rover.")
            return
        self._pressed = not self._pressed
        self._client.call_async(self._request(data=self._pressed))
        self._tell("Space: stop is pressed." if self._pressed else "Space: stop is released.")


@contextmanager
def hands(
    wanted: bool,
    tell: Callable[[str], None],
    pull: Callable[[], None],
    follow: Callable[[], None],
) -> Iterator[Callable[[], None]]:
    """What looks for keys in this terminal, where they are wanted. Raises NoTerminal."""
    if not wanted:
        yield lambda: None
        return
    try:
        with keys_of() as keys, keyboard_node() as node:
            own = {SPACE: Button(node, tell).toggle, CABLE: pull, BALL: follow}
            yield OwnKeys(node, keys, own).look
    except NoKeys as error:
        raise NoTerminal(error) from error
