"""What `ros2 bag info` shows."""

from __future__ import annotations

from ros2_on_pip.rosbag2.reading import opened, read_metadata

from ._errors import as_runtime_error, path_of, require_text
from ._storage import BagMetadata, from_bag


class Info:
    """Looks into a bag."""

    def read_metadata(self, uri: str, storage_id: str) -> BagMetadata:
        """What the bag at `uri` holds; printed, it is the text of `ros2 bag info`.

        Of a folder, metadata.yaml tells it, whatever `storage_id` is; a single file must be stored
        as `storage_id` says. Raises RuntimeError.
        """
        require_text(uri, "uri")
        require_text(storage_id, "storage_id")
        with as_runtime_error():
            path = path_of(uri)
            if path.is_dir():
                return from_bag(read_metadata(path))
            with opened(path, storage_id) as reader:
                return from_bag(reader.metadata)
