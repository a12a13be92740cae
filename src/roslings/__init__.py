"""The engine of roslings: stages, watches, judges and explains ROS 2 nodes."""

__version__ = "0.1.0"
