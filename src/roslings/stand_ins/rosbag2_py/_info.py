"""What `ros2 bag info` shows."""

from __future__ import annotations

from pathlib import Path

from roslings.rosbag2.reading import opened

from ._errors import as_runtime_error
from ._storage import BagMetadata, from_bag


class Info:
    """Looks into a bag."""

    def read_metadata(self, uri: str, storage_id: str) -> BagMetadata:
        """What the bag at `uri` holds; printed, it is the text of `ros2 bag info`.

        Raises RuntimeError.
        """
        with as_runtime_error(), opened(Path(uri)) as reader:
            return from_bag(reader.metadata)
