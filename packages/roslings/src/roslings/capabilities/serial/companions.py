"""The board that a node needs which is left running."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack

from roslings.arena import Arena
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.serial.contract import SerialWords
from roslings.course import Card, NodeContract


def board_for(
    node: NodeContract, card: Card, arena: Arena, running: ExitStack
) -> Mapping[str, str]:
    """A rover's board in real time, on an empty floor, for a node with a parameter `port`."""
    names = {parameter.name for parameter in node.of(ParameterWords).parameters}
    if not card.of(SerialWords).board or "port" not in names:
        return {}
    from roslings.capabilities.serial.act import FLOOR, PORT
    from roslings_rover.board import Board, Mega
    from roslings_rover.rover import Rover

    board = running.enter_context(Board(Mega(Rover(FLOOR)), arena.devices / PORT))
    running.enter_context(board.running())
    return {"port": board.name}
