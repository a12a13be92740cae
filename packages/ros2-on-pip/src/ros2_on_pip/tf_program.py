"""What the programs about frames share: a node from its start to Ctrl-C."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from threading import Event
from types import FrameType
from typing import NoReturn

import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import NotInitializedException
from rclpy.executors import ExternalShutdownException
from rclpy.utilities import remove_ros_args

from ros2_on_pip.cli import forget_stdout

FAILED = 1

_interrupted = Event()
"""Ctrl-C was pressed. While a message is unpacked, rclpy makes a RuntimeError of it."""


def run(act: Callable[[list[str]], int]) -> int:
    """What `act` returns for the words of the command line that are not ROS's own.

    There is no shutdown at the end. rclpy's signal handler ends the context in a thread of its own.
    It may come between the steps of that call.
    """
    return _until_interrupted(lambda: _begun(act))


def _begun(act: Callable[[list[str]], int]) -> int:
    signal.signal(signal.SIGINT, _interrupt)  # rclpy's handler calls the one before it
    rclpy.init(args=sys.argv)
    return act(remove_ros_args(sys.argv)[1:])


def _interrupt(number: int, frame: FrameType | None) -> NoReturn:
    _interrupted.set()
    raise KeyboardInterrupt


def _until_interrupted(act: Callable[[], int]) -> int:
    """Ctrl-C, or `| head` that has read enough, may come at any moment, and is no error.

    A type that is missing is told in a line.
    """
    try:
        return act()
    except (KeyboardInterrupt, ExternalShutdownException):
        return 0
    except (NotInitializedException, RCLError, RuntimeError):
        if rclpy.ok() and not _interrupted.is_set():
            raise
        return 0
    except BrokenPipeError:
        forget_stdout()
        return 0
    except ImportError as error:
        if "tf2_msgs" not in str(error):
            raise
        print(error, file=sys.stderr)
        return FAILED
