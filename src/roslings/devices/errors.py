"""What a stand-in for hardware cannot do here, said with the next step."""

from __future__ import annotations


class DeviceTrouble(Exception):
    """The text is shown to the person at the screen."""
