"""The rover's Arduino Mega on a serial port: what stands at the other end of the cable.

Two boards keep one contract (tests/devices/test_devices_contract.py): `Mega`, in Python alone,
and `roslings_rover.emulated`, which runs the real sketch. `Board` puts either on a
pseudo-terminal, in real time or step by step, and can spoil the line between it and the host.
"""

from roslings_rover.board.mega import Mega
from roslings_rover.board.on_pty import Board, Chunk
from roslings_rover.board.spoil import Spoiler
from roslings_rover.chip import Applied, Chip, Counts, Truth
from roslings_rover.models.board_lines import (
    BadLine,
    DriveCommand,
    LineReader,
    Speeds,
    framed,
    unframed,
)

__all__ = [
    "Applied",
    "BadLine",
    "Board",
    "Chip",
    "Chunk",
    "Counts",
    "DriveCommand",
    "LineReader",
    "Mega",
    "Speeds",
    "Spoiler",
    "Truth",
    "framed",
    "unframed",
]
