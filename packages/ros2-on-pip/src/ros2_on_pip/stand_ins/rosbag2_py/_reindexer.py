"""What `ros2 bag reindex` does."""

from __future__ import annotations

from ros2_on_pip.rosbag2.reindexing import reindex

from ._errors import as_runtime_error, path_of
from ._storage import StorageOptions


class Reindexer:
    """Writes metadata.yaml anew."""

    def reindex(self, storage_options: StorageOptions) -> None:
        """From the files of the bag at `uri`, all stored as `storage_id` says where it says so.

        Raises RuntimeError.
        """
        with as_runtime_error():
            reindex(path_of(storage_options.uri), storage_options.storage_id)
