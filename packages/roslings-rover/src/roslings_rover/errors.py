"""What a stand-in for hardware cannot do here, said with the next step."""

from __future__ import annotations

from ros2_on_pip.errors import RoslingsError


class DeviceTrouble(RoslingsError):
    """The text is shown to the person at the screen."""
