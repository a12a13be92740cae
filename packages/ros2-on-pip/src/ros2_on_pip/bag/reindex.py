"""`ros2 bag reindex`: metadata.yaml anew, for a bag whose recording was cut off."""

from __future__ import annotations

import argparse

from ros2_on_pip.bag.problem import BagProblem, told
from ros2_on_pip.rosbag2.errors import reason_of
from ros2_on_pip.rosbag2.reindexing import reindex
from ros2_on_pip.words import OK


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
