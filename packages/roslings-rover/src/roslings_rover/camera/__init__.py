"""A camera without hardware: it draws what the rover sees, with light, colour and noise to set.

Needs numpy, which ROS's Python messages bring along.
"""

from roslings_rover.camera.camera import Light, SyntheticCamera
from roslings_rover.camera.frame import CHANNELS, ENCODINGS, Encoding, Frame, NotAnImage
from roslings_rover.camera.on_socket import SocketCamera

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
