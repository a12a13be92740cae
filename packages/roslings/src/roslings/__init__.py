"""The engine of roslings: stages, watches, judges and explains ROS 2 nodes."""

from roslings_launcher import __version__

__all__ = ["__version__"]
