"""Foretell: which two numbers are written? Write them between quotes, for example
"3 4", then check."""

import numpy

ANSWER = None

picture = numpy.zeros((480, 640, 3), dtype=numpy.uint8)
height, width, channels = picture.shape

print(height, width)
