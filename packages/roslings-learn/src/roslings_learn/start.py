"""The program that `./roslings` is, for who starts it from a notebook or from its server."""

from __future__ import annotations

from pathlib import Path

import roslings_launcher

START = Path(roslings_launcher.__file__).with_name("start.py")
