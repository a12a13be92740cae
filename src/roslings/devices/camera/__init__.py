"""A camera without hardware: it draws what the rover sees, with light, colour and noise to set.

Needs numpy, which ROS's Python messages bring along.
"""

from roslings.devices.camera.camera import Light, SyntheticCamera
from roslings.devices.camera.frame import ENCODINGS, Encoding, Frame, NotAnImage

__all__ = ["ENCODINGS", "Encoding", "Frame", "Light", "NotAnImage", "SyntheticCamera"]
