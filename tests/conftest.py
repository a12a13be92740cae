"""What holds for every test stands in `suite.py`."""

pytest_plugins = ["suite"]
