"""Cameras of three kinds, opened by one function. This part is complete.

    camera = open_camera('/tmp/rover_camera')  # the rover's, made by ./roslings camera
    camera = open_camera('/dev/video0')        # a USB camera
    camera = open_camera('pi')                 # the ribbon camera of a Raspberry Pi

    picture = camera.read()  # waits for the next picture
    camera.close()

A picture is a numpy array of 480 rows, 640 columns and 3 values: blue, green, red.
Whatever goes wrong is an OSError, whose text names the device and the reason.
"""

import errno
import os
import pathlib
import socket
import stat

import cv2
import numpy

WIDTH, HEIGHT = 640, 480
PICTURE_BYTES = WIDTH * HEIGHT * 3
WAITS = 5.0  # seconds


def open_camera(device):
    """Open the camera; raise OSError where that cannot be done."""
    if device == 'pi':
        return PiCamera()
    if stat.S_ISSOCK(pathlib.Path(device).stat().st_mode):
        return RoverCamera(device)
    return UsbCamera(device)


def trouble(device, number):
    """Make an error with the system's own words."""
    return OSError(number, os.strerror(number), device)


class RoverCamera:
    """The camera of the simulated rover, behind a socket.

    It first answers with the number of an error, 0 for none. Then it sends one
    picture for each letter that it gets.
    """

    def __init__(self, device):
        self.device = device
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(WAITS)
        try:
            self.socket.connect(device)
            number = self.receive(1)[0]
        except OSError as error:
            self.close()
            raise trouble(device, error.errno or errno.ENODEV) from error
        if number:
            self.close()
            raise trouble(device, number)

    def read(self):
        """Return the next picture."""
        try:
            self.socket.sendall(b'.')
            content = self.receive(PICTURE_BYTES)
        except OSError as error:
            raise trouble(self.device, errno.ENODEV) from error
        return numpy.frombuffer(content, numpy.uint8).reshape(HEIGHT, WIDTH, 3)

    def receive(self, size):
        """Return exactly so many bytes."""
        content = bytearray(size)
        rest = memoryview(content)
        while rest:
            count = self.socket.recv_into(rest)
            if not count:
                raise trouble(self.device, errno.ENODEV)
            rest = rest[count:]
        return content

    def close(self):
        """Let others have the camera."""
        self.socket.close()


class UsbCamera:
    """A camera on a USB cable, by OpenCV."""

    def __init__(self, device):
        self.device = device
        os.close(os.open(device, os.O_RDWR))  # says why, where it is forbidden
        self.capture = cv2.VideoCapture(device, cv2.CAP_V4L2)
        if not self.capture.isOpened():
            raise trouble(device, errno.EBUSY)
        self.capture.set(cv2.CAP_PROP_FRAME_WIDTH, WIDTH)
        self.capture.set(cv2.CAP_PROP_FRAME_HEIGHT, HEIGHT)

    def read(self):
        """Return the next picture."""
        good, picture = self.capture.read()
        if not good:
            raise trouble(self.device, errno.ENODEV)
        if picture.shape[:2] != (HEIGHT, WIDTH):
            picture = cv2.resize(picture, (WIDTH, HEIGHT))
        return picture

    def close(self):
        """Let others have the camera."""
        self.capture.release()


class PiCamera:
    """The ribbon camera of a Raspberry Pi, by picamera2."""

    def __init__(self):
        try:
            from picamera2 import Picamera2
        except ImportError as error:
            raise OSError(errno.ENODEV, 'picamera2 is not installed', 'pi') from error
        try:
            self.camera = Picamera2()
            # What picamera2 calls RGB888 lies in memory as blue, green, red.
            size = {'size': (WIDTH, HEIGHT), 'format': 'RGB888'}
            self.camera.configure(self.camera.create_video_configuration(main=size))
            self.camera.start()
        except (IndexError, RuntimeError) as error:
            raise OSError(errno.ENODEV, str(error), 'pi') from error

    def read(self):
        """Return the next picture."""
        try:
            return self.camera.capture_array('main')
        except RuntimeError as error:
            raise OSError(errno.ENODEV, str(error), 'pi') from error

    def close(self):
        """Let others have the camera."""
        self.camera.close()
