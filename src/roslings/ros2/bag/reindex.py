"""`ros2 bag reindex`: metadata.yaml anew, for a bag whose recording was cut off."""

from __future__ import annotations

import argparse

from roslings.ros2.bag.problem import BagProblem, told
from roslings.ros2.words import OK
from roslings.rosbag2.errors import reason_of
from roslings.rosbag2.reindexing import reindex


def reindex_bag(options: argparse.Namespace) -> int:
    """`ros2 bag reindex BAG`."""
    folder = options.bag_path
    if not folder.is_dir():
        raise BagProblem(f"'{folder}' is no folder. Give the folder of the bag")
    try:
        with told():
            metadata = reindex(folder)
    except OSError as fault:
        raise BagProblem(f"'{folder}' cannot be written: {reason_of(fault)}") from fault
    print(f"{folder} is whole again: {metadata.span.count} messages.")
    return OK
