"""What `ros2 bag reindex` does."""

from __future__ import annotations

from pathlib import Path

from roslings.rosbag2.reindexing import reindex

from ._errors import as_runtime_error
from ._storage import StorageOptions


class Reindexer:
    """Writes metadata.yaml anew."""

    def reindex(self, storage_options: StorageOptions) -> None:
        """From the files of the bag at `uri`. Raises RuntimeError."""
        with as_runtime_error():
            reindex(Path(storage_options.uri))
