"""What holds for every test stands in `tests/suite.py`."""

pytest_plugins = ["suite"]
