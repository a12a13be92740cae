"""What is wrong with a bag, as `ros2 bag` says it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.rosbag2.errors import BagError


class BagProblem(CommandProblem):
    """An error about the bag, in the form of the real command."""

    def __init__(self, error: BagError | str) -> None:
        super().__init__(f"[ERROR] [ros2bag]: {error}")


class WrongBagOptions(CommandProblem):
    """Options that say nothing together."""

    exit_code = 2

    def __init__(self, text: str) -> None:
        super().__init__(f"[ERROR] [ros2bag]: {text}")


class NotInBag(CommandProblem):
    """The bag has no such topic."""

    def __init__(self, topic: str, there: list[str]) -> None:
        super().__init__(
            f"[ERROR] [ros2bag]: the bag has no topic '{topic}'.{did_you_mean(topic, there)}"
            f" It has: {', '.join(there)}"
        )


@contextmanager
def told() -> Iterator[None]:
    """An error about a bag in the block is a problem of the command. Raises BagProblem."""
    try:
        yield
    except BagError as error:
        raise BagProblem(error) from error
