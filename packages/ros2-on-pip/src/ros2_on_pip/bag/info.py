"""`ros2 bag info`: what is in a bag."""

from __future__ import annotations

import argparse

from ros2_on_pip.bag.problem import told
from ros2_on_pip.rosbag2.reading import opened, read_metadata
from ros2_on_pip.rosbag2.summary import events_in, lines_of, names_of
from ros2_on_pip.words import OK


def show_info(options: argparse.Namespace) -> int:
    """`ros2 bag info BAG`."""
    path, seen = options.bag_path, None
    with told():
        if path.is_dir() and not options.verbose:
            metadata = read_metadata(path)
        else:
            with opened(path) as reader:
                metadata = reader.metadata
                seen = events_in(reader) if options.verbose else None
    lines = names_of(metadata) if options.topic_name else lines_of(metadata, options.sort, seen)
    print("\n".join(lines))
    return OK
