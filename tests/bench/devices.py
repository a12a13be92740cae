"""Prints figures of the stand-ins for hardware; asserts nothing.

    .venv/bin/python tests/bench/devices.py [LINES]

LINES is how many lines each board is to send in real time, at 50 a second (10,000 without it).
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

import serial

from roslings.course import root
from roslings_rover.board import Board, Chip, DriveCommand, LineReader, Mega, Speeds
from roslings_rover.camera import SyntheticCamera
from roslings_rover.emulated import EmulatedMega, built, missing
from roslings_rover.rover import Rover

SKETCH = root() / "labs" / "serial-bridge" / "firmware" / "rover_mega" / "rover_mega.ino"
COMMANDS = 300
FRAMES = 500


@contextmanager
def emulated() -> Iterator[Chip]:
    """The sketch."""
    with EmulatedMega(built(SKETCH)) as chip:
        yield chip


@contextmanager
def in_python() -> Iterator[Chip]:
    """The board in Python alone."""
    yield Mega(Rover())


def lines_lost(host: serial.Serial, wanted: int) -> tuple[int, int, float]:
    """Lines lost, lines rejected, and the rate in Hz over the whole time."""
    reader, told = LineReader(), list[Speeds]()
    began_s = time.monotonic()
    while len(told) < wanted:
        bodies = reader.feed(host.read(host.in_waiting or 1))
        told += [Speeds.read(body) for body in bodies if body.startswith("W,")]
    rate_hz = len(told) / (time.monotonic() - began_s)
    return told[-1].seq - told[0].seq + 1 - len(told), reader.rejected, rate_hz


def latencies_ms(host: serial.Serial) -> list[float]:
    """From writing a command to reading that it was accepted, in milliseconds, sorted."""
    reader, found = LineReader(), list[float]()
    for seq in range(COMMANDS):
        began_s = time.perf_counter()
        host.write(DriveCommand(seq, seq % 256, 0).line())
        while f"A,{seq}" not in reader.feed(host.read(host.in_waiting or 1)):
            continue
        found.append((time.perf_counter() - began_s) * 1000)
        time.sleep(0.007)  # not in step with the board's own lines
    return sorted(found)


def measure(name: str, chip: Chip, lines: int) -> None:
    """Print the figures of one board."""
    cpu_s, began_s = time.process_time(), time.monotonic()
    with (
        Board(chip) as board,
        board.running(),
        serial.Serial(board.name, 115200, timeout=1) as host,
    ):
        lost, rejected, rate_hz = lines_lost(host, lines)
        trips = latencies_ms(host)
    share = (time.process_time() - cpu_s) / (time.monotonic() - began_s)
    print(f"{name}: {lost} of {lines} lines lost, {rejected} rejected, {rate_hz:.2f} Hz")
    p50, p95 = trips[len(trips) // 2], trips[int(len(trips) * 0.95)]
    print(f"{name}: command to answer {p50:.1f} ms p50, {p95:.1f} ms p95, {COMMANDS} commands")
    print(f"{name}: {share:.0%} of a core for reader and board (without the emulator itself)")


def frames() -> None:
    """Print how many frames a second the camera can draw, and its share of a core at 10 Hz."""
    camera, rover = SyntheticCamera(), Rover()
    for encoding in ("rgb8", "bgr8", "mono8"):
        camera.encoding = encoding  # type: ignore[assignment]
        began_s = time.process_time()
        for _ in range(FRAMES):
            camera.look(rover)
        each_s = (time.process_time() - began_s) / FRAMES
        print(
            f"camera, 640x480 {encoding}: {1 / each_s:.0f} frames a second,"
            f" {each_s * 10:.1%} of a core at 10 Hz"
        )


def main(lines: int) -> None:
    """All figures."""
    frames()
    with in_python() as chip:
        measure("board in Python", chip, lines)
    if lacking := missing():
        print(f"emulated board: left out, needs {', '.join(lacking)}")
        return
    with emulated() as chip:
        measure("emulated board", chip, lines)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000)
