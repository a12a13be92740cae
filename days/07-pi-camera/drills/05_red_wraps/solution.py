"""Hues of seven pixels, as OpenCV counts them (0 to 179). Red is within 6 of the point
where the circle closes. It must print "red pixels 4"."""

import numpy

HUES = numpy.array([2, 178, 60, 5, 120, 175, 90])

red = (HUES <= 6) | (HUES >= 174)
print("red pixels", red.sum())
