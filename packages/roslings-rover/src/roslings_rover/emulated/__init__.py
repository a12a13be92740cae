"""The real sketch in an emulated ATmega2560, with motors and encoders on its pins.

The sketch holds no simulation: what is compiled here also runs on a real Arduino Mega. Needs
`APT_LINE`; `missing()` says what is not there.
"""

from roslings_rover.emulated.build import APT_LINE, BuiltSketch, CannotBuild, built, missing
from roslings_rover.emulated.chip import EmulatedMega, EmulatorEnded

__all__ = [
    "APT_LINE",
    "BuiltSketch",
    "CannotBuild",
    "EmulatedMega",
    "EmulatorEnded",
    "built",
    "missing",
]
