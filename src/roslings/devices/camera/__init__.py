"""A camera without hardware: it draws what the rover sees, with light, colour and noise to set.

Needs numpy, which ROS's Python messages bring along.
"""

from roslings.devices.camera.camera import Light, SyntheticCamera
from roslings.devices.camera.frame import CHANNELS, ENCODINGS, Encoding, Frame, NotAnImage
from roslings.devices.camera.on_socket import SocketCamera

__all__ = [
    "CHANNELS",
    "ENCODINGS",
    "Encoding",
    "Frame",
    "Light",
    "NotAnImage",
    "SocketCamera",
    "SyntheticCamera",
]
