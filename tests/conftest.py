"""What holds for every test stands in `suite.py`."""

import roslings.folders.lab_folders  # noqa: F401  # `graders.e_stop` can be imported from here on

pytest_plugins = ["suite"]
