"""`./roslings break N`: ten exercises. Each breaks a copy, or one terminal, and grades the mend."""

from ros_doctor.breaks.cli import main

__all__ = ["main"]
